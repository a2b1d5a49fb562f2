"""What constraints share: nodes' places in the world, and back, at all times at once."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from eyeline.geometry import quaternion, transform
from eyeline.geometry.arrays import FloatArray
from eyeline.scene.pose import Samples


def number(moved: Mapping[str, FloatArray], name: str, rest: float) -> FloatArray:
    """A constraint's number: where a track moves it (T, 1), else its field, to be spread."""
    return moved[name].reshape(-1, 1) if name in moved else np.array([[float(rest)]])


def vector(moved: Mapping[str, FloatArray], name: str, rest: tuple[float, ...]) -> FloatArray:
    """A constraint's vector: where a track moves it (T, n), else its field (1, n)."""
    return moved[name] if name in moved else np.array([rest], dtype=np.float64)


def parent_place(pose: Samples, node: int) -> FloatArray:
    """world_from_parent (T, 4, 4) of a node; the world itself for a root."""
    parent = pose.parents[node]
    if parent < 0:
        return np.broadcast_to(np.eye(4), (len(pose.translation), 4, 4))
    return pose.world[:, parent]


def into(world_from_parent: FloatArray, places: FloatArray) -> FloatArray:
    """World places (T, 3) against a parent; one that is squashed flat is taken as it stands."""
    moved = places - world_from_parent[:, :3, 3]
    axes = world_from_parent[:, :3, :3]
    flat = np.linalg.det(axes) == 0
    axes = np.where(flat[:, None, None], np.eye(3), axes)
    against: FloatArray = np.linalg.solve(axes, moved[:, :, None])[:, :, 0]
    return against


def turn_of(matrices: FloatArray) -> FloatArray:
    """The rotation (T, 4) in affine matrices (T, 4, 4)."""
    return transform.decompose(matrices)[1]


def against(world_from_parent: FloatArray, turns: FloatArray) -> FloatArray:
    """World rotations (T, 4) against a parent."""
    parent = turn_of(world_from_parent)
    return quaternion.multiply(parent * (-1, -1, -1, 1), turns)


def blended(before: FloatArray, after: FloatArray, influence: FloatArray) -> FloatArray:
    """Numbers (T, n) part of the way from before to after; exactly after at influence 1."""
    part = np.clip(influence, 0, 1)
    mixed: FloatArray = np.where(part >= 1, after, before + part * (after - before))
    return mixed


def turned(before: FloatArray, after: FloatArray, influence: FloatArray) -> FloatArray:
    """Rotations (T, 4) part of the way along the shorter arc."""
    part = np.broadcast_to(np.clip(influence, 0, 1), (len(before), 1))
    return np.where(part >= 1, after, quaternion.slerp(before, after, part[:, 0]))
