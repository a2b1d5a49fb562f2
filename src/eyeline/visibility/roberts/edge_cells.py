"""The bodies that reach into each cell of a grid over the picture."""

from __future__ import annotations

import numpy as np

from eyeline.geometry.arrays import IntArray, read_only
from eyeline.geometry.cells import Cells, widened
from eyeline.geometry.fixedpoint import UNITS
from eyeline.jit import kernel, share, threads
from eyeline.visibility.roberts.bodies import Bodies

NUMBER = (1 << 32) - 1  # of a body, in its key
SAMPLED = 4096  # bodies, to know how wide they are


def cells_for(bodies: Bodies, size: tuple[int, int]) -> Cells:
    """A grid whose cells are about as wide as a body; size: (width, height) in pixels."""
    count = len(bodies.owner)
    box = bodies.box[:: count // SAMPLED + 1]
    usual = float((box[:, 2].astype(np.int64) - box[:, 0]).mean()) if count else 0.0
    return Cells.about(usual, count, (size[0] * UNITS, size[1] * UNITS))


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
                    low, high = widened(low, high, x, y, dx, dy, above, deep)
                left = max(low_column, int(max(low - 1.0, 0.0)) >> shift) if low <= high else 1
                right = min(high_column, int(max(high + 1.0, 0.0)) >> shift) if low <= high else 0
            for cell in range(row * columns + left, row * columns + right + 1):
                if counting:
                    start[cell + 2] += 1
                else:
                    listed[start[cell + 1]] = key[i]
                    start[cell + 1] += 1
