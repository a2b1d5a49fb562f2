"""Joints and weights of vertices, four to a set. [glTF 2.0, 3.7.3.3]"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from eyeline.geometry.arrays import FloatArray, IntArray

SET = 4  # joints in one attribute
BYTE = 256  # joints that one byte can name


def sets_of(joints: IntArray, influences: FloatArray) -> dict[str, npt.NDArray[Any]]:
    """JOINTS_n and WEIGHTS_n; a joint is named once for each vertex, and one that moves nothing is 0."""
    joints, influences = merged(joints, influences)
    width = -joints.shape[1] % SET
    joints = np.pad(joints, ((0, 0), (0, width)))
    influences = np.pad(influences, ((0, 0), (0, width)))
    kind = np.uint8 if joints.max(initial=0) < BYTE else np.uint16
    made: dict[str, npt.NDArray[Any]] = {}
    for number in range(joints.shape[1] // SET):
        part = slice(SET * number, SET * (number + 1))
        made[f"JOINTS_{number}"] = joints[:, part].astype(kind)
        made[f"WEIGHTS_{number}"] = influences[:, part]
    return made


def merged(joints: IntArray, influences: FloatArray) -> tuple[IntArray, FloatArray]:
    """The same influences with each joint of a vertex named once: the first takes what the others have."""
    joints, influences = joints.copy(), influences.copy()
    for later in range(1, joints.shape[1]):
        for earlier in range(later):
            again = (joints[:, earlier] == joints[:, later]) & (influences[:, later] > 0)
            again &= influences[:, earlier] > 0
            influences[again, earlier] += influences[again, later]
            influences[again, later] = 0
    joints[influences == 0] = 0
    return joints, influences
