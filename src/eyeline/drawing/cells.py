"""Cells over the picture: which of them each stroke passes, and which faces may hide something there.

Only cells that strokes pass get a list, and only of faces that come before the farthest of these strokes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from eyeline.drawing.grid import Grid, window
from eyeline.drawing.hiders import Corners, Hiders
from eyeline.drawing.strokes import Strokes
from eyeline.geometry.arrays import FloatArray, IntArray, read_only
from eyeline.jit import kernel, share, threads

ROUNDING = 2.0**-40  # more than the rounding of a place in 0..1 along a stroke, less than a unit on it
BANDS = 4  # of rows of cells for each thread: where the picture is full differs
SAMPLED = 4096  # faces, to know how wide they are


@dataclass(frozen=True, eq=False)
class Visits:
    """Which cells each stroke passes."""

    shift: int  # cells are 2**shift grid units wide
    columns: int
    rows: int
    farthest: FloatArray  # (rows * columns,) the greatest depth of strokes in each cell; -inf is none
    start: IntArray  # (S + 1,) int64: where each stroke's visits begin
    cell: IntArray  # (N,) int32
    span: FloatArray  # (N, 2) where in 0..1 along the stroke
    inside: FloatArray  # (S, 2) the part of each stroke in the picture; empty if the first is not less


def visits_of(strokes: Strokes, corners: Corners, grid: Grid) -> Visits:
    """The cells that strokes pass, with one unit of doubt on either side."""
    shift = cell_shift(corners, grid)
    columns, rows = (int(side) >> shift for side in grid.extent)
    columns, rows, count = columns + 1, rows + 1, len(strokes.kind)
    farthest = np.full(columns * rows, -np.inf)
    start, inside = np.zeros(count + 1, np.int64), np.empty((count, 2))
    ends = read_only(np.ascontiguousarray(strokes.screen.reshape(-1, 6)))
    cell, span = _visit(ends, *grid.extent, shift, columns, rows, farthest, start, inside)
    return Visits(shift, columns, rows, farthest, start, cell, span, inside)


def cell_shift(corners: Corners, grid: Grid) -> int:
    """Cells are 2**shift units wide: about as wide as a face, at most sixteen for each face."""
    count = len(corners.faces)
    x = corners.screen[corners.faces[:: count // SAMPLED + 1], 0]
    width = 1.5 * float((x.max(axis=1) - x.min(axis=1)).mean()) if count else 0.0
    widest = math.sqrt(grid.extent[0] * grid.extent[1] / (16 * count + 256))
    return int(math.log2(max(width, widest, 1.0)))


def listed_faces(hiders: Hiders, visits: Visits) -> tuple[IntArray, IntArray]:
    """(start, face): of each cell with strokes, the faces that come before the farthest of them, in order."""
    bands = min(visits.rows, BANDS * threads())
    start = np.zeros(visits.columns * visits.rows + 2, np.int64)
    arrays = (
        read_only(hiders.corners), read_only(hiders.nearest), read_only(hiders.reach), visits.shift,
        visits.columns, read_only(visits.farthest),
    )  # fmt: skip

    def fill(face: IntArray) -> None:
        share(
            lambda band: _list_faces(
                band * visits.rows // bands, (band + 1) * visits.rows // bands, *arrays, start, face
            ),
            bands,
        )

    fill(np.empty(0, np.int32))
    start = np.cumsum(start)
    face = np.empty(start[-1], np.int32)
    if len(face):
        fill(face)
    return start, face


@kernel
def _visit(ends, width, height, shift, columns, rows, farthest, start, inside):
    """(cell, span), all visits; fills farthest, start and inside."""
    cell, span, count = np.empty(1024, np.int32), np.empty((1024, 2)), 0
    cell_width = float(1 << shift)
    for s in range(ends.shape[0]):
        x, y, dx, dy = ends[s, 0], ends[s, 1], ends[s, 3] - ends[s, 0], ends[s, 4] - ends[s, 1]
        in_x, in_y = window(x, dx, width), window(y, dy, height)
        t0, t1 = max(in_x[0], in_y[0]), min(in_x[1], in_y[1])
        inside[s, 0], inside[s, 1] = t0, t1
        deep = max(ends[s, 2], ends[s, 5])
        if t0 < t1:
            # Walk along the longer axis, p; q is the other one
            flip = abs(dy) > abs(dx)
            p, dp, q, dq = (y, dy, x, dx) if flip else (x, dx, y, dy)
            p_last, q_last = (rows - 1, columns - 1) if flip else (columns - 1, rows - 1)
            low, high = min(p + t0 * dp, p + t1 * dp) - 1.0, max(p + t0 * dp, p + t1 * dp) + 1.0
            for i in range(max(int(low), 0) >> shift, min(int(high) >> shift, p_last) + 1):
                in_p = window(p - float(i << shift), dp, cell_width)
                low = min(q + in_p[0] * dq, q + in_p[1] * dq) - 1.0
                high = max(q + in_p[0] * dq, q + in_p[1] * dq) + 1.0
                for j in range(max(int(low), 0) >> shift, min(int(max(high, -1.0)) >> shift, q_last) + 1):
                    if count == cell.shape[0]:
                        cell, span = np.concatenate((cell, cell)), np.concatenate((span, span))
                    cell[count] = i * columns + j if flip else j * columns + i
                    span[count, 0], span[count, 1] = in_p[0] - ROUNDING, in_p[1] + ROUNDING
                    farthest[cell[count]] = max(farthest[cell[count]], deep)
                    count += 1
        start[s + 1] = count
    return cell[:count].copy(), span[:count].copy()


@kernel
def _list_faces(first, end, corners, nearest, reach, shift, columns, farthest, start, face):
    """Count, two places late, the faces of cells in rows first..end; where there is room, list them."""
    counting = face.shape[0] == 0
    for f in range(nearest.shape[0]):
        low_column, high_column = reach[f, 0], reach[f, 2]
        tall = reach[f, 3] > reach[f, 1] + 3
        for row in range(max(reach[f, 1], first), min(reach[f, 3] + 1, end)):
            if tall:
                # Of a large face, only the columns it touches in this row of cells, a unit wider
                top, deep = float(row << shift) - 1.0, float((1 << shift) + 2)
                low, high = np.inf, -np.inf
                for k in range(3):
                    m = (k + 1) % 3
                    x, y = corners[f, 3 * k], corners[f, 3 * k + 1]
                    dx, dy = corners[f, 3 * m] - x, corners[f, 3 * m + 1] - y
                    t0, t1 = window(y - top, dy, deep)
                    if t0 <= t1:
                        low, high = min(low, x + t0 * dx, x + t1 * dx), max(high, x + t0 * dx, x + t1 * dx)
                low_column = max(reach[f, 0], int(max(low - 1.0, 0.0)) >> shift) if low <= high else 1
                high_column = min(reach[f, 2], int(max(high + 1.0, 0.0)) >> shift) if low <= high else 0
            for cell in range(row * columns + low_column, row * columns + high_column + 1):
                if nearest[f] < farthest[cell]:
                    if counting:
                        start[cell + 2] += 1
                    else:
                        face[start[cell + 1]] = f
                        start[cell + 1] += 1
