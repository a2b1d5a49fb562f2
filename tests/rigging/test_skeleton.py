"""Skeletons: joints stand where they are said to, with the world's axes."""

from __future__ import annotations

import numpy as np
import pytest

import eyeline as el
from eyeline.errors import SceneError


def test_joints_stand_where_they_are_said_to():
    joints = el.skeleton(
        {"hip": (None, (0, 1, 0)), "knee": ("hip", (0.1, 0.5, 0)), "toe": ("knee", (0, 0, 0.2))}
    )
    scene = el.Scene(joints)
    assert scene.paths == ("hip", "hip/knee", "hip/knee/toe")
    np.testing.assert_allclose(scene.world[:, :3, 3], [(0, 1, 0), (0.1, 0.5, 0), (0, 0, 0.2)], atol=1e-15)
    np.testing.assert_array_equal(scene.world[:, :3, :3], np.tile(np.eye(3), (3, 1, 1)))


@pytest.mark.parametrize(
    ("joints", "sentence"),
    [
        ({"knee": ("hip", (0, 0, 0))}, "joint 'knee' has the parent 'hip', which does not come before it"),
        ({"hip": (None, (0, 0))}, "joint 'hip' is at .* three finite numbers are needed"),
        ({"hip": (None, (0, np.nan, 0))}, "three finite numbers are needed"),
    ],
)
def test_what_is_no_skeleton_is_refused(joints, sentence):
    with pytest.raises(SceneError, match=sentence):
        el.skeleton(joints)
