"""A skeleton: joints as nodes, made from their names and places."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from eyeline.errors import SceneError, suggestion
from eyeline.scene.node import Node


def skeleton(joints: Mapping[str, tuple[str | None, npt.ArrayLike]]) -> tuple[Node, ...]:
    """Nodes for joints, {name: (its parent's name, or None; its place in the world, metres)}.

    Parents come before their children. At rest no joint is turned: each has the world's axes, so that a pose
    means the same on every body, and left and right mirror each other.
    """
    places: dict[str, np.ndarray] = {}
    order = {name: index for index, name in enumerate(joints)}
    nodes = []
    for name, (parent, given) in joints.items():
        place = np.asarray(given, dtype=np.float64)
        if place.shape != (3,) or not np.isfinite(place).all():
            raise SceneError(f"joint {name!r} is at {given!r}; three finite numbers are needed")
        if parent is not None and parent not in places:
            raise SceneError(
                f"joint {name!r} has the parent {parent!r}, which does not come before it"
                f"{suggestion(parent, places)}"
            )
        places[name] = place
        offset = place if parent is None else place - places[parent]
        nodes.append(Node(name, -1 if parent is None else order[parent], tuple(offset.tolist())))
    return tuple(nodes)
