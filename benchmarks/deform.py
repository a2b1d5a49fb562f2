"""A stack of deformers over a mesh of a million vertices, with normals, against Blender's modifiers.

<<<<<<< HEAD
Blender is not in the extra `bench`, for it is large: `pip install --no-deps bpy`, then
`python -m benchmarks.deform`
=======
`python -m benchmarks.deform`. Blender is not in the extra `bench`: `pip install --no-deps bpy`.
>>>>>>> 2833259 (A page and a sheet of deformers: one tower under each of them; the page's table is generated)
"""

from __future__ import annotations

import importlib.util
import statistics
from functools import partial

import numpy as np

from benchmarks import peers, results
from eyeline import jit
from eyeline.deform.bend import Bend
from eyeline.deform.composite import Composite
from eyeline.deform.lattice import Lattice
from eyeline.deform.taper import Taper
from eyeline.deform.twist import Twist
from eyeline.geometry.normals import vertex_normals

FACES = 2_000_000  # and half as many vertices
ROUNDS = 9
ANGLE, TURN, SHRINK = 0.8, 1.2, -0.4
OFFSETS = np.random.default_rng(0).normal(size=(4, 4, 4, 3)) / 10
BOX = {"lower": (-1.2,) * 3, "upper": (1.2,) * 3}
PARTS = {
    "bend": Bend(ANGLE, lower=-1.0, axis=(1.0, 0.0, 0.0)),
    "twist": Twist(TURN, lower=-1.0, axis=(0.0, 0.0, 1.0)),
    "taper": Taper(SHRINK, lower=-1.0, axis=(0.0, 0.0, 1.0)),
    "lattice of 4 x 4 x 4": Lattice(OFFSETS, basis="bspline", **BOX),
}


def main() -> None:
    points, faces = peers.bumpy_sphere(FACES)
    normals = vertex_normals(points, faces)
    size = f"{len(points) / 1e6:.0f}M vertices with normals, {jit.threads()} threads"
    rows = [
        results.Row(f"{name}, {size}", 1e3 * median(partial(part, points, normals)))
        for name, part in PARTS.items()
    ]
    ours = partial(Composite(tuple(PARTS.values())), points, normals)
    what, bar = f"bend + twist + taper + lattice, {size}", "<= 1/5, <= 100 ms"
    if importlib.util.find_spec("bpy") is None:
        rows.append(results.Row(what, 1e3 * median(ours), bar=bar))
    else:
        theirs, name = blender(points, faces)
        duel = peers.alternate(ours, theirs, ROUNDS)
        rows.append(results.Row(what, duel.ours * 1e3, duel.theirs * 1e3, name, bar=bar))
    results.record("deform", rows)


def blender(points: np.ndarray, faces: np.ndarray) -> tuple[peers.Run, str]:
    """The same stack as modifiers: its mesh evaluated anew, and the normals of its vertices."""
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    mesh = bpy.data.meshes.new("ball")
    mesh.vertices.add(len(points))
    mesh.vertices.foreach_set("co", points.reshape(-1))
    mesh.loops.add(faces.size)
    mesh.loops.foreach_set("vertex_index", faces.reshape(-1))
    mesh.polygons.add(len(faces))
    mesh.polygons.foreach_set("loop_start", np.arange(0, faces.size, 3, dtype=np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(len(faces), bool))
    mesh.update(calc_edges=True)
    body = bpy.data.objects.new("ball", mesh)
    bpy.context.scene.collection.objects.link(body)
    for method, axis, number, value in (
        ("BEND", "Z", "angle", ANGLE), ("TWIST", "Z", "angle", TURN), ("TAPER", "Z", "factor", SHRINK),
    ):  # fmt: skip
        modifier = body.modifiers.new(method.lower(), "SIMPLE_DEFORM")
        modifier.deform_method, modifier.deform_axis = method, axis
        setattr(modifier, number, value)
    body.modifiers.new("lattice", "LATTICE").object = cage(bpy)
    bend = body.modifiers[0]
    count = 0

    def run() -> None:
        nonlocal count
        count += 1
        bend.angle = ANGLE + 1e-6 * count  # what has not changed would not be evaluated
        bpy.context.view_layer.update()
        done = body.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        done.vertex_normals[0].vector  # noqa: B018  normals are found when they are first asked for

    return run, f"Blender {bpy.app.version_string}"


def cage(bpy: object) -> object:
    """A lattice of B-splines over the same box, its points moved the same way."""
    data = bpy.data.lattices.new("lattice")  # type: ignore[attr-defined]
    data.points_u = data.points_v = data.points_w = 4
    width = (BOX["upper"][0] - BOX["lower"][0]) / 3
    for index, point in enumerate(data.points):
        offset = OFFSETS[index % 4, index // 4 % 4, index // 16]
        point.co_deform = [place + move / width for place, move in zip(point.co, offset, strict=True)]
    thing = bpy.data.objects.new("lattice", data)  # type: ignore[attr-defined]
    thing.scale = (width,) * 3
    bpy.context.scene.collection.objects.link(thing)  # type: ignore[attr-defined]
    return thing


def median(run: peers.Run) -> float:
    """Seconds of one run, after one unmeasured."""
    run()
    return statistics.median(peers.seconds(run) for _ in range(ROUNDS))


if __name__ == "__main__":
    main()
