"""Real models, each from twelve sides at three sizes: every method sees them as the oracle does.

At the end the run prints how much of the pictures the oracle could not decide.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import trimesh

import data
import oracle
from eyeline.files import READERS, load
from eyeline.projection import project
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS, visible_of

SIZES = ((64, 48), (320, 200), (960, 540))
GOLDEN = (1 + math.sqrt(5)) / 2
DIRECTIONS = tuple(  # the vertices of an icosahedron
    (0.0, a, b * GOLDEN)[turn:] + (0.0, a, b * GOLDEN)[:turn]
    for turn in range(3)
    for a, b in itertools.product((-1, 1), repeat=2)
)
MODELS = [path for path in data.every("mesh/*") + data.every("gltf/*") if path.suffix.lower() in READERS]
ANSWERING = [name for name, method in METHODS.items() if method.answers]

every_model = pytest.mark.parametrize("path", MODELS, ids=[path.name for path in MODELS])
Report = Callable[[str, object], None]


@cache
def posed(path: Path) -> Scene:
    return load(path).at(0.0)


def view(scene: Scene, direction: tuple[float, float, float]) -> Camera:
    """From far enough to see all, near enough to fill much of the picture."""
    middle = scene.bounds.centre
    eye = middle + np.array(direction) * scene.bounds.diagonal / math.hypot(*direction)
    return Camera.look_at(eye, middle, fov=math.radians(50)).fitted(scene.bounds)


def disagreement(scene: Scene, camera: Camera, size: tuple[int, int]) -> tuple[dict[str, int], int]:
    """The pixels at which each method is wrong, where it is, and how many the oracle cannot decide."""
    projected, truth = project(scene, camera, size), oracle.truth(scene, camera, size)
    reference = visible_of(projected)
    wrong = {}
    for name in ANSWERING:
        answer = METHODS[name](projected)
        different = truth.decidable & (answer.face != truth.face)
        if METHODS[name].exact:
            different |= answer.face != reference.face
            different |= answer.depth.view(np.int32) != reference.depth.view(np.int32)
        if different.any():
            wrong[name] = int(different.sum())
    return wrong, int((~truth.decidable).sum())


def climb(
    path: Path, views: Iterable[tuple[tuple[int, int], tuple[float, float, float]]], told: Report
) -> None:
    """Every view of a model; tells the undecidable pixels of each size, and all pixels."""
    scene, wrong = posed(path), {}
    undecidable = dict.fromkeys(SIZES, (0, 0))
    for size, direction in views:
        found, doubtful = disagreement(scene, view(scene, direction), size)
        wrong |= {(name, size, direction): count for name, count in found.items()}
        undecidable[size] = undecidable[size][0] + doubtful, undecidable[size][1] + size[0] * size[1]
    told("undecidable", {size: counts for size, counts in undecidable.items() if counts[1]})
    assert wrong == {}
    assert all(2 * doubtful <= pixels for doubtful, pixels in undecidable.values())


@every_model
def test_some_views_of_a_model_are_seen_as_the_oracle_sees_them(path: Path, record_property: Report) -> None:
    """Every third view in small pictures, one in larger ones."""
    small = itertools.product(SIZES[:1], DIRECTIONS[::3])
    climb(path, [*small, (SIZES[1], DIRECTIONS[1])], record_property)


@pytest.mark.slow
@every_model
def test_all_views_of_a_model_are_seen_as_the_oracle_sees_them(path: Path, record_property: Report) -> None:
    climb(path, itertools.product(SIZES, DIRECTIONS), record_property)


# --- an outside judge -------------------------------------------------------------------------------------


@pytest.mark.parametrize("turn", [0.0, 2.0, 4.0])
@pytest.mark.parametrize("name", ["stanford-bunny.obj", "teapot.obj", "spot.obj"])
def test_embree_sees_the_same_wherever_a_pixel_is_decidable(name: str, turn: float) -> None:
    embree = pytest.importorskip("embreex.rtcore_scene")
    construction = pytest.importorskip("embreex.mesh_construction")
    mesh = trimesh.load(data.data(f"mesh/{name}"), force="mesh", process=False)
    points, numbers = np.asarray(mesh.vertices, np.float32), np.asarray(mesh.faces)
    scene, size, angle = Scene.of(Mesh(points, numbers)), (640, 480), 0.9
    middle, radius = scene.bounds.centre, scene.bounds.diagonal / 2
    eye = middle + np.array([2 * math.sin(turn), 0.5, 2 * math.cos(turn)]) * radius
    camera = Camera.look_at(eye, middle, fov=angle, near=0.1 * radius)

    x, y = np.meshgrid(np.arange(size[0]) + 0.5, np.arange(size[1]) + 0.5)
    up = np.tan(angle / 2)
    through = [(2 * x / size[0] - 1) * up * size[0] / size[1], (1 - 2 * y / size[1]) * up, -np.ones_like(x)]
    directions = np.stack(through, axis=-1).reshape(-1, 3) @ camera.world_from_eye[:3, :3].T
    origins = np.tile(camera.world_from_eye[:3, 3].astype(np.float32), (len(directions), 1))
    world = embree.EmbreeScene()
    construction.TriangleMesh(world, points[numbers])
    theirs = world.run(origins, directions.astype(np.float32)).reshape(size[1], size[0])

    assert (theirs >= 0).mean() > 0.05
    projected, faces = project(scene, camera, size), oracle.screened(scene, camera, size)
    for method in ANSWERING:
        different = np.argwhere(METHODS[method](projected).face != theirs).tolist()
        assert len(different) < 0.01 * theirs.size
        assert [(method, *place) for place in different if faces.is_decidable(place[1], place[0])] == []
