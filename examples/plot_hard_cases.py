"""
Hard cases
==========

Eight small scenes, each hard for one way of finding hidden surfaces or another: planks that overlap in a
ring, sheets that pierce each other or share a plane, a sheet seen edge-on, a corner on an edge, 64 layers,
and two bodies.
"""

import numpy as np

import eyeline as el

SIZE = (400, 225)
COLUMNS = 2

pictures = []
for name, case in el.samples.HARD_CASES.items():
    print(f"{name} is hard for {', '.join(case.methods) or 'none'}: {case.why}")
    pictures.append(el.render(el.samples.SAMPLES[name](), size=SIZE).pixels)

rows = [
    np.concatenate(pictures[first : first + COLUMNS], axis=1) for first in range(0, len(pictures), COLUMNS)
]
el.Image(np.concatenate(rows)).save("hard_cases.png")
