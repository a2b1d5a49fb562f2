"""Follow path: a node goes along a path, as far as a number says."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from eyeline.errors import SceneError
from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.constraints.space import (
    against,
    blended,
    into,
    number,
    parent_place,
    turned,
)
from eyeline.motion.path import Path
from eyeline.scene.pose import Samples

# From a traveller that goes along -z to a node that goes along another of its axes
AHEAD = {
    "-z": (0.0, 0.0, 0.0, 1.0),
    "z": (0.0, 1.0, 0.0, 0.0),
    "x": (0.0, 0.5**0.5, 0.0, 0.5**0.5),
    "-x": (0.0, -(0.5**0.5), 0.0, 0.5**0.5),
}


@dataclass(frozen=True)
class FollowPath:
    """Places a node on a path in the world.

    along: metres from the path's start, what tracks move: a straight curve is constant speed. ahead: the
    node's axis that goes first, -z, z, x or -x, its y upright without a twist; None keeps its turn.
    up: the way its y points at the start. influence: 0..1.
    """

    name: str
    node: str
    path: Path
    along: float = 0.0
    ahead: str | None = None
    up: tuple[float, float, float] = (0.0, 1.0, 0.0)
    influence: float = 1.0

    def __post_init__(self) -> None:
        """Refuse an axis that cannot go first."""
        if self.ahead is not None and self.ahead not in AHEAD:
            raise SceneError(
                f"constraint {self.name!r}: ahead is {self.ahead!r}; {', '.join(AHEAD)} or None is needed"
            )

    def __call__(self, pose: Samples, moved: Mapping[str, FloatArray]) -> Samples:
        """The node on its path; its scale stays."""
        node = pose.find(self.node)
        influence = number(moved, "influence", self.influence)
        along = number(moved, "along", self.along)[:, 0]
        parent = parent_place(pose, node)
        place = into(parent, np.broadcast_to(self.path.at(along), (len(pose.translation), 3)))
        before = pose.rotation[:, node]
        pose = pose.placed(node, translation=blended(pose.translation[:, node], place, influence))
        if self.ahead is None:
            return pose
        turn = quaternion.multiply(self.path.turns(along, self.up), AHEAD[self.ahead])
        return pose.placed(node, rotation=turned(before, against(parent, turn), influence))
