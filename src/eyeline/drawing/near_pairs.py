"""Which faces of different parts come close enough to pass through each other."""

from __future__ import annotations

import numpy as np

from eyeline.drawing.model import Model
from eyeline.errors import OptionError
from eyeline.geometry.arrays import IntArray, read_only
from eyeline.jit import kernel

CELLS = 1 << 21  # of the grid in space, at most
MOST_PAIRS = 1 << 24  # so that a heap of faces is refused before it takes all memory
SHARED = -2  # whose a cell is that two parts touch; -1 is nobody's


def near_pairs(model: Model, rows: IntArray) -> IntArray:
    """(K, 2) faces of different parts, among some rows (N,), whose boxes overlap; the lower number first.

    Space is cut into cells about twice as wide as a face; only those that two parts touch are looked into.
    """
    boxes, whole = np.empty((len(rows), 6)), np.empty(6)
    given = (read_only(model.points), read_only(model.faces), read_only(rows))
    extent = _face_boxes(*given, boxes, whole)
    spread = whole[3:] - whole[:3]
    width = max(2 * extent, float(spread.max()) / 1000)
    width = max(width, (float(spread.prod()) / min(CELLS, 8 * len(rows) + 64)) ** (1 / 3)) or 1.0
    size = (spread / width).astype(np.int64) + 1
    part, reach = model.part[rows], np.empty((len(rows), 6), np.int32)
    owner, count = np.full(size.prod(), -1, np.int32), np.zeros(size.prod() + 2, np.int32)
    near = np.zeros(len(rows), np.bool_)
    row_size, column_size = int(size[1]), int(size[2])
    _shared_cells(
        read_only(part), read_only(boxes), read_only(whole), width, row_size, column_size, reach, owner,
        count, near,
    )  # fmt: skip
    few = np.flatnonzero(near)
    few = few[np.argsort(part[few], kind="stable")]  # so that each cell's list is grouped by part
    pairs = _close_pairs(
        read_only(boxes[few]), read_only(part[few]), read_only(reach[few]), row_size, column_size,
        read_only(owner), np.cumsum(count, dtype=np.int32),
    )  # fmt: skip
    if len(pairs) > MOST_PAIRS:
        raise OptionError(
            f"more than {MOST_PAIRS} pairs of faces may pass through each other;"
            " leave 'intersection' out of edges"
        )
    return np.sort(rows[few[pairs]], axis=1)


@kernel
def _face_boxes(points, faces, rows, boxes, whole):
    """The mean extent of faces; fills their boxes, and the box of all."""
    extent = 0.0
    for k in range(3):
        whole[k], whole[3 + k] = np.inf, -np.inf
    for i in range(rows.shape[0]):
        a, b, c = faces[rows[i], 0], faces[rows[i], 1], faces[rows[i], 2]
        for k in range(3):
            boxes[i, k] = min(points[a, k], points[b, k], points[c, k])
            boxes[i, 3 + k] = max(points[a, k], points[b, k], points[c, k])
            whole[k], whole[3 + k] = min(whole[k], boxes[i, k]), max(whole[3 + k], boxes[i, 3 + k])
            extent += boxes[i, 3 + k] - boxes[i, k]
    return extent / (3 * rows.shape[0])


@kernel
def _shared_cells(part, boxes, whole, width, rows, columns, reach, owner, count, near):
    """Mark cells that two parts touch; count, two places late, the faces in each, and mark these faces.

    Fills reach: the first and last cell that each face touches along x, y and z.
    """
    for i in range(part.shape[0]):
        for k in range(6):
            reach[i, k] = int((boxes[i, k] - whole[k % 3]) / width)
    for step in range(2):
        for i in range(part.shape[0]):
            for x in range(reach[i, 0], reach[i, 3] + 1):
                for y in range(reach[i, 1], reach[i, 4] + 1):
                    row = (x * rows + y) * columns
                    for cell in range(row + reach[i, 2], row + reach[i, 5] + 1):
                        if step == 0 and owner[cell] != part[i]:
                            owner[cell] = part[i] if owner[cell] == -1 else SHARED
                        elif step == 1 and owner[cell] == SHARED:
                            count[cell + 2] += 1
                            near[i] = True


@kernel
def _close_pairs(boxes, part, reach, rows, columns, owner, start):
    """(K, 2) pairs; each is found in the lowest cell that its faces share."""
    listed, pairs, found = np.empty(start[-1], np.int32), np.empty((1024, 2), np.int32), 0
    for i in range(part.shape[0]):
        for x in range(reach[i, 0], reach[i, 3] + 1):
            for y in range(reach[i, 1], reach[i, 4] + 1):
                row = (x * rows + y) * columns
                for cell in range(row + reach[i, 2], row + reach[i, 5] + 1):
                    if owner[cell] == SHARED:
                        listed[start[cell + 1]] = i
                        start[cell + 1] += 1
    for cell in range(start.shape[0] - 2):
        other = start[cell]  # where the next part begins
        for k in range(start[cell], start[cell + 1]):
            i = listed[k]
            while other < start[cell + 1] and part[listed[other]] == part[i]:
                other += 1
            for m in range(other, start[cell + 1]):
                j = listed[m]
                apart = False
                for axis in range(3):
                    apart |= (boxes[i, axis] > boxes[j, 3 + axis]) | (boxes[j, axis] > boxes[i, 3 + axis])
                x, y = max(reach[i, 0], reach[j, 0]), max(reach[i, 1], reach[j, 1])
                if apart or cell != (x * rows + y) * columns + max(reach[i, 2], reach[j, 2]):
                    continue
                if found > MOST_PAIRS:
                    return pairs[:found].copy()
                if found == pairs.shape[0]:
                    pairs = np.concatenate((pairs, pairs))
                pairs[found, 0], pairs[found, 1] = i, j
                found += 1
    return pairs[:found].copy()
