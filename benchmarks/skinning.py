"""How many joints are sampled and how many influences are skinned in a second; a posed frame of real models.

`python -m benchmarks.skinning`
"""

from __future__ import annotations

import json
import os
import shutil
import statistics
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import numpy as np

from benchmarks import peers, results
from eyeline import jit
from eyeline.deform import skin
from eyeline.geometry import quaternion, transform
from eyeline.motion import Clip, Curve, Track
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

VERTICES, INFLUENCES, JOINTS = 100_000, 4, 64
TIMES = 10_000
ROUNDS = 15
THREEJS = Path(__file__).parent.parent / "build" / "threejs"


def main() -> None:
    rows = [*skinning(), *sampling(), *against_threejs()]
    results.record("skinning", rows)


def skinning() -> Iterator[results.Row]:
    """Points, normals and tangents of a mesh of 100,000 vertices, each with 4 joints."""
    rng = np.random.default_rng(0)
    points = rng.normal(size=(VERTICES, 3)).astype(np.float32)
    tangents = np.concatenate([points, np.ones((VERTICES, 1))], axis=1).astype(np.float32)
    joints = rng.integers(0, JOINTS, (VERTICES, INFLUENCES)).astype(np.int32)
    influences = rng.dirichlet(np.ones(INFLUENCES), VERTICES).astype(np.float32)
    turns = quaternion.normalized(rng.normal(size=(JOINTS, 4)))
    shifts = rng.normal(size=(JOINTS, 3))
    rigid = transform.compose(shifts, turns, np.ones((JOINTS, 3)))
    stretched = transform.compose(shifts, turns, rng.uniform(0.5, 2, (JOINTS, 3)))
    for what, skinning, matrices, bar in (
        ("linear", skin.linear_blend, rigid, ">= 100"),
        ("dual quaternion", skin.dual_quaternion, rigid, ">= half of linear"),
        ("dual quaternion, stretched", skin.dual_quaternion, stretched, ">= half of linear"),
    ):
        run = partial(skinning, points, points, tangents, joints, influences, matrices)
        rate = VERTICES * INFLUENCES / median(run) / 1e6
        yield results.Row(f"skinning, {what}, 100k x 4, {jit.threads()} threads", rate, unit="M/s", bar=bar)


def sampling() -> Iterator[results.Row]:
    """Local and world transforms at random times on one thread; three tracks of 300 keys to a joint."""
    times = np.random.default_rng(1).uniform(-0.5, 10.5, TIMES)
    with one_thread():
        for joints in (19, 65):
            rate = joints * TIMES / median(partial(worlds, marionette(joints), times)) / 1e6
            yield results.Row(
                f"joints sampled, {joints} at 10k random times, 1 thread", rate, unit="M/s", bar=">= 6"
            )


def against_threejs() -> Iterator[results.Row]:
    """The same joints, keys and times in three.js's mixer; nothing where the tests have not fetched it."""
    package = THREEJS / "node_modules" / "three" / "package.json"
    if not (package.exists() and shutil.which("node")):
        print("three.js is not in build/threejs; tests/motion/test_threejs.py puts it there")
        return
    scene = marionette(65)
    times = np.random.default_rng(2).uniform(0, 10, 1000)
    program = shutil.copy(Path(__file__).with_name("mixer.mjs"), THREEJS / "mixer_speed.mjs")
    with subprocess.Popen(
        ["node", program], cwd=THREEJS, text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as node:
        assert node.stdin is not None and node.stdout is not None

        def ask(line: str) -> None:
            print(line, file=node.stdin, flush=True)
            node.stdout.readline()

        ask(json.dumps(described(scene, times)))
        with one_thread():
            duel = peers.alternate(partial(worlds, scene, times), partial(ask, "again"), ROUNDS)
        node.stdin.close()
    version = json.loads(package.read_text())["version"]
    yield results.Row(
        "65 joints at 1000 random times, 1 thread", duel.ours * 1e3, duel.theirs * 1e3,
        f"three.js {version}", bar="<= 1/3",
    )  # fmt: skip


def described(scene: Scene, times: np.ndarray) -> dict[str, object]:
    """A scene's tree and tracks as JSON takes them."""
    tracks = scene.clips[0].tracks  # type: ignore[attr-defined]
    return {
        "parents": [node.parent for node in scene.nodes],
        "times": times.tolist(),
        "tracks": [
            {
                "node": scene.find(track.name),
                "property": track.property,
                "times": track.curve.times.tolist(),
                "values": track.curve.values.reshape(-1).tolist(),
            }
            for track in tracks
        ],
    }


def worlds(scene: Scene, times: np.ndarray) -> np.ndarray:
    """What is measured: no part of it is kept from one call to the next."""
    return scene.sample(times).world


def marionette(joints: int) -> Scene:
    """Joints in five chains, all moved, turned and scaled for ten seconds at 30 keys a second."""
    rng = np.random.default_rng(joints)
    times = np.arange(300) / 30
    nodes = tuple(Node(f"joint {index}", parent=max(-1, index - 5)) for index in range(joints))
    scene = Scene(nodes)
    tracks = []
    for path in scene.paths:
        tracks.append(Track("node", path, "translation", Curve(times, rng.normal(size=(300, 3)))))
        tracks.append(Track("node", path, "rotation", Curve(times, rng.normal(size=(300, 4)), rotation=True)))
        tracks.append(Track("node", path, "scale", Curve(times, rng.uniform(0.9, 1.1, (300, 3)))))
    return Scene(nodes, (Clip("dance", tracks),))


@contextmanager
def one_thread() -> Iterator[None]:
    """Kernels on the caller's thread alone."""
    kept = os.environ.get("EYELINE_THREADS")
    os.environ["EYELINE_THREADS"] = "1"
    jit.threads.cache_clear()
    try:
        yield
    finally:
        os.environ.pop("EYELINE_THREADS")
        if kept is not None:
            os.environ["EYELINE_THREADS"] = kept
        jit.threads.cache_clear()


def median(run: peers.Run) -> float:
    """Seconds of one run, after one unmeasured."""
    run()
    return statistics.median(peers.seconds(run) for _ in range(ROUNDS))


if __name__ == "__main__":
    main()
