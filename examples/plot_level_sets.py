"""
Any shape into any other
========================

A ring becomes a teapot. The two have no vertex in common, and not even the same number of holes, so the
shapes between them are level sets. Each is described by how far every place in space is from its surface,
below zero inside; where the mean of the two distances is zero, there is the surface between. How far the
first and the last shape are from the models is measured.
"""

import numpy as np

import eyeline as el

SIZE = (320, 240)
COLUMNS, ROWS = 4, 3

ring, pot = el.samples.torus(), el.samples.teapot()
between = el.inbetween(ring, pot, way="level_set", align="box", cells=128)

camera = el.Camera.look_at(eye=(0.0, 0.62, 1.5), target=(0, 0.02, 0), fov=0.62)
pictures = []
for part in np.linspace(0, 1, COLUMNS * ROWS):
    mesh = between.at(float(part))
    # All as wide as the ring, and standing on the same floor
    wide = 1 / (mesh.bounds.high - mesh.bounds.low).max()
    node = el.Node(
        "shape", scale=(wide, wide, wide), mesh=mesh, translation=(0, -wide * mesh.bounds.low[1] - 0.15, 0)
    )
    pictures.append(el.render(el.Scene.of(node), camera, size=SIZE, ground_height=-0.15).pixels)

rows = [np.concatenate(pictures[row * COLUMNS : (row + 1) * COLUMNS], axis=1) for row in range(ROWS)]
el.Image(np.concatenate(rows)).save("level_sets.png")

for name, error in zip(("ring", "teapot"), between.error, strict=True):
    print(f"{name}: {1000 * error.mean:.2f} mm from the model in the mean")
