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

import data
import oracle
from eyeline.files import READERS, load
from eyeline.projection import project
from eyeline.scene.camera import Camera
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
