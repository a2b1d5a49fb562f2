"""Vertices of one mesh, moved to the picture and snapped to its grid."""

from __future__ import annotations

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray, read_only
from eyeline.geometry.fixedpoint import CENTRE, GUARD
from eyeline.jit import helper, kernel, share, threads

SMALL = 1 << 14  # vertices: fewer are not worth a second thread


def place(
    points: FloatArray, clip_from_mesh: FloatArray, size: tuple[int, int], xy: IntArray, depth: FloatArray
) -> int:
    """Fill xy (V, 2) and depth (V,) from points (V, 3); how many could not be placed.

    One behind the near plane gets depth inf and xy 0; one beyond the guard band gets depth -inf, and xy at
    the band's border.
    """
    parts = threads() if len(points) > SMALL else 1
    matrix = tuple(clip_from_mesh.astype(np.float32).reshape(-1))
    flat, pixels = read_only(points).reshape(-1), xy.reshape(-1)
    return sum(share(lambda part: _place(part, parts, flat, matrix, size, pixels, depth), parts))


@kernel
def _place(part, parts, points, m, size, xy, depth):
    begin, end = depth.shape[0] * part // parts, depth.shape[0] * (part + 1) // parts
    # Flat arrays, indexed from 0, and a matrix that no store can change: the loop becomes vector instructions
    points, xy, depth = points[3 * begin : 3 * end], xy[2 * begin : 2 * end], depth[begin:end]
    across, down = np.float32(size[0] * CENTRE), np.float32(size[1] * CENTRE)
    unplaced = 0
    for i in range(depth.shape[0]):
        x, y, z = points[3 * i], points[3 * i + 1], points[3 * i + 2]
        xy[2 * i], xy[2 * i + 1], depth[i] = placed(m, across, down, x, y, z)
        unplaced += not (abs(depth[i]) < np.float32(np.inf))
    return unplaced


@helper
def placed(m, across, down, x, y, z):
    """(x, y, depth) of a vertex; across, down: half of the picture's sides, 1/256 pixel."""
    one, half, guard = np.float32(1), np.float32(0.5), np.float32(GUARD)
    w = m[12] * x + m[13] * y + m[14] * z + m[15]
    back = m[8] * x + m[9] * y + m[10] * z + m[11]
    r = one / w
    px = ((m[0] * x + m[1] * y + m[2] * z + m[3]) * r + one) * across + half
    py = (one - (m[4] * x + m[5] * y + m[6] * z + m[7]) * r) * down + half
    pz = back * r
    before = (back <= w) & (w > np.float32(0)) & (pz > np.float32(-np.inf))
    inside = (abs(px) < guard) & (abs(py) < guard)
    px, py = min(max(px, -guard), guard), min(max(py, -guard), guard)
    column = np.int32(np.floor(px if before else np.float32(0)))
    row = np.int32(np.floor(py if before else np.float32(0)))
    unplaceable = np.float32(-np.inf) if before else np.float32(np.inf)
    return column, row, (pz if before & inside else unplaceable)
