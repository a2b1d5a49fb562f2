"""The part of a picture that a scene and its shadows on the floor can touch."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.projection.projected import Projected
from eyeline.scene.scene import Scene
from eyeline.shading.floor import Floor


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


def region_of(
    scene: Scene, projected: Projected, floor: Floor | None, to_light: FloatArray | None, margin: int
) -> Region:
    """The region, `margin` pixels wider all around; to_light: unit, to the key whose shadow falls."""
    if scene.bounds.is_empty:
        return Region(0, 0, 0, 0)
    corners = scene.bounds.corners
    if floor is not None and to_light is not None and to_light[1] > 0:
        # Each corner's shadow on the floor
        steps = (corners[:, 1] - scene.bounds.low[1]) / to_light[1]
        corners = np.concatenate([corners, corners - to_light * steps[:, None]])
    clip = np.concatenate([corners, np.ones((len(corners), 1))], axis=1) @ projected.clip_from_world.T
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
