"""What a method sees in another process: on other threads, compiled for another processor, or not compiled.

Run as a program, it prints the digest of everything that a method answers.
"""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from pathlib import Path

import numpy as np

import eyeline
import soups
from eyeline.projection import project
from eyeline.projection.projected import Projected
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS

EXTENTS = {"large": ((301, 270), 400), "small": ((9, 7), 6)}  # name -> pixels, faces


def digest_elsewhere(method: str, extent: str = "large", **environment: str) -> str:
    """`digest_of` in another process, with these variables set."""
    path = os.pathsep.join([str(Path(__file__).parent), str(Path(eyeline.__file__).parent.parent)])
    run = subprocess.run(
        [sys.executable, __file__, method, extent],
        env=os.environ | {"PYTHONPATH": path} | environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    return run.stdout.strip()


def digest_of(method: str, extent: str) -> str:
    """The bytes and counters of all that a method answers on some pictures."""
    digest = hashlib.sha256()
    for picture in pictures(extent, METHODS[method].exact):
        answer = METHODS[method](picture)
        digest.update(repr([(name, int(count)) for name, count in sorted(answer.work.items())]).encode())
        for array in arrays_in(answer):
            digest.update(array.tobytes())
    return digest.hexdigest()


def pictures(extent: str, snapped: bool) -> Iterator[Projected]:
    """Faces around the eye, a ball, and, for methods that decide by the grid, faces made on it."""
    size, count = EXTENTS[extent]
    for seed in range(7):
        yield project(*soups.around_the_eye(seed, max(6, count // 4)), size)
    ball = Mesh(*soups.ball(max(3, count // 20)))
    yield project(Scene.of(ball), Camera.look_at((1, 2, 3), (0, 0, 0)), size)
    for kind in soups.SNAPPED if snapped else ():
        yield soups.snapped(kind, 5, size, count)


def arrays_in(answer: object) -> Iterator[np.ndarray]:
    """The arrays that an answer holds, also within what it is made of; not those it was made from."""
    for field in fields(answer):  # type: ignore[arg-type]
        value = getattr(answer, field.name)
        if isinstance(value, np.ndarray):
            yield value
        elif is_dataclass(value) and field.name not in ("projected", "method", "scene"):
            yield from arrays_in(value)


if __name__ == "__main__":
    print(digest_of(*sys.argv[1:]))
