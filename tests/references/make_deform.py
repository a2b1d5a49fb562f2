"""Writes deform.json: where Blender's SimpleDeform and Lattice modifiers take a few points.

Run where Blender is a module (`pip install bpy`): `python tests/references/make_deform.py`
"""

from __future__ import annotations

import json
from pathlib import Path

import bpy
import numpy as np

RNG = np.random.default_rng(7)
# The corners of a cube of 2 m first: they are the bounds that Blender's limits are parts of
CORNERS = np.stack(np.meshgrid([-1.0, 1.0], [-1.0, 1.0], [-1.0, 1.0], indexing="ij"), axis=-1).reshape(-1, 3)
POINTS = np.concatenate([CORNERS, RNG.uniform(-1, 1, (40, 3))]).round(3)
RESOLUTION = (4, 3, 5)
OFFSETS = RNG.normal(size=(*RESOLUTION, 3)).round(3) / 4
CELL = [2 / (count - 1) for count in RESOLUTION]  # in its own space a lattice has cells of 1 m
SIMPLE = [
    ("TWIST", 1.2, (0.0, 1.0)), ("TWIST", -2.0, (0.3, 0.8)),
    ("BEND", 1.5, (0.0, 1.0)), ("BEND", -0.8, (0.2, 0.7)),
    ("TAPER", 0.6, (0.0, 1.0)), ("TAPER", -1.1, (0.25, 0.9)),
    ("STRETCH", 0.5, (0.0, 1.0)), ("STRETCH", -0.4, (0.0, 1.0)),
]  # fmt: skip


def main() -> None:
    cases: list[dict[str, object]] = []
    for method, amount, limits in SIMPLE:
        body = placed()
        modifier = body.modifiers.new("deform", "SIMPLE_DEFORM")
        modifier.deform_method, modifier.deform_axis = method, "Z"
        modifier.limits = limits
        if method in ("TWIST", "BEND"):
            modifier.angle = amount
        else:
            modifier.factor = amount
        cases.append({"method": method, "amount": amount, "limits": limits, "points": evaluated(body)})
    body = placed()
    body.modifiers.new("deform", "LATTICE").object = lattice()
    cases.append({"method": "LATTICE", "offsets": OFFSETS.tolist(), "points": evaluated(body)})
    data = {"blender": bpy.app.version_string, "points": POINTS.tolist(), "cases": cases}
    Path(__file__).with_name("deform.json").write_text(json.dumps(data, indent=None) + "\n")


def placed() -> bpy.types.Object:
    """The points as an object of vertices alone, in a scene of nothing else."""
    mesh = bpy.data.meshes.new("points")
    mesh.from_pydata(POINTS.tolist(), [], [])
    body = bpy.data.objects.new("points", mesh)
    bpy.context.scene.collection.objects.link(body)
    return body


def lattice() -> bpy.types.Object:
    """A lattice of B-splines over the cube, its points moved."""
    data = bpy.data.lattices.new("lattice")
    data.points_u, data.points_v, data.points_w = RESOLUTION
    for axis in "uvw":
        setattr(data, f"interpolation_type_{axis}", "KEY_BSPLINE")
    for index, point in enumerate(data.points):
        u = index % RESOLUTION[0]
        v = index // RESOLUTION[0] % RESOLUTION[1]
        w = index // (RESOLUTION[0] * RESOLUTION[1])
        moved = zip(point.co, OFFSETS[u, v, w], CELL, strict=True)
        point.co_deform = [place + offset / cell for place, offset, cell in moved]
    thing = bpy.data.objects.new("lattice", data)
    thing.scale = CELL
    bpy.context.scene.collection.objects.link(thing)
    return thing


def evaluated(body: bpy.types.Object) -> list[list[float]]:
    """Where the modifiers leave the points."""
    bpy.context.view_layer.update()
    mesh = body.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    found = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", found)
    return [[round(float(x), 6) for x in row] for row in found.reshape(-1, 3)]


if __name__ == "__main__":
    main()
