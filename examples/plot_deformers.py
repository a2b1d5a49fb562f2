"""
Deformers
=========

One tower, and what each deformer makes of it. They move points and turn normals exactly, all of a stack in
one pass; every number of theirs can be keyed.
"""

import math

import numpy as np
import PIL.Image
import PIL.ImageDraw

import eyeline as el
from eyeline.geometry.normals import vertex_normals

SIZE = (300, 300)
COLUMNS, SIDES = 4, 144

# A tower of 1 m: rounded square floors, from the middle of its base to that of its roof
along = np.concatenate([np.zeros(12), np.linspace(0, 1, 120), np.ones(12)])
inset = np.concatenate([np.linspace(0, 1, 12), np.ones(120), np.linspace(1, 0, 12)])
turn = np.linspace(0, 2 * math.pi, SIDES, endpoint=False)
radius = inset[:, None] * 0.2 * (np.cos(turn) ** 6 + np.sin(turn) ** 6) ** (-1 / 6)
points = np.stack([radius * np.sin(turn), along[:, None] + 0 * radius, radius * np.cos(turn)], axis=-1)
row, side = np.divmod(np.arange((len(along) - 1) * SIDES), SIDES)
a, b = row * SIDES + side, row * SIDES + (side + 1) % SIDES
faces = np.concatenate([np.stack([a, b, b + SIDES], 1), np.stack([a, b + SIDES, a + SIDES], 1)])
checks = np.floor(along[row] * 8.99) + side * 8 // SIDES
cream, brick = (el.Material(base_color=(*rgb, 1)) for rgb in ((0.9, 0.82, 0.66), (0.75, 0.16, 0.1)))
points = points.reshape(-1, 3)
tower = el.Mesh(points, faces, vertex_normals(points, faces), materials=[cream, brick],
                face_material=np.tile(checks % 2, 2).astype(int))  # fmt: skip

middle = (0.0, 0.5, 0.0)
lattice = el.deform.Lattice.around(points, (3, 4, 3))
sway = np.sin(np.arange(4) * 1.7)[None, :, None, None] * (0.35, 0, 0.1)
KEYS = {
    "taper": {"amount": -0.75}, "twist": {"angle": 2.4}, "bend": {"angle": 1.5, "towards": -0.4},
    "stretch": {"amount": -0.35}, "shear": {"x": 0.4}, "inflate": {"amount": 0.5, "origin": middle},
    "spherify": {"amount": 0.8, "radius": 0.4, "origin": middle},
    "wave": {"amplitude": 0.09, "length": 0.6, "axis": (1, 0, 0)},
    "rotation": {"angle": 0.7, "axis": (0, 0.2, 1), "origin": middle},
}  # fmt: skip
SHOWN = {"at rest": None} | {name: el.deform.DEFORMERS[name](**values) for name, values in KEYS.items()}
SHOWN["lattice"] = lattice.changed({"offsets": lattice.offsets + sway})
SHOWN["taper, twist, bend"] = el.deform.Composite.of(SHOWN["taper"], SHOWN["twist"], SHOWN["bend"])

camera = el.Camera.look_at((1.4, 1.5, 3.4), (0.08, 0.52, 0), fov=math.radians(26))
sheet = PIL.Image.new("RGB", (SIZE[0] * COLUMNS, SIZE[1] * -(-len(SHOWN) // COLUMNS)))
for number, (name, deformer) in enumerate(SHOWN.items()):
    tile = el.render(el.Scene.of(el.Node("tower", mesh=tower, deform=deformer)), camera, SIZE)
    picture = PIL.Image.fromarray(tile.pixels)
    PIL.ImageDraw.Draw(picture).text((12, 8), name, fill=(60, 60, 60), font_size=SIZE[1] // 15)
    sheet.paste(picture, (number % COLUMNS * SIZE[0], number // COLUMNS * SIZE[1]))
sheet.save("deformers.png")
