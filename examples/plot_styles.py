"""
Styles
======

One view in every style. They differ in how they draw what is seen, never in what is seen.
"""

import numpy as np

import eyeline as el

SIZE = (360, 270)
COLUMNS = 4

scene = el.samples.desk_lamp()
pictures = [el.render(scene, size=SIZE, style=style).pixels for style in el.STYLES]
print(", ".join(el.STYLES))

blank = np.full_like(pictures[0], 255)
pictures += [blank] * (-len(pictures) % COLUMNS)
rows = [
    np.concatenate(pictures[first : first + COLUMNS], axis=1) for first in range(0, len(pictures), COLUMNS)
]
el.Image(np.concatenate(rows)).save("styles.png")
