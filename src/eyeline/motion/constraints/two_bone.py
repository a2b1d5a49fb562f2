"""Two bones: an arm or a leg reaches for a target, its elbow or knee towards a pole; in closed form."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.constraints.limb import between, joints_above, unit, with_turns
from eyeline.motion.constraints.space import number, turn_of, vector
from eyeline.scene.pose import Samples


@dataclass(frozen=True)
class TwoBone:
    """Turns the two joints above `end` so that it comes to the target.

    end: the hand or the foot. target: a node; `offset`, metres in the world, is added, or is the target
    itself. pole: a node on whose side the middle joint bends; without one it bends as it does.
    keeps_turn: the end stays turned in the world as it was, or with `turns` as the target is.
    Out of reach, the limb is stretched towards the target, or folded. influence: 0..1.
    """

    name: str
    end: str
    target: str | None = None
    pole: str | None = None
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    keeps_turn: bool = True
    turns: bool = False
    influence: float = 1.0

    def __call__(self, pose: Samples, moved: Mapping[str, FloatArray]) -> Samples:
        """The limb bent; places and scales of its joints stay."""
        joints = joints_above(pose, pose.find(self.end), 2, self.name)
        world = pose.world
        a, b, c = (world[:, joint, :3, 3] for joint in joints)
        aim = self._target(pose, moved)
        pole = None if self.pole is None else world[:, pose.find(self.pole), :3, 3] - a
        elbow, hand = bent(a, b, c, aim, pole)
        roots = [turn_of(world[:, joint]) for joint in joints]
        upper, lower = _swings((a, b, c), (a, elbow, hand))
        end = roots[2] if self.keeps_turn else quaternion.multiply(lower, roots[2])
        if self.turns and self.target is not None:
            end = turn_of(world[:, pose.find(self.target)])
        turns = [quaternion.multiply(upper, roots[0]), quaternion.multiply(lower, roots[1]), end]
        return with_turns(pose, joints, turns, number(moved, "influence", self.influence))

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


def bent(
    a: FloatArray, b: FloatArray, c: FloatArray, aim: FloatArray, pole: FloatArray | None
) -> tuple[FloatArray, FloatArray]:
    """Where elbow and hand (T, 3) come, of a limb a b c that reaches for an aim; pole: a direction from a."""
    upper, lower = (np.sqrt((bone * bone).sum(axis=1)) for bone in (b - a, c - b))
    way = np.where((aim == a).all(axis=1, keepdims=True), c - a, aim - a)
    ahead = unit(way)
    wanted = np.sqrt(((aim - a) ** 2).sum(axis=1))
    reach = np.clip(wanted, np.abs(upper - lower), upper + lower)
    # The triangle of upper, lower and reach: how far along and how far aside its elbow is
    safe = np.where(reach > 0, reach, 1)
    along = (upper * upper - lower * lower + reach * reach) / (2 * safe)
    aside = np.sqrt(np.maximum(upper * upper - along * along, 0))
    side = np.zeros_like(ahead)
    for wish in (np.eye(3)[np.abs(ahead).argmin(axis=1)], c - a - 2 * (b - a), b - a, pole):
        if wish is None:
            continue
        across = wish - (wish * ahead).sum(axis=1, keepdims=True) * ahead
        size = np.sqrt((across * across).sum(axis=1, keepdims=True))
        is_across = size > 1e-9 * np.sqrt((wish * wish).sum(axis=1, keepdims=True))
        side = np.where(is_across, across / np.where(size > 0, size, 1), side)
    elbow = a + along[:, None] * ahead + aside[:, None] * side
    return elbow, a + reach[:, None] * ahead


def _swings(
    before: tuple[FloatArray, FloatArray, FloatArray], after: tuple[FloatArray, FloatArray, FloatArray]
) -> tuple[FloatArray, FloatArray]:
    """Turns (T, 4) of the upper and the lower bone; the upper one takes its plane along."""
    bones = [(before[1] - before[0], after[1] - after[0]), (before[2] - before[1], after[2] - after[1])]
    upper = between(*bones[0])
    # Turn about the new upper bone until the lower one lies in the new plane
    axis = unit(bones[0][1])
    carried = _across(_turned_by(upper, bones[1][0]), axis)
    wanted = _across(bones[1][1], axis)
    upper = quaternion.multiply(between(carried, wanted), upper)
    lower = quaternion.multiply(between(_turned_by(upper, bones[1][0]), bones[1][1]), upper)
    return upper, lower


def _across(vectors: FloatArray, axis: FloatArray) -> FloatArray:
    """What of vectors stands across an axis; nothing where that is only rounding."""
    across = vectors - (vectors * axis).sum(axis=1, keepdims=True) * axis
    small = np.sqrt((across**2).sum(axis=1)) <= 1e-9 * np.sqrt((vectors**2).sum(axis=1))
    return np.where(small[:, None], 0, across)


def _turned_by(turns: FloatArray, vectors: FloatArray) -> FloatArray:
    turned: FloatArray = (quaternion.to_matrix(turns) @ vectors[:, :, None])[:, :, 0]
    return turned
