"""A picture that is made when it is asked for is the picture."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import soups
from eyeline.errors import GeometryError
from eyeline.projection import project
from eyeline.projection.project import whole
from eyeline.projection.promised import LATER
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

SIZE = (60, 40)
TRIANGLE = Mesh([(-1, -1, 0), (1, -1, 0), (0, 1, 0)], [(0, 1, 2)])


def test_nothing_is_made_before_it_is_asked_for() -> None:
    projected = project(*soups.around_the_eye(3), SIZE)
    assert not set(LATER) & set(vars(projected))
    assert len(projected.depth) == len(projected.xy)
    assert set(LATER) <= set(vars(projected))


@pytest.mark.parametrize("cull", ["auto", "back", "none"])
def test_what_is_promised_is_what_is_made(cull: str) -> None:
    projected = project(*soups.around_the_eye(4), SIZE, cull)
    names = ("face_count", "first_faces", "surfaces", "camera", "width", "height")
    made = whole(cull, {name: getattr(projected, name) for name in names})
    for name in LATER:
        assert np.array_equal(getattr(projected, name), getattr(made, name))


def test_a_shifted_promise_is_one_and_keeps_it() -> None:
    projected = project(*soups.around_the_eye(5), SIZE)
    shifted = projected.shifted(3, -5).shifted(1, 1)
    assert shifted.standing_by == "auto"
    assert shifted.shift == (4, -4)
    assert not set(LATER) & set(vars(shifted))
    assert np.array_equal(shifted.xy, projected.xy - np.array([4, -4]))
    assert shifted.faces is projected.faces


def test_what_was_changed_is_no_promise() -> None:
    projected = project(*soups.around_the_eye(6), SIZE)
    only = projected.only(np.arange(projected.face_count) % 2 == 0)
    turned = replace(projected, faces=projected.faces[:, ::-1].copy())
    for changed in (only, turned, only.shifted(1, 1)):
        assert changed.standing_by is None
        assert set(LATER) <= set(vars(changed))


def test_a_place_that_is_not_finite_is_refused_before_anything_is_asked() -> None:
    lost = np.eye(4)
    lost[0, 3] = np.inf
    with pytest.raises(GeometryError, match="stands at a place that is not finite"):
        project(Scene.of(Node("lost", mesh=TRIANGLE, matrix=lost)), Camera(fov=1.0, near=0.1), SIZE)


def test_more_faces_than_numbers_are_refused() -> None:
    mesh = Mesh(TRIANGLE.points, np.tile(TRIANGLE.faces, (300_000, 1)))
    places = np.tile(np.eye(4), (7200, 1, 1))
    with pytest.raises(GeometryError, match=r"2,160,000,000 faces; 2,147,483,647 can be numbered"):
        project(Scene.of(Node("many", mesh=mesh, instances=places)), Camera(fov=1.0, near=0.1), SIZE)


def test_what_is_not_there_is_not_promised() -> None:
    with pytest.raises(AttributeError, match="colour"):
        project(Scene.of(TRIANGLE), Camera(fov=1.0, near=0.1), SIZE).colour  # noqa: B018
