"""
Styles
======

One view in every style. They differ in how they draw what is seen, never in what is seen.
"""

import math

import numpy as np

import eyeline as el

SIZE = (480, 320)
COLUMNS = 2

ring = el.samples.torus().surfaces[0].mesh
ball = el.samples.sphere().surfaces[0].mesh
scene = el.Scene.of(
    *el.samples.teapot().nodes,
    el.Node("ring", mesh=ring, translation=(0.17, 0.024, 0.17), scale=(0.16, 0.16, 0.16)),
    el.Node("ball", mesh=ball, translation=(-0.17, 0.04, 0.12), scale=(0.08, 0.08, 0.08)),
)
camera = el.Camera.look_at(eye=(0.35, 0.35, 0.75), target=(0.02, 0.06, 0.05), fov=math.radians(28))

pictures = [el.render(scene, camera, size=SIZE, style=style).pixels for style in el.STYLES]
print(", ".join(el.STYLES))

blank = np.full_like(pictures[0], 255)
pictures += [blank] * (-len(pictures) % COLUMNS)
rows = [
    np.concatenate(pictures[first : first + COLUMNS], axis=1) for first in range(0, len(pictures), COLUMNS)
]
el.Image(np.concatenate(rows)).save("styles.png")
