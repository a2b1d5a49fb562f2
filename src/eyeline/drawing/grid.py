"""The drawing's grid: screen coordinates that are whole numbers, thousands to a pixel.

Whether a point lies left of a line is then the sign of a whole number below 2**53, exact in float64. Depth
is -1 / distance for a perspective camera and the distance for an orthographic one, in the grid's unit: planes
stay planes on the screen, and greater is farther.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import BoolArray, FloatArray
from eyeline.jit import helper
from eyeline.scene.camera import Camera

ACROSS = 2.0**24  # units: the picture is at most as wide or high
GUARD = 2.0**25 - 1  # coordinates stay within -GUARD..GUARD, so that differences stay below 2**26


@dataclass(frozen=True, eq=False)
class Grid:
    """How points in front of the eye become places on the grid; eye space is x right, y up, -z ahead."""

    size: tuple[int, int]  # width, height, pixels
    unit: float  # grid units in a pixel, a power of two
    scale: float  # grid units in a metre: at a distance of one metre if perspective, else at any
    perspective: bool
    near: float  # metres along the view
    far: float  # metres along the view, may be infinite

    @classmethod
    def of(cls, camera: Camera, size: tuple[int, int]) -> Grid:
        """The grid of a picture; the camera has its planes: see `Camera.fitted`."""
        width, height = size
        unit = 2.0 ** math.floor(math.log2(ACROSS / max(width, height)))
        scale = float(camera.clip_from_eye(width / height)[1, 1]) * height / 2 * unit
        assert camera.near is not None
        far = math.inf if camera.far is None else camera.far
        return cls((width, height), unit, scale, camera.fov is not None, camera.near, far)

    @property
    def extent(self) -> tuple[float, float]:
        """Width and height of the picture in grid units."""
        return self.size[0] * self.unit, self.size[1] * self.unit

    @property
    def slack(self) -> tuple[float, float]:
        """What one unit along the line of sight is in depth: a constant, and a factor of |depth|."""
        return (0.0, 1 / self.scale) if self.perspective else (1.0, 0.0)

    @property
    def planes(self) -> list[FloatArray]:
        """(4,) each: near, far, and the guard band; inside, the product with (x, y, z, 1) is 0 or more."""
        rows = [(0, 0, -1, -self.near)]
        if math.isfinite(self.far):
            rows.append((0, 0, 1, self.far))
        # One unit inside the band that points are held to, so that rounding leads nowhere outside
        for axis, sign in ((0, 1.0), (1, -1.0)):
            for side in (1.0, -1.0):
                reach = GUARD - 1 + side * self.extent[axis] / 2
                row = [0.0, 0.0, -reach, 0.0] if self.perspective else [0.0, 0.0, 0.0, reach]
                row[axis] = side * sign * self.scale
                rows.append(tuple(row))  # type: ignore[arg-type]
        return [np.array(row, dtype=np.float64) for row in rows]

    def place(self, points: FloatArray) -> tuple[FloatArray, BoolArray]:
        """(N, 3) grid x, grid y, depth of eye-space points (N, 3), and whether each must be cut away."""
        x, y, distance = points[:, 0], points[:, 1], -points[:, 2]
        within = (distance >= self.near) & (distance <= self.far)
        screen = np.empty((len(points), 3))
        ratio = self.scale / np.where(distance > 0, distance, 1.0) if self.perspective else self.scale
        screen[:, 0] = np.rint(x * ratio + self.extent[0] / 2)
        screen[:, 1] = np.rint(self.extent[1] / 2 - y * ratio)
        screen[:, 2] = -ratio if self.perspective else distance * ratio
        outside = ~(within & (np.abs(screen[:, 0]) <= GUARD) & (np.abs(screen[:, 1]) <= GUARD))
        return screen, outside

    def distance(self, depth: FloatArray) -> FloatArray:
        """Metres along the view of depths."""
        return -self.scale / depth if self.perspective else depth / self.scale

    def unplace(self, screen: FloatArray) -> FloatArray:
        """Eye-space points (..., 3) of places on the grid (..., 3)."""
        distance = self.distance(screen[..., 2])
        ratio = self.scale / distance if self.perspective else self.scale
        x = (screen[..., 0] - self.extent[0] / 2) / ratio
        y = (self.extent[1] / 2 - screen[..., 1]) / ratio
        return np.stack([x, y, -distance], axis=-1)


@helper
def turn(ax, ay, bx, by, cx, cy):
    """Twice the signed area of a, b, c; exact on the grid. Positive where they turn clockwise, y down."""
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
