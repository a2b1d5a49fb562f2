"""The part of a picture that a scene and its shadows on the floor can touch."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.geometry.bounds import Bounds
from eyeline.projection.projected import Projected


class Region(NamedTuple):
    """Whole pixels, left and top inside, right and bottom outside."""

    left: int
    top: int
    right: int
    bottom: int

    @property
    def width(self) -> int:
        """Pixels across; 0 where it is out of the picture."""
        return max(self.right - self.left, 0)


def region_of(points: FloatArray, projected: Projected, margin: int) -> Region:
    """The box in the picture around points (N, 3), `margin` pixels wider all around.

    All the picture where a point lies behind the eye; nothing for no points.
    """
    if len(points) == 0:
        return Region(0, 0, 0, 0)
    clip = np.concatenate([points, np.ones((len(points), 1))], axis=1) @ projected.clip_from_world.T
    width, height = projected.width, projected.height
    if (clip[:, 3] <= 0).any():
        return Region(0, 0, width, height)
    columns = (clip[:, 0] / clip[:, 3] + 1) * width / 2
    rows = (1 - clip[:, 1] / clip[:, 3]) * height / 2
    return Region(
        int(np.clip(columns.min() - margin, 0, width)),
        int(np.clip(rows.min() - margin, 0, height)),
        int(np.clip(columns.max() + margin + 1, 0, width)),
        int(np.clip(rows.max() + margin + 1, 0, height)),
    )


def on_floor(bounds: Bounds, to_light: FloatArray | None, around: float) -> FloatArray:
    """(N, 3) corners of what can darken the floor under a box: `around` metres about it, and its shadow.

    to_light: unit, to the key whose shadow falls, if one does.
    """
    if bounds.is_empty:
        return np.zeros((0, 3))
    sides = np.array([around, 0, around])
    wide = Bounds(bounds.low - sides, bounds.high + sides)
    foot = wide.corners * (1, 0, 1) + (0, bounds.low[1], 0)
    if to_light is None or to_light[1] <= 0:
        return foot
    steps = (wide.corners[:, 1] - bounds.low[1]) / to_light[1]
    return np.concatenate([foot, wide.corners - to_light * steps[:, None]])
