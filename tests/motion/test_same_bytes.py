"""Posed scenes have the same bytes on every processor and for every number of threads."""

import os
import subprocess
import sys

import pytest

PROGRAM = """
import hashlib
import numpy as np
from eyeline.geometry import quaternion, transform
from eyeline.motion import Clip, Curve, Track
from eyeline.scene.mesh import Mesh, MorphTarget
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene
from eyeline.scene.skin import Skin

rng = np.random.default_rng(0)
count, digest = 40_000, hashlib.sha256()
points = rng.normal(size=(count, 3)).astype(np.float32)
normals = quaternion.normalized(rng.normal(size=(count, 4)))[:, :3]
mesh = Mesh(points, [[0, 1, 2]], normals, np.insert(normals, 3, 1, axis=1), targets=[MorphTarget(points)],
            joints=rng.integers(0, 3, (count, 4)), influences=rng.random((count, 4)))
keys, joints = np.sort(rng.random(20)), ("a", "a/b", "a/b/c")
tracks = [Track("node", "skin", "weights", Curve(keys, rng.normal(size=(20, 1))))]
for way in ("linear", "dual_quaternion"):
    for shape in ("linear", "cubic"):
        size = (20, 3, 4) if shape == "cubic" else (20, 4)
        turns = [Curve(keys, rng.normal(size=size), shape, rotation=True) for _ in joints]
        moves = [Track("node", path, "rotation", turn) for path, turn in zip(joints, turns)]
        moves.append(Track("node", "a", "scale", Curve([0, 1], [[1, 1, 1], [2, 0.5, 1]])))
        inverse = transform.compose(rng.normal(size=(3, 3)), [[0, 0, 0, 1]] * 3, np.ones((3, 3)))
        body = Node("skin", mesh=mesh, skin=Skin((0, 1, 2), inverse, way))
        nodes = (Node("a"), Node("b", 0, (1, 2, 3)), Node("c", 1, (1, 0, 0)), body)
        scene = Scene(nodes, (Clip("act", tracks + moves),))
        digest.update(scene.sample(rng.random(3000)).world.tobytes())
        for surface in scene.at(0.4).surfaces:
            for array in (surface.mesh.points, surface.mesh.normals, surface.mesh.tangents):
                digest.update(array.tobytes())
print(digest.hexdigest())
"""


def digest(**settings: str) -> str:
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        env=os.environ | settings,
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.slow
def test_processors_and_threads_do_not_change_a_byte() -> None:
    here = digest(EYELINE_THREADS="2", NUMBA_CPU_NAME="host")
    assert digest(EYELINE_THREADS="1", NUMBA_CPU_NAME="generic", OPENBLAS_CORETYPE="Prescott") == here
