"""Chain: a tail, a spine or a tentacle reaches for a target, by FABRIK. [Aristidou11]"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from eyeline.errors import SceneError
from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.constraints.limb import between, joints_above, unit, with_turns
from eyeline.motion.constraints.space import number, turn_of, vector
from eyeline.scene.pose import Samples

ROUNDS = 64  # to the tip and back; ten do for most poses, a nearly stretched chain needs more
LEAN = 1e-3  # of the chain's length: what leans by less lies straight
NEAR = 1e-7  # of the chain's length: what is missed by less is reached


@dataclass(frozen=True)
class Chain:
    """Turns the `bones` joints above `end` so that it comes to the target; each as little as it need be.

    target: a node; `offset`, metres in the world, is added, or is the target itself. Out of reach, the
    chain is stretched towards it. influence: 0..1.
    """

    name: str
    end: str
    target: str | None = None
    bones: int = 3
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    influence: float = 1.0

    def __post_init__(self) -> None:
        """Refuse a chain of nothing."""
        if self.bones < 1:
            raise SceneError(f"constraint {self.name!r} has {self.bones} bones; 1 or more is needed")

    def __call__(self, pose: Samples, moved: Mapping[str, FloatArray]) -> Samples:
        """The chain bent; places and scales of its joints stay, and its end's turn against the last."""
        joints = joints_above(pose, pose.find(self.end), self.bones, self.name)
        world = pose.world
        places = np.stack([world[:, joint, :3, 3] for joint in joints], axis=1)
        after = reached(places, self._target(pose, moved))
        turns = []
        for index, joint in enumerate(joints[:-1]):
            swing = between(places[:, index + 1] - places[:, index], after[:, index + 1] - after[:, index])
            turns.append(quaternion.multiply(swing, turn_of(world[:, joint])))
        return with_turns(pose, joints[:-1], turns, number(moved, "influence", self.influence))

    def missed(self, pose: Samples, moved: Mapping[str, FloatArray] | None = None) -> FloatArray:
        """(T,) metres from the end to its target in a solved pose: more than 0 where it is out of reach."""
        gap = pose.world[:, pose.find(self.end), :3, 3] - self._target(pose, moved or {})
        lengths: FloatArray = np.sqrt((gap * gap).sum(axis=1))
        return lengths

    def _target(self, pose: Samples, moved: Mapping[str, FloatArray]) -> FloatArray:
        offset = np.broadcast_to(vector(moved, "offset", self.offset), (len(pose.translation), 3))
        if self.target is None:
            return offset
        return pose.world[:, pose.find(self.target), :3, 3] + offset


def reached(places: FloatArray, target: FloatArray) -> FloatArray:
    """Places (T, J, 3) of a chain's joints with its last at, or as near as can be to, targets (T, 3).

    Lengths of bones stay, and the first joint. Each time is solved by itself: any batch answers the same.
    """
    lengths = np.sqrt((np.diff(places, axis=1) ** 2).sum(axis=2))
    whole = lengths.sum(axis=1)
    root, away = places[:, 0], target - places[:, 0]
    far = np.pad(np.cumsum(lengths, axis=1), ((0, 0), (1, 0)))[:, :, None]
    straight = root[:, None] + unit(away)[:, None] * far
    beyond = np.sqrt((away * away).sum(axis=1)) >= whole
    found = _loosened(places, target)
    last = places.shape[1] - 1
    for _ in range(ROUNDS):
        missed = np.sqrt(((found[:, last] - target) ** 2).sum(axis=1))
        going = (missed > NEAR * whole) & ~beyond
        if not going.any():
            break
        there = found.copy()
        there[:, last] = target
        for joint in range(last - 1, -1, -1):
            way = unit(there[:, joint] - there[:, joint + 1])
            there[:, joint] = there[:, joint + 1] + lengths[:, joint, None] * way
        there[:, 0] = root
        for joint in range(1, last + 1):
            way = unit(there[:, joint] - there[:, joint - 1])
            there[:, joint] = there[:, joint - 1] + lengths[:, joint - 1, None] * way
        found = np.where(going[:, None, None], there, found)
    return np.where(beyond[:, None, None], straight, found)


def _loosened(places: FloatArray, target: FloatArray) -> FloatArray:
    """The chain; bent a little where it lies straight on the line to its target, where it could not fold."""
    line = unit(target - places[:, 0])
    arms = places - places[:, :1]
    aside = arms - (arms * line[:, None]).sum(axis=2, keepdims=True) * line[:, None]
    whole = np.sqrt((np.diff(places, axis=1) ** 2).sum(axis=2)).sum(axis=1)
    straight = np.sqrt((aside * aside).sum(axis=2)).max(axis=1) <= LEAN * whole
    across = unit(np.cross(line, np.eye(3)[np.abs(line).argmin(axis=1)]))
    bow = np.sin(np.linspace(0, np.pi, places.shape[1]))[:, None] * (LEAN * whole)[:, None, None]
    return np.where(straight[:, None, None], places + bow * across[:, None], places)
