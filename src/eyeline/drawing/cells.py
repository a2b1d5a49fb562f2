"""Which faces may hide something in each cell of a grid over the drawing.

Only cells that strokes pass get a list, and only of faces that come before the farthest of these strokes.
"""

from __future__ import annotations

import numpy as np

from eyeline.drawing.grid import Grid
from eyeline.drawing.hiders import Corners, Hiders
from eyeline.drawing.strokes import Strokes
from eyeline.geometry.arrays import FloatArray, IntArray, read_only
from eyeline.geometry.cells import Cells, Passages, widened
from eyeline.jit import kernel, share, threads

BANDS = 4  # of rows of cells for each thread: where the picture is full differs
SAMPLED = 4096  # faces, to know how wide they are


def cells_for(corners: Corners, grid: Grid) -> Cells:
    """A grid whose cells are about as wide as a face."""
    count = len(corners.faces)
    x = corners.screen[corners.faces[:: count // SAMPLED + 1], 0]
    usual = float((x.max(axis=1) - x.min(axis=1)).mean()) if count else 0.0
    return Cells.about(usual, count, grid.extent)


def farthest_in(cells: Cells, strokes: Strokes, passages: Passages) -> FloatArray:
    """(rows * columns,) the greatest depth of strokes in each cell; -inf is none."""
    farthest = np.full(cells.columns * cells.rows, -np.inf)
    deep = strokes.screen[:, :, 2].max(axis=1)
    _deepen(read_only(passages.start), read_only(passages.cell), read_only(deep), farthest)
    return farthest


def listed_faces(hiders: Hiders) -> tuple[IntArray, IntArray]:
    """(start, face): of each cell with strokes, the faces that come before the farthest of them, in order."""
    cells = hiders.cells
    bands = min(cells.rows, BANDS * threads())
    start = np.zeros(cells.columns * cells.rows + 2, np.int64)
    arrays = (
        read_only(hiders.corners), read_only(hiders.nearest), read_only(hiders.reach), cells.shift,
        cells.columns, read_only(hiders.farthest),
    )  # fmt: skip

    def fill(face: IntArray) -> None:
        share(
            lambda band: _list_faces(
                band * cells.rows // bands, (band + 1) * cells.rows // bands, *arrays, start, face
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
def _deepen(start, cell, deep, farthest):
    """Raise farthest of every cell that a stroke passes to the depth of the stroke."""
    for s in range(deep.shape[0]):
        for passage in range(start[s], start[s + 1]):
            farthest[cell[passage]] = max(farthest[cell[passage]], deep[s])


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
                    low, high = widened(low, high, x, y, dx, dy, top, deep)
                low_column = max(reach[f, 0], int(max(low - 1.0, 0.0)) >> shift) if low <= high else 1
                high_column = min(reach[f, 2], int(max(high + 1.0, 0.0)) >> shift) if low <= high else 0
            for cell in range(row * columns + low_column, row * columns + high_column + 1):
                if nearest[f] < farthest[cell]:
                    if counting:
                        start[cell + 2] += 1
                    else:
                        face[start[cell + 1]] = f
                        start[cell + 1] += 1
