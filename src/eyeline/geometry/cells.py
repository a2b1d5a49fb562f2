"""Square cells over a picture: which of them each line passes.

Who asks what hides a line then looks only at what is listed in these cells.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray, read_only
from eyeline.geometry.spans import window
from eyeline.jit import helper, kernel, share, threads

ROUNDING = 2.0**-40  # more than the rounding of a place in 0..1 along a line, less than a unit on it
BLOCKS = 4  # of lines for each thread
CELLS_OF_A_THING, LEAST_CELLS = 16, 256  # there are at most so many for each thing, and so many more


@dataclass(frozen=True, eq=False)
class Cells:
    """A grid over the picture, in the units that its lines are given in."""

    width: float  # of the picture
    height: float
    shift: int  # a cell is 2**shift units wide and high

    @classmethod
    def about(cls, wide: float, count: int, size: tuple[float, float]) -> Cells:
        """Cells over a picture of `size` (width, height) for `count` things that are usually so wide."""
        least = math.sqrt(size[0] * size[1] / (CELLS_OF_A_THING * count + LEAST_CELLS))
        return cls(*size, int(math.log2(max(1.5 * wide, least, 1.0))))

    @property
    def columns(self) -> int:
        """How many side by side; the picture's right border is in the last."""
        return (int(self.width) >> self.shift) + 1

    @property
    def rows(self) -> int:
        """How many below each other."""
        return (int(self.height) >> self.shift) + 1


@dataclass(frozen=True, eq=False)
class Passages:
    """Which cells each line passes, and the part of the line that is in the picture."""

    inside: FloatArray  # (E, 2) where in 0..1 along the line; none of it if the first is not less
    start: IntArray  # (E + 1,) int64: where each line's cells begin
    cell: IntArray  # (N,) int32, from one side of the picture to the other
    span: FloatArray  # (N, 2) where in 0..1 along the line, a little more than that


def passages_of(ends: FloatArray, cells: Cells) -> Passages:
    """The cells that lines (E, 6), x y depth of both ends, pass, with one unit of doubt on either side."""
    count, blocks = len(ends), max(1, min(len(ends), BLOCKS * threads()))
    inside, number = np.empty((count, 2)), np.zeros(count + 1, np.int64)
    size = float(cells.width), float(cells.height)
    given = (read_only(ends), *size, cells.shift, cells.columns, cells.rows)
    found = share(
        lambda block: _pass(count * block // blocks, count * (block + 1) // blocks, *given, inside, number),
        blocks,
    )
    cell, span = (np.concatenate(parts) for parts in zip(*found, strict=True))
    return Passages(inside, np.cumsum(number), cell, span)


@kernel
def _pass(first, end, ends, width, height, shift, columns, rows, inside, number):
    """(cell, span) of lines first..end; fills inside and, one place late, the number of cells of each."""
    room = 4 * (end - first) + 16
    cell, span, count = np.empty(room, np.int32), np.empty((room, 2)), 0
    cell_width = float(1 << shift)
    for s in range(first, end):
        x, y, dx, dy = ends[s, 0], ends[s, 1], ends[s, 3] - ends[s, 0], ends[s, 4] - ends[s, 1]
        in_x, in_y = window(x, dx, width), window(y, dy, height)
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


@helper
def widened(low, high, x, y, dx, dy, above, deep):
    """low..high, made wide enough for the columns of a side within `deep` below `above`.

    (x, y) and (dx, dy): where the side begins, and from there to its end.
    """
    t0, t1 = window(y - above, dy, deep)
    if t0 <= t1:
        low, high = min(low, x + t0 * dx, x + t1 * dx), max(high, x + t0 * dx, x + t1 * dx)
    return low, high
