"""Cells over the picture: which of them each edge passes, and which bodies reach into each."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray, read_only
from eyeline.geometry.fixedpoint import UNITS
from eyeline.jit import helper, kernel, share, threads
from eyeline.visibility.roberts.bodies import Bodies

ROUNDING = 2.0**-40  # more than the rounding of a place in 0..1 along an edge, less than a unit on it
BLOCKS = 4  # of edges for each thread
NUMBER = (1 << 32) - 1  # of a body, in its key
SAMPLED = 4096  # bodies, to know how wide they are
CELLS_OF_A_BODY, LEAST_CELLS = 16, 256  # there are at most so many for each body, and so many more


@dataclass(frozen=True, eq=False)
class Cells:
    """A grid over the picture."""

    width: int  # of the picture, 1/256 pixel
    height: int
    shift: int  # a cell is 2**shift units wide and high

    @property
    def columns(self) -> int:
        """How many side by side; the picture's right border is in the last."""
        return (self.width >> self.shift) + 1

    @property
    def rows(self) -> int:
        """How many below each other."""
        return (self.height >> self.shift) + 1


@dataclass(frozen=True, eq=False)
class Passages:
    """Which cells each edge passes, and the part of the edge that is in the picture."""

    inside: FloatArray  # (E, 2) where in 0..1 along the edge; none of it if the first is not less
    start: IntArray  # (E + 1,) int64: where each edge's cells begin
    cell: IntArray  # (N,) int32, from one side of the picture to the other
    span: FloatArray  # (N, 2) where in 0..1 along the edge, a little more than that


def cells_for(bodies: Bodies, size: tuple[int, int]) -> Cells:
    """A grid whose cells are about as wide as a body; size: (width, height) in pixels."""
    width, height, count = size[0] * UNITS, size[1] * UNITS, len(bodies.owner)
    box = bodies.box[:: count // SAMPLED + 1]
    usual = 1.5 * float((box[:, 2].astype(np.int64) - box[:, 0]).mean()) if count else 0.0
    least = math.sqrt(width * height / (CELLS_OF_A_BODY * count + LEAST_CELLS))
    return Cells(width, height, int(math.log2(max(usual, least, 1.0))))


def passages_of(ends: FloatArray, cells: Cells) -> Passages:
    """The cells that edges (E, 6) pass, with one unit of doubt on either side."""
    count, blocks = len(ends), max(1, min(len(ends), BLOCKS * threads()))
    inside, number = np.empty((count, 2)), np.zeros(count + 1, np.int64)
    given = (read_only(ends), cells.width, cells.height, cells.shift, cells.columns, cells.rows)
    found = share(
        lambda block: _pass(count * block // blocks, count * (block + 1) // blocks, *given, inside, number),
        blocks,
    )
    cell, span = (np.concatenate(parts) for parts in zip(*found, strict=True))
    return Passages(inside, np.cumsum(number), cell, span)


def bodies_in(bodies: Bodies, cells: Cells) -> tuple[IntArray, IntArray]:
    """(start, listed): of each cell the keys of the bodies that reach into it, nearest first."""
    bands = min(cells.rows, threads())
    start = np.zeros(cells.columns * cells.rows + 2, np.int64)
    arrays = (bodies.key, bodies.box[bodies.key & NUMBER], bodies.side_start, bodies.side)
    given = (cells.shift, cells.columns, *(read_only(array) for array in arrays))

    def fill(listed: IntArray) -> None:
        share(
            lambda band: _list_bodies(
                start, listed, cells.rows * band // bands, cells.rows * (band + 1) // bands, *given
            ),
            bands,
        )

    fill(np.empty(0, np.int64))
    start = np.cumsum(start)
    listed = np.empty(start[-1], np.int64)
    if len(listed):
        fill(listed)
    return start, listed


@helper
def window(a, d, size):
    """Where a + t d is within 0..size, for t in 0..1; empty if the first is not less than the second."""
    if d == 0.0:
        return (0.0, 1.0) if (a >= 0.0) & (a <= size) else (1.0, 0.0)
    t, u = -a / d, (size - a) / d
    return max(min(t, u), 0.0), min(max(t, u), 1.0)


@kernel
def _pass(first, end, ends, width, height, shift, columns, rows, inside, number):
    """(cell, span) of edges first..end; fills inside and, one place late, the number of cells of each."""
    room = 4 * (end - first) + 16
    cell, span, count = np.empty(room, np.int32), np.empty((room, 2)), 0
    cell_width = float(1 << shift)
    for s in range(first, end):
        x, y, dx, dy = ends[s, 0], ends[s, 1], ends[s, 3] - ends[s, 0], ends[s, 4] - ends[s, 1]
        in_x, in_y = window(x, dx, float(width)), window(y, dy, float(height))
        t0, t1 = max(in_x[0], in_y[0]), min(in_x[1], in_y[1])
        inside[s, 0], inside[s, 1] = t0, t1
        if not t0 < t1 or (dx == 0.0 and dy == 0.0):
            inside[s, 0], inside[s, 1] = 1.0, 0.0
            continue
        # Walk along the longer axis, p; q is the other one
        before, flip = count, abs(dy) > abs(dx)
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
                count += 1
        number[s + 1] = count - before
    return cell[:count].copy(), span[:count].copy()


@kernel
def _list_bodies(start, listed, first, end, shift, columns, key, box, side_start, side):
    """Count, two places late, the bodies of cells in rows first..end; where there is room, list them."""
    counting = listed.shape[0] == 0
    for i in range(key.shape[0]):
        low_column, high_column = max(box[i, 0], 0) >> shift, min(box[i, 2] >> shift, columns - 1)
        low_row, high_row = max(box[i, 1], 0) >> shift, box[i, 3] >> shift
        tall = high_row > low_row + 3
        for row in range(max(low_row, first), min(high_row + 1, end)):
            left, right = low_column, high_column
            if tall:
                b = key[i] & NUMBER
                # Of a large body, only the columns its outline touches in this row of cells, a unit wider
                above, deep = float(row << shift) - 1.0, float((1 << shift) + 2)
                low, high = np.inf, -np.inf
                for k in range(side_start[b], side_start[b + 1]):
                    x, y = float(side[k, 0]), float(side[k, 1])
                    dx, dy = float(side[k, 2]) - x, float(side[k, 3]) - y
                    t0, t1 = window(y - above, dy, deep)
                    if t0 <= t1:
                        low, high = min(low, x + t0 * dx, x + t1 * dx), max(high, x + t0 * dx, x + t1 * dx)
                left = max(low_column, int(max(low - 1.0, 0.0)) >> shift) if low <= high else 1
                right = min(high_column, int(max(high + 1.0, 0.0)) >> shift) if low <= high else 0
            for cell in range(row * columns + left, row * columns + right + 1):
                if counting:
                    start[cell + 2] += 1
                else:
                    listed[start[cell + 1]] = key[i]
                    start[cell + 1] += 1
