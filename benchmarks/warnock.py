"""Area subdivision beside our depth buffer at 1920x1080: how many times as long it takes.

`python -m benchmarks.warnock [5k 80k 1M]` measures them in turn, on a bumpy sphere, backs kept and dropped.
"""

from __future__ import annotations

import sys

import numpy as np

from benchmarks import peers
from eyeline.projection import project
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS

SIZE = (1920, 1080)
COUNTS = {"5k": 5_000, "80k": 80_000, "1M": 1_000_000}
CAMERA = Camera.look_at((1.2, 0.9, 2.8), (0, 0, 0), near=0.1)


def measure(label: str, cull: str) -> None:
    """One size, both methods, the same answer."""
    scene = Scene.of(Mesh(*peers.bumpy_sphere(COUNTS[label])))
    projected = project(scene, CAMERA, SIZE, cull)
    warnock, zbuffer = METHODS["warnock"], METHODS["zbuffer"]
    ours, theirs = warnock(projected), zbuffer(projected)
    if not (np.array_equal(ours.face, theirs.face) and np.array_equal(ours.depth, theirs.depth)):
        raise SystemExit("the pictures differ")
    duel = peers.alternate(lambda: warnock(projected), lambda: zbuffer(projected), rounds=9)
    told = ", ".join(f"{name} {count:,}" for name, count in ours.work.items())
    print(
        f"{label} faces, backs {'dropped' if cull == 'back' else 'kept'}: {1 / duel.ratio:.1f} times the "
        f"depth buffer's time; {duel}   cores free {peers.free_cores():.2f}\n  {told}",
        flush=True,
    )


def main(arguments: list[str]) -> None:
    for label in arguments or COUNTS:
        for cull in ("none", "back"):
            measure(label, cull)


if __name__ == "__main__":
    main(sys.argv[1:])
