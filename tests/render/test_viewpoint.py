from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import eyeline as el
from eyeline.errors import SceneError
from eyeline.geometry import transform
from eyeline.render.viewpoint import chosen_camera, orbited


@pytest.fixture
def two_cameras(sliding: el.Scene) -> el.Scene:
    nodes = [
        el.Node(name="front", camera=el.Camera(fov=1.0), translation=(0, 0, 5)),
        el.Node(name="1", camera=el.Camera(height=2.0), translation=(0, 9, 5)),
    ]
    return replace(sliding, nodes=(*sliding.nodes, *nodes))


def test_a_camera_goes_by_name_by_number_or_by_itself(two_cameras: el.Scene) -> None:
    front, above = two_cameras.cameras
    assert chosen_camera(two_cameras, None, 1.0) is front
    assert chosen_camera(two_cameras, "front", 1.0) is front
    assert chosen_camera(two_cameras, "0", 1.0) is front
    assert chosen_camera(two_cameras, 1, 1.0) is above
    assert chosen_camera(two_cameras, "1", 1.0) is above
    own = el.Camera(fov=0.5)
    assert chosen_camera(two_cameras, own, 1.0) is own


@pytest.mark.parametrize("name", ["frnt", 2, -1, "-1", "²", ""])
def test_an_unknown_camera_is_refused_with_those_there_are(two_cameras: el.Scene, name: str | int) -> None:
    with pytest.raises(SceneError, match=r"there is no camera .*; there is '"):
        chosen_camera(two_cameras, name, 1.0)


@pytest.mark.parametrize("aspect", [0.3, 1.0, 3.0])
def test_without_a_camera_everything_is_in_the_picture(sliding: el.Scene, aspect: float) -> None:
    camera = chosen_camera(sliding, None, aspect).fitted(sliding.bounds)
    corners = np.c_[sliding.bounds.corners, np.ones(8)]
    x, y, _, w = camera.clip_from_eye(aspect) @ camera.eye_from_world @ corners.T
    assert (w > 0).all() and (np.abs(x) <= w).all() and (np.abs(y) <= w).all()


def test_an_orbit_keeps_the_distance_and_comes_home(sliding: el.Scene) -> None:
    camera = chosen_camera(sliding, None, 1.0)
    middle = sliding.bounds.centre
    for turn in np.linspace(0, 2 * math.pi, 9):
        turned = orbited(camera, sliding.bounds, turn)
        before, now = camera.world_from_eye[:3, 3] - middle, turned.world_from_eye[:3, 3] - middle
        assert math.hypot(*now) == pytest.approx(math.hypot(*before))
        assert now[1] == pytest.approx(before[1])
        seen = (
            transform.apply(camera.eye_from_world, middle[None]),
            transform.apply(turned.eye_from_world, middle[None]),
        )
        assert seen[0] == pytest.approx(seen[1])
    assert turned.world_from_eye == pytest.approx(camera.world_from_eye)
    quarter = orbited(camera, sliding.bounds, math.pi / 2).world_from_eye[:3, 3] - middle
    start = camera.world_from_eye[:3, 3] - middle
    assert quarter == pytest.approx([start[2], start[1], -start[0]])
