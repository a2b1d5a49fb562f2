"""Faces that cross the near plane or the guard band, cut into pieces that do not.

A cut point follows from its edge alone, taken from its lower to its higher end: two faces that share the edge
are cut at the same point, and no gap opens between their pieces. [Sutherland74]
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from eyeline.geometry.arrays import BoolArray, FloatArray, IntArray
from eyeline.geometry.fixedpoint import GUARD, UNITS


@dataclass(frozen=True, eq=False)
class Pieces:
    """Triangles in clip space, and the vertices they still share with the faces they are cut from."""

    corners: FloatArray  # (N, 3, 4) float64
    vertex: IntArray  # (N, 3) which vertex of the picture a corner is; -1 is none: it must be placed
    source: IntArray  # (N,) which face each is cut from

    def pick(self, rows: IntArray | BoolArray) -> Pieces:
        """Some of them."""
        return Pieces(self.corners[rows], self.vertex[rows], self.source[rows])


def joined(parts: list[Pieces]) -> Pieces:
    """All pieces in one."""
    return Pieces(
        np.concatenate([part.corners for part in parts]),
        np.concatenate([part.vertex for part in parts]),
        np.concatenate([part.source for part in parts]),
    )


def clip_space(matrix: FloatArray, points: FloatArray) -> FloatArray:
    """Points (..., 3) in clip space (..., 4) float64, summed in a fixed order."""
    x, y, z = np.moveaxis(points.astype(np.float64), -1, 0)
    return np.stack([row[0] * x + row[1] * y + row[2] * z + row[3] for row in matrix], axis=-1)


def clipped(pieces: Pieces, size: tuple[int, int]) -> Pieces:
    """What of the pieces lies before the near plane and within the guard band."""
    for plane in planes(size):
        pieces = cut(pieces, plane)
    return pieces


def planes(size: tuple[int, int]) -> list[FloatArray]:
    """(4,) each: the near plane and the four borders of the guard band; inside, the product is 0 or more."""
    # One unit inside the band that vertices are held to, so that rounding leads nowhere outside
    right, low = (2 * (GUARD - 1) / (UNITS * side) - 1 for side in size)
    left, high = (2 * (GUARD - 1) / (UNITS * side) + 1 for side in size)
    rows = [(0, 0, -1, 1), (1, 0, 0, left), (-1, 0, 0, right), (0, 1, 0, low), (0, -1, 0, high)]
    return [np.array(row, dtype=np.float64) for row in rows]


def cut(pieces: Pieces, plane: FloatArray) -> Pieces:
    """What of the pieces lies on the inner side of a plane."""
    c = pieces.corners
    reach = plane[0] * c[..., 0] + plane[1] * c[..., 1] + plane[2] * c[..., 2] + plane[3] * c[..., 3]
    # A vertex that was placed is inside by that: its other faces are not cut
    reach = np.where(pieces.vertex >= 0, np.maximum(reach, 0), reach)
    inside = reach >= 0
    count = inside.sum(axis=1)
    kept = [pieces.pick(count == 3)]
    # One corner alone on its side comes first; its two edges are cut
    for alone, wanted in ((True, 1), (False, 2)):
        rows = np.flatnonzero(count == wanted)
        turn = (np.argmax(inside[rows] == alone, axis=1)[:, None] + np.arange(3)) % 3
        turned = Pieces(c[rows[:, None], turn], pieces.vertex[rows[:, None], turn], pieces.source[rows])
        kept += tips(turned, reach[rows[:, None], turn], alone)
    return joined(kept)


def tips(turned: Pieces, reach: FloatArray, inside: bool) -> list[Pieces]:
    """Pieces whose first corner is alone on its side: that tip, or what is left without it."""
    first, second, third = (turned.corners[:, k] for k in range(3))
    on_second = crossing(first, second, reach[:, 0], reach[:, 1])
    on_third = crossing(first, third, reach[:, 0], reach[:, 2])
    new = np.full(len(first), -1)
    vertex = turned.vertex.T
    if inside:
        corners, numbers = [(first, on_second, on_third)], [(vertex[0], new, new)]
    else:
        corners = [(on_second, second, third), (on_second, third, on_third)]
        numbers = [(new, vertex[1], vertex[2]), (new, vertex[2], new)]
    return [
        replace(turned, corners=np.stack(three, axis=1), vertex=np.stack(names, axis=1))
        for three, names in zip(corners, numbers, strict=True)
    ]


def crossing(a: FloatArray, b: FloatArray, reach_a: FloatArray, reach_b: FloatArray) -> FloatArray:
    """Where edges (N, 4) from a to b cross the plane; the same point for b to a."""
    swap = before(b, a)
    low, high = np.where(swap[:, None], b, a), np.where(swap[:, None], a, b)
    reach_low, reach_high = np.where(swap, reach_b, reach_a), np.where(swap, reach_a, reach_b)
    part = reach_low / (reach_low - reach_high)
    cut: FloatArray = low + (high - low) * part[:, None]
    return cut


def before(a: FloatArray, b: FloatArray) -> BoolArray:
    """Whether rows of a (N, 4) come before those of b, compared number by number."""
    less = np.zeros(len(a), dtype=bool)
    for k in reversed(range(a.shape[1])):
        less = (a[:, k] < b[:, k]) | ((a[:, k] == b[:, k]) & less)
    return less


def snapped(corners: FloatArray, size: tuple[int, int]) -> tuple[IntArray, FloatArray]:
    """Clip space (N, 4), all within the guard band, to xy (N, 2) int32 and depth (N,) float32."""
    x, y, z, w = corners.T
    across, down = size[0] * UNITS / 2, size[1] * UNITS / 2
    xy = np.stack([(x / w + 1) * across, (1 - y / w) * down], axis=-1)
    return np.floor(xy + 0.5).astype(np.int32), (z / w).astype(np.float32)
