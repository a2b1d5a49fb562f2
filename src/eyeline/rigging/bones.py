"""Bones: the straight lines in a body that its joints move."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from eyeline.errors import SceneError, suggestion
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.geometry.bvh import Bvh
from eyeline.geometry.rays import first_hits

INSIDE = 0.9  # of the way from a joint to the surface: where the bone of a joint without children ends


class Bones(NamedTuple):
    """B segments, and which joint moves each; a joint with several children has several."""

    start: FloatArray  # (B, 3) metres
    end: FloatArray  # (B, 3)
    joint: IntArray  # (B,) index into the joints
    names: tuple[str, ...]  # (J,) of the joints

    def of_joints(self, values: FloatArray) -> FloatArray:
        """(V, J) the least of each joint's bones from values (V, B); inf for a joint without a bone."""
        least = np.full((len(values), len(self.names)), np.inf)
        for bone, joint in enumerate(self.joint):
            np.minimum(least[:, joint], values[:, bone], out=least[:, joint])
        return least

    def nearest(self, points: FloatArray) -> FloatArray:
        """(V, B, 3) the place on each bone that is nearest to each of points (V, 3)."""
        way = self.end - self.start
        square = (way * way).sum(axis=1)
        along = ((points[:, None] - self.start) * way).sum(axis=2) / np.where(square > 0, square, 1)
        places: FloatArray = self.start + np.clip(along, 0, 1)[:, :, None] * way
        return places


def bones_of(
    names: Sequence[str],
    parents: Sequence[int],
    places: FloatArray,
    tree: Bvh,
    tips: Mapping[str, npt.ArrayLike],
    still: Collection[str] = (),
) -> Bones:
    """The bones of joints at places (J, 3): from each joint to each of its children.

    A joint without children has a bone to its tip, (3,) metres, or else on in its parent's direction, nearly
    to the surface in `tree`. still: names of joints that move nothing.
    """
    for name in (*tips, *still):
        if name not in names:
            raise SceneError(f"there is no joint {name!r}{suggestion(name, names)}")
    starts, ends, owners = [], [], []
    for joint, name in enumerate(names):
        if name in still:
            continue
        children = [child for child, parent in enumerate(parents) if parent == joint]
        goals = [places[child] for child in children]
        if name in tips:
            goals.append(np.asarray(tips[name], dtype=np.float64))
        elif not goals:
            parent = parents[joint]
            goals.append(_on(places[joint], None if parent < 0 else places[parent], tree))
        starts += [places[joint]] * len(goals)
        ends += goals
        owners += [joint] * len(goals)
    if not owners:
        raise SceneError("no joint moves anything; at least one is needed that is not still")
    return Bones(np.array(starts), np.array(ends), np.array(owners, dtype=np.int32), tuple(names))


def _on(place: FloatArray, before: FloatArray | None, tree: Bvh) -> FloatArray:
    """Where a bone ends that goes on as the one before it: near the surface, or after half that length."""
    if before is None or np.array_equal(place, before):
        return place
    way = place - before
    length = float(first_hits(tree, place[None], way[None], 1).length[0])
    ended: FloatArray = place + (INSIDE * length if np.isfinite(length) else 0.5) * way
    return ended
