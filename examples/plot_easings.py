"""
Every easing
============

How a motion spreads over its time, by name: time runs right, the way upwards. Blue are CSS's, red those of
ten families, green manim's.
"""

from pathlib import Path

import numpy as np

import eyeline as el

SIZE = (960, 900)
COLUMNS, CELL, ROOM = 8, 120, 84

parts = np.linspace(0, 1, 121)
drawn = []
for index, (name, ease) in enumerate(el.EASINGS.items()):
    x, y = CELL * (index % COLUMNS) + 18, CELL * (index // COLUMNS) + 22
    colour = "#2563a8" if index < 8 else "#b5382e" if index < 38 else "#3d7a3a"
    points = " ".join(
        f"{x + ROOM * u:.1f},{y + 66 - 46 * v:.1f}" for u, v in zip(parts, ease(parts), strict=True)
    )
    drawn.append(f'<path d="M{x},{y + 20} h{ROOM} M{x},{y + 66} h{ROOM}" stroke="#ccc" fill="none"/>')
    drawn.append(f'<path d="M{points}" stroke="{colour}" stroke-width="2" fill="none"/>')
    label = name.replace("there_and_back_with_pause", "there_and_back_with_...")
    drawn.append(f'<text x="{x + ROOM / 2}" y="{y - 4}" font-size="9" text-anchor="middle">{label}</text>')

view = f'viewBox="0 0 {COLUMNS * CELL} {(len(el.EASINGS) // COLUMNS + 1) * CELL}"'
head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{SIZE[0]}" height="{SIZE[1]}" {view}'
page = [
    f'{head} font-family="sans-serif">',
    '<rect width="100%" height="100%" fill="white"/>',
    *drawn,
    "</svg>",
]
Path("easings.svg").write_text("\n".join(page))
