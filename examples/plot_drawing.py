"""
A drawing
=========

Lines where they are seen, to the thousandth of a pixel, as vectors: outlines heavy, creases fine, and what
something stands before in dashes. The file has a group for each node, for a plotter or a drawing program.
"""

import math

import eyeline as el

SIZE = (960, 640)

pot = el.samples.teapot()
ring = el.samples.torus().surfaces[0].mesh
cube = el.samples.cube().surfaces[0].mesh
scene = el.Scene.of(
    *pot.nodes,
    el.Node("ring", mesh=ring, translation=(0.02, 0.02, 0.02), scale=(0.34, 0.16, 0.34)),
    el.Node("block", mesh=cube, translation=(-0.15, 0.03, -0.12), scale=(0.1, 0.06, 0.1)),
)
camera = el.Camera.look_at(eye=(0.35, 0.42, 0.75), target=(0.005, 0.035, 0.0), fov=math.radians(22))

drawing = el.draw(scene, camera, size=SIZE, hidden="dashed")
drawing.save("drawing.svg")
print(sum(len(group.paths) for group in drawing.sheet.groups), "paths")
