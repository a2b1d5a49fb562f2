"""Lenses, and where a camera must stand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from eyeline.errors import GeometryError
from eyeline.geometry import transform
from eyeline.geometry.bounds import Bounds
from eyeline.scene.camera import FILLED, Camera, fov_of


def screen(camera: Camera, points: np.ndarray, aspect: float) -> np.ndarray:
    """Points (N, 3) of the world on the screen, -1..1."""
    clip = camera.clip_from_eye(aspect) @ camera.eye_from_world
    moved = np.column_stack([points, np.ones(len(points))]) @ clip.T
    return moved[:, :3] / moved[:, 3:]


@pytest.mark.parametrize("aspect", [16 / 9, 1.0, 0.3])
@pytest.mark.parametrize("high", [(1, 1, 1), (1, 20, 1), (9, 0.1, 3), (0, 0, 2)])
def test_a_framed_box_touches_the_margin_and_stays_within(aspect, high):
    box = Bounds(np.array([-0.5, 0, -1]), np.array([-0.5, 0, -1]) + high)
    shown = np.abs(screen(Camera.framing(box, aspect).fitted(box), box.corners, aspect)[:, :2]).max()
    assert shown == pytest.approx(FILLED, rel=1e-9)


def test_an_empty_box_is_framed_like_one_of_a_metre():
    camera = Camera.framing(Bounds.empty())
    assert np.isfinite(camera.world_from_eye).all()


def test_depth_is_one_at_the_near_plane_and_nought_at_the_far():
    for lens in ({"fov": 1.0}, {"height": 2.0}):
        camera = Camera(**lens, near=0.5, far=8.0)
        depth = screen(camera, np.array([[0, 0, -0.5], [0, 0, -8.0]]), 1.0)[:, 2]
        np.testing.assert_allclose(depth, [1, 0], atol=1e-12)


def test_without_a_far_plane_depth_is_near_over_distance():
    camera = Camera(fov=1.0, near=0.5)
    np.testing.assert_allclose(screen(camera, np.array([[0, 0, -4.0]]), 1.0)[0, 2], 0.5 / 4)


def test_a_24_mm_lens_sees_as_high_as_it_is_far_from_its_sensor():
    assert fov_of(12.0) == pytest.approx(math.radians(90))
    camera = Camera.look_at((0, 0, 5), (0, 0, 0), focal_length=50)
    assert camera.focal_length == pytest.approx(50)


def test_the_target_stands_in_the_middle():
    camera = Camera.look_at((3, 2, 5), (1, 1, 1)).fitted(Bounds(np.zeros(3), np.ones(3)))
    np.testing.assert_allclose(screen(camera, np.array([[1.0, 1, 1]]), 1.5)[0, :2], 0, atol=1e-12)


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: Camera(), "either a field of view or an orthographic height"),
        (lambda: Camera(fov=4.0), "fov is 4.0 radians"),
        (lambda: Camera(height=-1.0), "height is -1.0 metres"),
        (lambda: Camera(fov=1.0, near=0.0), "near is 0.0"),
        (lambda: Camera(fov=1.0, near=1.0, far=0.5), "far is 0.5"),
        (lambda: Camera.look_at((0, 0, 0), (0, 0, 0)), "must be two finite points"),
        (lambda: Camera.look_at((0, 1, 0), (0, 0, 0)), "lies along the view"),
        (lambda: Camera.look_at((0, 0, 1), (0, 0, 0), fov=1.0, height=1.0), "exclude each other"),
        (lambda: Camera.look_at((0, 0, 1), (0, 0, 0), focal_length=0), "focal_length is 0 mm"),
    ],
)
def test_a_lens_that_cannot_see_is_refused(make, sentence):
    with pytest.raises(GeometryError, match=sentence):
        make()


def test_a_camera_is_moved_without_its_lens():
    camera = Camera(fov=1.0)
    place = transform.look_at((1, 2, 3), (0, 0, 0))
    assert camera.moved(place).fov == 1.0
    np.testing.assert_array_equal(camera.moved(place).world_from_eye, place)
