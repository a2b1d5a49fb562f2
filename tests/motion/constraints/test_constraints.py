"""Look at, follow, follow path: where the node ends, whatever stands above it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from eyeline.errors import SceneError
from eyeline.geometry import quaternion
from eyeline.motion import Clip, Curve, Track
from eyeline.motion.constraints import Follow, FollowPath, LookAt
from eyeline.motion.constraints.look_at import AXES
from eyeline.motion.path import Path
from eyeline.scene.constraint import Constraint
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

TILT = tuple(quaternion.from_axis_angle((0.6, 0.0, 0.8), 1.1).tolist())
PARENT = Node("stand", translation=(1, 2, 3), rotation=TILT, scale=(2, 2, 2))
NODES = (PARENT, Node("eye", parent=0, translation=(0.5, 0, 0)), Node("aim", translation=(4, -1, 7)))
SWAY = Clip("sway", [Track("node", "aim", "translation", Curve([0, 1], [(4, -1, 7), (-6, 3, 0)]))])


def posed(constraint: Constraint, time: float = 0.4) -> Scene:
    return Scene(NODES, (SWAY,), constraints=(constraint,)).at(time)


@pytest.mark.parametrize("axis", AXES)
def test_the_axis_that_looks_meets_the_target(axis: str) -> None:
    side = "x" if axis.endswith("y") else "y"
    scene = posed(LookAt("look", "stand/eye", "aim", axis=axis, side=side))
    place, aim = scene.world[1], scene.world[2, :3, 3]
    way = (aim - place[:3, 3]) / np.linalg.norm(aim - place[:3, 3])
    turn = place[:3, :3] / np.linalg.norm(place[:3, :3], axis=0)
    assert np.allclose(turn @ AXES[axis], way, atol=1e-12)
    upright = turn @ AXES[side]
    assert np.cross(upright, way) @ np.cross((0, 1, 0), way) > 0
    assert abs(np.cross((0, 1, 0), way) @ upright) < 1e-12


def test_looking_straight_up_keeps_a_frame() -> None:
    scene = posed(LookAt("look", "stand/eye", offset=(1.0, 50.0, 3.0)), 0.0)
    assert np.isfinite(scene.world).all()
    up = replace(PARENT, rotation=quaternion.IDENTITY)
    above = Scene((up, NODES[1]), constraints=(LookAt("look", "stand/eye", offset=(2.0, 9.0, 3.0)),)).at(0)
    matrix = above.world[1, :3, :3] / 2
    assert np.allclose(matrix @ matrix.T, np.eye(3), atol=1e-12)
    assert np.allclose(-matrix[:, 2], (0, 1, 0))


def test_half_an_influence_turns_half_the_way() -> None:
    whole, half = (posed(LookAt("look", "eye", "aim", influence=part))["eye"] for part in (1.0, 0.5))
    angles = [2 * math.acos(min(1.0, abs(node.rotation[3]))) for node in (whole, half)]
    assert angles[1] == pytest.approx(angles[0] / 2)


def test_a_follower_keeps_its_offset() -> None:
    scene = posed(Follow("behind", "stand/eye", "aim", (0, 1, 0)))
    assert np.allclose(scene.world[1, :3, 3], scene.world[2, :3, 3] + (0, 1, 0))


def test_a_follower_that_turns_is_carried() -> None:
    scene = Scene(NODES, constraints=(Follow("on", "aim", "stand", (0, 0, 1), turns=True),)).at(0)
    stand = scene.world[0]
    assert np.allclose(scene.world[2, :3, 3], stand[:3, 3] + stand[:3, 2] / 2)
    assert np.allclose(scene.world[2, :3, :3], stand[:3, :3] / 2)


@pytest.mark.parametrize("ahead", ["-z", "z", "x", "-x"])
def test_a_traveller_is_where_its_number_says(ahead: str) -> None:
    path = Path.through([(0, 0, 0), (2, 1, 0), (3, 0, 2)])
    ride = FollowPath("ride", "stand/eye", path, ahead=ahead)
    clip = Clip("go", [Track("constraint", "ride", "along", Curve([0, 2], [0.0, path.length]))])
    scene = Scene(NODES, (clip,), constraints=(ride,))
    for time in (0.0, 0.7, 2.0):
        place = scene.at(time).world[1]
        assert np.allclose(place[:3, 3], path.at([path.length * time / 2])[0], atol=1e-12)
        way = path.directions([path.length * time / 2])[0]
        assert np.allclose(place[:3, :3] / 2 @ AXES[ahead], way, atol=1e-9)


def test_axes_that_make_no_frame_are_refused() -> None:
    with pytest.raises(SceneError, match="two axes are needed"):
        LookAt("look", "eye", axis="y", side="-y")
    with pytest.raises(SceneError, match="there is no axis 'w'"):
        LookAt("look", "eye", axis="w")
    with pytest.raises(SceneError, match="ahead is 'y'"):
        FollowPath("ride", "eye", Path.circle((0, 0, 0), 1), ahead="y")
