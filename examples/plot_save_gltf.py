"""
A film for other players
========================

A twist by a deformer, which glTF does not have, is saved as the fewest morph targets that show it.
"""

import math
import tempfile
from pathlib import Path

import eyeline as el

SIZE = (640, 400)

tower = el.Node(
    "teapot", mesh=el.samples.teapot().nodes[0].mesh, deform=el.deform.Twist(upper=0.16, angle=0.0)
)
turn = el.Track("node", "teapot", "deform.angle", el.Curve([0, 1], [0.0, math.pi]))
scene = el.Scene.of(tower, clips=[el.Clip("turn", [turn])])

with tempfile.TemporaryDirectory() as folder:
    path = Path(folder) / "teapot.glb"
    for note in scene.save(path, tolerance=1e-3, fps=12):
        print(note)
    again = el.load(path)

# The file plays as the scene does, here and in any other player
el.render(again, time=1.0, size=SIZE).save("save_gltf.png")
