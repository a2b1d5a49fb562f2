"""Slow and obviously right: what is seen at every pixel, by trying every face there.

`seen` answers for snapped faces in whole numbers: a method must equal it bit for bit. `truth` answers for the
scene itself, unsnapped and unclipped, and says where snapping cannot matter: there every method must agree.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from eyeline.comparison.oracle import screened, truth
from eyeline.projection.projected import CLOCKWISE, COUNTER_CLOCKWISE, Projected

__all__ = ["screened", "seen", "truth"]


def seen(projected: Projected) -> tuple[npt.NDArray[np.int32], npt.NDArray[np.float32]]:
    """(face, depth), (H, W) each, of snapped faces."""
    shape = projected.height, projected.width
    face, depth = np.full(shape, -1, np.int32), np.zeros(shape, np.float32)
    sides = np.broadcast_to(projected.sides, len(projected.faces))
    order = np.argsort(projected.source, kind="stable")  # a tie goes to the lower scene face
    for number in order[sides[order] != 0]:
        corners = projected.faces[number]
        covered, own = one_face(projected.xy[corners], projected.depth[corners], int(sides[number]), shape)
        nearer = covered & (own > depth)
        face[nearer], depth[nearer] = projected.source[number], own[nearer]
    return face, depth


def one_face(xy, z, sides: int, shape: tuple[int, int]):
    """(covered, depth) of one face at every pixel."""
    (x0, y0), (x1, y1), (x2, y2) = xy.astype(object).tolist()  # Python's numbers: as long as they need to be
    area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    if area == 0 or not sides & (CLOCKWISE if area > 0 else COUNTER_CLOCKWISE):
        return np.zeros(shape, bool), np.zeros(shape, np.float32)
    corners = [(y0, x0, z[0]), (y1, x1, z[1]), (y2, x2, z[2])]
    if area < 0:
        corners = [corners[0], corners[2], corners[1]]
    # Clockwise from the topmost corner, of those the leftmost
    start = corners.index(min(corners, key=lambda corner: corner[:2]))
    corners = corners[start:] + corners[:start]
    rows, columns = np.mgrid[: shape[0], : shape[1]].astype(np.int64)
    covered = np.ones(shape, bool)
    for (ya, xa, _), (yb, xb, _) in zip(corners, corners[1:] + corners[:1], strict=True):
        edge = (ya - yb) * (columns * 256 + 128 - xa) + (xb - xa) * (rows * 256 + 128 - ya)
        left_or_top = ya > yb or (ya == yb and xb > xa)
        covered &= (edge > 0) | ((edge == 0) & left_or_top)
    return covered, plane_depth(corners, rows.astype(np.float64), columns.astype(np.float64))


def plane_depth(corners, y, x) -> npt.NDArray[np.float32]:
    """The house's formula for depth, in its order of operations."""
    (y0, x0, z0), (y1, x1, z1), (y2, x2, z2) = [(float(y), float(x), float(z)) for y, x, z in corners]
    ux, uy, vx, vy = x1 - x0, y1 - y0, x2 - x0, y2 - y0
    scale = 256.0 / (ux * vy - vx * uy)
    a = ((z1 - z0) * vy - (z2 - z0) * uy) * scale
    b = ((z2 - z0) * ux - (z1 - z0) * vx) * scale
    c = z0 - a * ((x0 - 128) / 256) - b * ((y0 - 128) / 256)
    return ((c + b * y) + a * x).astype(np.float32)
