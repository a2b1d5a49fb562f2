"""Octree against our depth buffer: a million faces, a deep scene, and a city that grows to a billion faces.

`python -m benchmarks.octree [plain deep city]`. Rivals go from scene to arrays, in turn in one run. The trees
are kept with their meshes: what they take is told beside, and counted in no other row.
"""

from __future__ import annotations

import math
import subprocess
import sys
import time

import numpy as np

from benchmarks import peers, results
from benchmarks.zbuffer import status
from eyeline.geometry.octree import octree_of
from eyeline.projection import project
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS, Visible

SIZE = (1920, 1080)
CAMERA = Camera.look_at((1.2, 0.9, 2.8), (0, 0, 0), near=0.1)
ROUNDS = 9
TOWER, LADDER = 100_000, (10, 100, 1_000, 10_000)  # faces of a tower, and how many towers stand
STREET = 6.0  # metres from tower to tower
EXPONENT = 0.3


def seen(scene: Scene, camera: Camera, method: str) -> Visible:
    """From scene to arrays."""
    return METHODS[method](project(scene, camera, SIZE))


def duel(what: str, scene: Scene, camera: Camera, bar: str) -> results.Row:
    """The octree and the depth buffer on one scene."""
    ours, theirs = seen(scene, camera, "octree"), seen(scene, camera, "zbuffer")
    if not (np.array_equal(ours.face, theirs.face) and np.array_equal(ours.depth, theirs.depth)):
        raise SystemExit(f"{what}: the answers differ")
    measured = peers.alternate(
        lambda: seen(scene, camera, "octree"), lambda: seen(scene, camera, "zbuffer"), ROUNDS
    )
    print(f"{what}: {measured}   {dict(ours.work)}", flush=True)
    return results.Row(what, measured.ours * 1e3, measured.theirs * 1e3, "our zbuffer", bar=bar)


def plain() -> list[results.Row]:
    """One mesh of a million faces, and what its tree takes."""
    mesh = Mesh(*peers.bumpy_sphere(1_000_000))
    row = duel("octree, 1920x1080, 1M faces", Scene.of(mesh), CAMERA, "<= 2")
    built = min(peers.seconds(lambda: octree_of(mesh.points, mesh.faces)) for _ in range(5))
    return [row, results.Row("octree of 1M faces, once", built * 1e3, bar="none")]


def deep() -> list[results.Row]:
    """A hundred sheets of 100,000 faces, each behind the one before; as one mesh, and as instances."""
    cells = 224
    u, v = (axis.reshape(-1) for axis in np.meshgrid(*[np.linspace(-1, 1, cells + 1)] * 2))
    sheet = np.stack([1.6 * u, 0.9 * v, 0.01 * np.sin(9 * u) * np.cos(7 * v)], axis=1)
    at = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).reshape(-1)
    two = [np.stack([at, at + 1, at + cells + 2], 1), np.stack([at, at + cells + 2, at + cells + 1], 1)]
    faces, layers = np.concatenate(two), 100
    behind = np.array([(0, 0, -0.05 * k) for k in range(layers)])
    camera = Camera.look_at((0, 0, 2), (0, 0, 0), near=0.1)
    points = (sheet + behind[:, None]).reshape(-1, 3)
    every = (faces + len(sheet) * np.arange(layers)[:, None, None]).reshape(-1, 3)
    places = np.tile(np.eye(4), (layers, 1, 1))
    places[:, :3, 3] = behind
    one = Scene.of(Mesh(points, every))
    many = Scene.of(Node("sheets", mesh=Mesh(sheet, faces), instances=places))
    return [
        duel("octree, 1920x1080, 10M faces in 100 layers, one mesh", one, camera, "<= 1/2"),
        duel("octree, 1920x1080, 10M faces in 100 layers, instances", many, camera, "<= 1/2"),
    ]


# --- a city -----------------------------------------------------------------------------------------------


def city(towers: int) -> tuple[Scene, Camera]:
    """So many towers on a square of streets, each turned another way, seen by who walks there."""
    points, faces = peers.bumpy_sphere(TOWER)
    side = math.ceil(math.sqrt(towers))
    row, column = np.divmod(np.arange(towers), side)
    turn = 2.4 * np.arange(towers)
    places = np.tile(np.eye(4), (towers, 1, 1))
    places[:, 0, 0] = places[:, 2, 2] = np.cos(turn)
    places[:, 0, 2], places[:, 2, 0] = np.sin(turn), -np.sin(turn)
    places[:, 0, 3], places[:, 2, 3] = STREET * (column - side // 2), -STREET * row
    # Squared, as towers are
    square = np.sign(points) * np.abs(points) ** np.float32(0.3)
    mesh = Mesh(square * np.float32([2, 5, 2]) + np.float32([0, 5, 0]), faces)
    far = STREET * side
    ground = Mesh([(-far, 0, 9), (far, 0, 9), (far, 0, -far), (-far, 0, -far)], [(0, 1, 2), (0, 2, 3)])
    camera = Camera.look_at((STREET / 2, 1.7, 8), (-0.6, 3.0, -12), near=0.1, fov=math.radians(60))
    return Scene.of(Node("towers", mesh=mesh, instances=places), ground), camera


def climbed() -> list[results.Row]:
    """Time and memory on every rung, each in a process of its own."""
    rows, times = [], []
    for towers in LADDER:
        command = [sys.executable, "-m", "benchmarks.octree", "--city", str(towers)]
        told = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
        seconds, grown = float(told[0]), int(told[1])
        times.append(seconds)
        what = f"octree, 1920x1080, city of {towers * TOWER:.0e} faces"
        rows.append(results.Row(what, seconds * 1e3, bar=f"grows below faces^{EXPONENT}"))
        rows.append(results.Row(f"{what}, memory", grown / 1e6, unit="MB", bar="<= unique faces + 1 GB"))
        print(rows[-2], rows[-1], *told[2:], flush=True)
    exponents = np.diff(np.log10(times)) / np.diff(np.log10(LADDER))
    whole = math.log10(times[-1] / times[0]) / math.log10(LADDER[-1] / LADDER[0])
    print(f"time grows as faces^{whole:.2f}; from rung to rung {np.round(exponents, 2).tolist()}", flush=True)
    return rows


def rung(towers: int) -> str:
    """Seconds of a frame, the least of several; bytes the process grew by; and what was counted."""
    seen(*city(1), "octree")
    before = status("VmRSS")
    scene, camera = city(towers)
    scene.surfaces  # noqa: B018  posed once
    answer = seen(scene, camera, "octree")
    times = [peers.seconds(lambda: seen(scene, camera, "octree")) for _ in range(ROUNDS)]
    grown = status("VmHWM") - before
    return f"{min(times)} {grown} {dict(answer.work)} {time.process_time():.1f}"


PROGRAMS = {"plain": plain, "deep": deep, "city": climbed}


def main(arguments: list[str]) -> None:
    if arguments[:1] == ["--city"]:
        print(rung(int(arguments[1])))
        return
    results.record("octree", [row for name in arguments or PROGRAMS for row in PROGRAMS[name]()])


if __name__ == "__main__":
    main(sys.argv[1:])
