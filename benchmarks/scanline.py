"""Scan line against the depth buffer, which is measured in turn: a mesh of tiny faces, and deep sheets.

`python -m benchmarks.scanline [1M]` prints how many times the depth buffer's time it takes.
"""

from __future__ import annotations

import sys

import numpy as np

from benchmarks import peers, results
from eyeline.projection import project
from eyeline.projection.projected import Projected
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS

SIZE = (1920, 1080)
COUNTS = {"80k": 80_000, "1M": 1_000_000, "5M": 5_000_000}
CAMERA = Camera.look_at((1.2, 0.9, 2.8), (0, 0, 0), near=0.1)
SHEETS = 100


def compared(what: str, projected: Projected, bar: str) -> results.Row:
    """One picture by both methods, in turn, once they agree."""
    ours, theirs = METHODS["scanline"], METHODS["zbuffer"]
    first, second = ours(projected), theirs(projected)
    if not (np.array_equal(first.face, second.face) and np.array_equal(first.depth, second.depth)):
        raise SystemExit(f"{what}: the two see different faces")
    duel = peers.alternate(lambda: ours(projected), lambda: theirs(projected), rounds=15)
    print(f"{what}: {duel}   cores free {peers.free_cores():.2f}   {dict(first.work)}", flush=True)
    return results.Row(what, duel.ours * 1e3, duel.theirs * 1e3, "our zbuffer", bar=bar)


def sphere(label: str) -> list[results.Row]:
    """A closed mesh, its backs dropped and kept."""
    scene = Scene.of(Mesh(*peers.bumpy_sphere(COUNTS[label])))
    return [
        compared(
            f"scanline, 1920x1080, {label} faces, backs {told}", project(scene, CAMERA, SIZE, cull), "<= 5"
        )
        for cull, told in (("back", "dropped"), ("none", "kept"))
    ]


def sheets() -> results.Row:
    """Sheets over the whole picture, the farthest first."""
    corners = np.array([(-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0)], dtype=np.float32)
    points = np.concatenate([corners + np.float32([0, 0, 0.01 * k]) for k in range(SHEETS)])
    faces = np.concatenate([np.array([(0, 1, 2), (0, 2, 3)]) + 4 * k for k in range(SHEETS)])
    projected = project(Scene.of(Mesh(points, faces)), CAMERA, SIZE, "none")
    return compared(f"scanline, 1920x1080, {SHEETS} sheets behind each other", projected, "<= 1")


def main(arguments: list[str]) -> None:
    rows = [row for label in arguments or ["1M"] for row in sphere(label)]
    results.record("scanline", [*rows, sheets()])


if __name__ == "__main__":
    main(sys.argv[1:])
