"""A limb: joints one under another, whose bones are turned to new directions in the world."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from eyeline.errors import SceneError
from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.constraints.space import parent_place, turn_of, turned
from eyeline.scene.pose import Samples


def joints_above(pose: Samples, end: int, count: int, name: str) -> list[int]:
    """The `count` joints above a node, the uppermost first, then the node itself."""
    joints = [end]
    while len(joints) <= count:
        parent = int(pose.parents[joints[0]])
        if parent < 0:
            there = f"{pose.paths[end]!r}; there are {len(joints) - 1}"
            raise SceneError(f"constraint {name!r} needs {count} joints above {there}")
        joints.insert(0, parent)
    return joints


def with_turns(
    pose: Samples, joints: Sequence[int], turns: Sequence[FloatArray], influence: FloatArray
) -> Samples:
    """The pose with joints, one under another, at world rotations (T, 4) each."""
    above = turn_of(parent_place(pose, joints[0]))
    for joint, turn in zip(joints, turns, strict=True):
        local = quaternion.multiply(above * (-1, -1, -1, 1), turn)
        blended = turned(pose.rotation[:, joint], quaternion.normalized(local), influence)
        pose = pose.placed(joint, rotation=blended)
        above = quaternion.multiply(above, blended)
    return pose


def between(start: FloatArray, end: FloatArray) -> FloatArray:
    """The shortest turns (T, 4) from directions (T, 3) of any length to others; none from or to nothing."""
    a, b = unit(start), unit(end)
    w = 1 + (a * b).sum(axis=1, keepdims=True)
    axis = np.cross(a, b)
    # Straight back: about any axis across
    across = unit(np.cross(a, np.eye(3)[np.abs(a).argmin(axis=1)]))
    back = w < 1e-12
    turn = np.concatenate([np.where(back, across, axis), np.where(back, 0, w)], axis=1)
    nothing = ((start == 0).all(axis=1) | (end == 0).all(axis=1))[:, None]
    return np.where(nothing, quaternion.IDENTITY, quaternion.normalized(turn))


def unit(vectors: FloatArray) -> FloatArray:
    """Vectors (T, 3) of length one; nothing stays nothing."""
    lengths = np.sqrt((vectors * vectors).sum(axis=-1, keepdims=True))
    scaled: FloatArray = vectors / np.where(lengths > 0, lengths, 1)
    return scaled
