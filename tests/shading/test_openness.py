"""Creases and contacts are darker; what is flat and alone is not."""

from __future__ import annotations

import numpy as np

from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.shading.lanes import OPEN, Y
from eyeline.shading.look import Look
from eyeline.shading.openness import look_up
from eyeline.shading.stage import stage_of
from frames import frame_of, lanes_of, square

BARE = Look(ground="off")


def openness(scene: Scene, camera: Camera, look: Look = BARE) -> tuple[np.ndarray, np.ndarray]:
    """The lanes of a frame with OPEN filled."""
    frame = frame_of(scene, camera, (256, 256), look=look)
    lanes, _, _ = lanes_of(frame)
    look_up(lanes, lanes.shape[1], stage_of(frame).openness)
    return lanes[OPEN], lanes


def crease(angle: float) -> Scene:
    """Two squares of a metre that meet at y = 0, each turned by half the angle out of one plane."""
    up, back = np.cos(angle), np.sin(angle)
    points = [(-1, 0, 0), (1, 0, 0), (1, up, back), (-1, up, back), (1, -up, back), (-1, -up, back)]
    return Scene.of(Mesh(np.array(points) - (0, 0, 3), [(0, 1, 2), (0, 2, 3), (5, 4, 1), (5, 1, 0)]))


def test_a_plane_is_open_from_any_side():
    for eye in ((0, 0, 4), (2, 1, 2), (3, 0, 0.8)):
        camera = Camera.look_at((eye[0], eye[1], eye[2] - 2), (0, 0, -2), fov=0.3)
        found, _ = openness(Scene.of(square()), camera)
        assert len(found) > 20
        assert found.min() > 0.98


def test_a_crease_is_darker_at_its_bottom_and_a_ridge_is_not():
    camera = Camera(fov=0.6, near=0.1)
    found, lanes = openness(crease(0.7), camera)
    near_bottom = abs(lanes[Y]) < 0.03
    assert found[near_bottom].mean() < 0.85
    assert found[abs(lanes[Y]) > 0.4].mean() > 0.97
    ridge, _ = openness(crease(-0.7), camera)
    assert ridge.mean() > 0.98


def test_the_floor_darkens_what_stands_on_it():
    camera = Camera.look_at((0, 0.6, 4), (0, 0, -2), fov=0.2)
    with_floor, lanes = openness(Scene.of(square()), camera, Look())
    foot = lanes[Y] < lanes[Y].min() + 0.04
    assert with_floor[foot].mean() < 0.96
    assert with_floor[~foot].max() > 0.99


def test_amount_zero_darkens_nothing():
    found, _ = openness(crease(0.7), Camera(fov=0.6, near=0.1), Look(occlusion=0.0, ground="off"))
    assert (found == 1).all()
