"""Look at: a node turns one of its axes to a target, wherever either goes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from eyeline.errors import SceneError
from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.constraints.space import against, number, parent_place, turned, vector
from eyeline.scene.pose import Samples

TINY = np.finfo(np.float64).tiny
AXES = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1), "-x": (-1, 0, 0), "-y": (0, -1, 0), "-z": (0, 0, -1)}


@dataclass(frozen=True)
class LookAt:
    """Turns `axis` of a node to a target: another node's origin, or a place in the world.

    axis: which of the node's axes looks, "-z" as cameras and lights do. side: the axis kept upright, as
    near to `up` (world) as the look allows. offset: added to the target, metres, world. influence: 0..1.
    A target at the node itself, or straight along `up`, leaves the node's own turn, or its side, as it was.
    """

    name: str
    node: str
    target: str | None = None
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    axis: str = "-z"
    side: str = "y"
    up: tuple[float, float, float] = (0.0, 1.0, 0.0)
    influence: float = 1.0

    def __post_init__(self) -> None:
        """Refuse axes that are none, or one for both."""
        for axis in (self.axis, self.side):
            if axis not in AXES:
                raise SceneError(
                    f"constraint {self.name!r}: there is no axis {axis!r}; x, y, z, -x, -y or -z is needed"
                )
        if self.axis[-1] == self.side[-1]:
            raise SceneError(
                f"constraint {self.name!r} looks along {self.axis} and keeps {self.side} upright;"
                " two axes are needed"
            )

    def __call__(self, pose: Samples, moved: Mapping[str, FloatArray]) -> Samples:
        """The node turned; its place and scale stay."""
        node = pose.find(self.node)
        target = vector(moved, "offset", self.offset)
        if self.target is not None:
            target = target + pose.world[:, pose.find(self.target), :3, 3]
        place = pose.world[:, node]
        turn = self._turn(target - place[:, :3, 3], vector(moved, "up", self.up), place)
        before = pose.rotation[:, node]
        after = against(parent_place(pose, node), turn)
        return pose.placed(node, rotation=turned(before, after, number(moved, "influence", self.influence)))

    def _turn(self, way: FloatArray, up: FloatArray, place: FloatArray) -> FloatArray:
        """World rotations (T, 4) whose axis goes the way."""
        axis, side = np.array(AXES[self.axis], float), np.array(AXES[self.side], float)
        own = place[:, :3, :3] / np.maximum(np.linalg.norm(place[:, :3, :3], axis=1, keepdims=True), TINY)
        length = np.linalg.norm(way, axis=1, keepdims=True)
        ahead = np.where(length > 0, way / np.where(length > 0, length, 1), own @ axis)
        # What stands upright: `up` without its part along the look; where none is left, the node's own side
        upright = np.zeros_like(ahead)
        for wish in (own @ np.cross(axis, side), own @ side, np.broadcast_to(up, ahead.shape)):
            across = wish - (wish * ahead).sum(axis=1, keepdims=True) * ahead
            size = np.linalg.norm(across, axis=1, keepdims=True)
            is_across = size > 1e-9 * np.linalg.norm(wish, axis=1, keepdims=True)
            upright = np.where(is_across, across / np.where(size > 0, size, 1), upright)
        third = np.cross(ahead, upright)
        frame = np.stack([axis, side, np.cross(axis, side)], axis=-1)
        world = np.stack([ahead, upright, third], axis=-1) @ frame.T
        return quaternion.from_matrix(world)
