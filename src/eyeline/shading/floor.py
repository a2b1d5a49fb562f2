"""The studio floor: an endless plane under everything, which only shows the shadows that fall on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.projection.projected import Projected
from eyeline.scene.scene import Scene
from eyeline.shading.look import Look


@dataclass(frozen=True, eq=False)
class Floor:
    """Where the rays of a picture meet the plane y = height."""

    place: (
        FloatArray  # (3, 3) float64: (x w, z w, w) from the eye, of (column, row, 1), pixels; w > 0 where met
    )
    distances: (
        FloatArray  # (3,): (column, row, 1) to 1 / metres along the view in perspective, else to metres
    )
    below_eye: float  # metres of the floor from the eye, negative


def floor_of(scene: Scene, projected: Projected, look: Look, studio: bool) -> Floor | None:
    """The floor at its height, else at the lowest point of a scene; None where there is none to see.

    A camera at or under the floor does not see it.
    """
    wanted = look.ground == "on" or (look.ground == "auto" and studio and look.background == "studio")
    camera, bounds = projected.camera, scene.bounds
    if not wanted or bounds.is_empty:
        return None
    height = bounds.low[1] if look.ground_height is None else look.ground_height
    down = float(height - camera.world_from_eye[1, 3])
    clip = camera.clip_from_eye(projected.width / projected.height)
    # Columns and rows to the eye's x and y at distance 1 (perspective) or everywhere (orthographic)
    lens = np.array(
        [
            [2 / projected.width / clip[0, 0], 0, -1 / clip[0, 0]],
            [0, -2 / projected.height / clip[1, 1], 1 / clip[1, 1]],
        ]
    )
    turn = camera.world_from_eye[:3, :3]
    if camera.fov is not None:
        direction = turn @ np.vstack([lens, [0, 0, -1]])
        # The place is direction * down / direction.y, and that quotient is the distance
        if down >= 0:
            return None
        place = np.array([direction[0] * down, direction[2] * down, direction[1]]) * -1
        return Floor(place, direction[1] / down, down)
    across = turn[:, :2] @ lens
    forward = -turn[:, 2]
    if forward[1] >= 0:
        return None
    distance = (np.array([0, 0, down]) - across[1]) / forward[1]
    place = np.array([across[0] + forward[0] * distance, across[2] + forward[2] * distance, [0, 0, 1.0]])
    return Floor(place, distance, down)
