"""Follow: a node keeps its distance from another, and turns with it if it shall."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.constraints.space import (
    against,
    blended,
    into,
    number,
    parent_place,
    turn_of,
    turned,
    vector,
)
from eyeline.scene.pose import Samples


@dataclass(frozen=True)
class Follow:
    """Places a node at another's origin and an offset from it.

    offset: metres; along the world's axes, or with `turns` along the leader's, and then the node turns as
    the leader does. influence: 0..1.
    """

    name: str
    node: str
    leader: str
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    turns: bool = False
    influence: float = 1.0

    def __call__(self, pose: Samples, moved: Mapping[str, FloatArray]) -> Samples:
        """The node beside its leader; its scale stays."""
        node = pose.find(self.node)
        influence = number(moved, "influence", self.influence)
        leader = pose.world[:, pose.find(self.leader)]
        offset = vector(moved, "offset", self.offset)
        turn = turn_of(leader)
        if self.turns:
            offset = (quaternion.to_matrix(turn) @ offset[..., None])[..., 0]
        parent = parent_place(pose, node)
        place = into(parent, leader[:, :3, 3] + offset)
        pose = pose.placed(node, translation=blended(pose.translation[:, node], place, influence))
        if not self.turns:
            return pose
        rotation = turned(pose.rotation[:, node], against(parent, turn), influence)
        return pose.placed(node, rotation=rotation)
