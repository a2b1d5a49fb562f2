"""
Characters
==========

What is rigged by code can act: a flour sack gathers itself, leaps, lands and looks whether anyone saw.
Nothing but numbers of its controls is keyed; constraints turn them into squash, lean and swinging ears.
"""

import numpy as np

import eyeline as el

SIZE = (320, 200)

sack = el.samples.flour_sack()
pictures = [el.render(sack, size=SIZE, time=time).pixels for time in (0.5, 0.66, 0.9, 1.1, 1.2, 2.3)]
rows = [np.concatenate(pictures[first : first + 3], axis=1) for first in (0, 3)]
el.Image(np.concatenate(rows)).save("characters.png")
