"""
A contact sheet
===============

Twelve moments of a clip on one sheet. A clip is a pure function of time, so a frame can be asked for by its
number, in any order.
"""

import numpy as np

import eyeline as el

SIZE = (360, 240)
COLUMNS, ROWS = 4, 3

scene = el.samples.desk_lamp()
film = el.film(scene, fps=COLUMNS * ROWS / scene.duration, size=SIZE)
print(f"{len(film)} frames of {scene.duration:g} seconds")

frames = [frame.pixels for frame in film]
rows = [
    np.concatenate(frames[first : first + COLUMNS], axis=1) for first in range(0, COLUMNS * ROWS, COLUMNS)
]
el.Image(np.concatenate(rows)).save("contact_sheet.png")
