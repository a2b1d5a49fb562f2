"""The painter's algorithm against our depth buffer at 1920x1080, on a million small faces.

Both have the projected faces ready, and both end with face and depth of every pixel, which must be the same.
`python -m benchmarks.painter [faces]` measures them in turn.
"""

from __future__ import annotations

import sys

import numpy as np

from benchmarks import peers, results
from benchmarks.zbuffer import CAMERA, SIZE
from eyeline.projection import project
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS

FACES = 1_000_000


def measure(faces: int, cull: str) -> results.Row:
    """One bumpy sphere, its backs dropped or kept."""
    projected = project(Scene.of(Mesh(*peers.bumpy_sphere(faces))), CAMERA, SIZE, cull)
    painter, zbuffer = (METHODS[name] for name in ("painter", "zbuffer"))
    ours, theirs = painter(projected), zbuffer(projected)
    if not (np.array_equal(ours.face, theirs.face) and np.array_equal(ours.depth, theirs.depth)):
        raise SystemExit("the painter and the depth buffer see different things")
    duel = peers.alternate(lambda: painter(projected), lambda: zbuffer(projected), rounds=15)
    what = f"painter, 1920x1080, {faces:,} faces, backs {'dropped' if cull == 'back' else 'kept'}"
    print(f"{what}: {1 / duel.ratio:.2f} times the depth buffer's time; {duel}", flush=True)
    print(f"  {dict(ours.work)}   cores free {peers.free_cores():.2f}", flush=True)
    return results.Row(what, duel.ours * 1e3, duel.theirs * 1e3, "our zbuffer", bar="<= 10")


def main(arguments: list[str]) -> None:
    faces = int(arguments[0]) if arguments else FACES
    results.record("painter", [measure(faces, cull) for cull in ("back", "none")])


if __name__ == "__main__":
    main(sys.argv[1:])
