"""Cells are put in order, cut where there is none, and painted from the back: the painter's second half.

The list of a cell stands in columns, farthest first. What is painted has mask 0, so that the test of masks
passes it over; of a part that is cut, one piece stays and the other is inserted after it.
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.fixedpoint import depth_at
from eyeline.jit import helper, kernel, trailing_zeros
from eyeline.visibility.fragments import SHORT, sort_by_heap, sort_by_insertion
from eyeline.visibility.painter.cell_masks import CELL, CELL_BITS, nearer_bits

# The counters, in the order of painter.WORK
PARTS, DEPTHS, EXTENTS, PIXELS, BEHIND, BEFORE, SWAPS, SPLITS, HIDDEN, PAINTED = range(10)
COUNTERS = 10

# The columns of a cell's list, int64: a part's place, scene face, mask and extent; its least and greatest
# depth, as the bits of float32, which are in order where none is negative; whether it waits. Then the stack
# of parts that wait, where each goes on in the list, and the keys to sort by
PLACE, SOURCE, MASK, EXTENT, LOW, HIGH, WAITS, STACK, RESUME, KEY = range(10)
COLUMNS = 10

ROOM = 256  # parts of a cell, at first
LOW32 = 0xFFFFFFFF
DONE, STOPPED = -1, -2


@kernel
def paint_cells(
    part, parts, rows, size, begins, ends, numbers, masks, depths, planes, uncut, pieces, most,
    face, depth, work,
):  # fmt: skip
    """Paint every parts-th row of cells of `rows` (first and end): fill the picture's face and depth, flat.

    begins, ends: (cells of these rows * lists,) the places of each cell's parts, as `fill_parts` left them.
    most: comparisons and splits after which to stop. work: (COUNTERS,) int64 of this part.
    """
    cells = (size[0] + CELL - 1) >> CELL_BITS
    lists = begins.shape[0] // ((rows[1] - rows[0]) * cells)
    columns = np.empty((COLUMNS, ROOM), np.int64)
    owner = np.empty(CELL * CELL, np.int64)
    for row in range(rows[0] + part, rows[1], parts):
        for column in range(cells):
            first = ((row - rows[0]) * cells + column) * lists
            n = 0
            for k in range(first, first + lists):
                n += ends[k] - begins[k]
            if n > columns.shape[1]:
                columns = np.empty((COLUMNS, 2 * n), np.int64)
            sort_parts(begins[first : first + lists], ends[first : first + lists], depths, columns, n)
            for i in range(n):
                at = columns[STACK, n - 1 - (columns[KEY, i] & LOW32)]
                number = np.int64(numbers[at])
                columns[PLACE, i] = at
                columns[SOURCE, i] = number if number < uncut else pieces[number - uncut]
                columns[MASK, i], columns[EXTENT, i] = masks[at], extent_of(masks[at])
                columns[LOW, i], columns[HIGH, i] = bits_of(depths[2 * at]), bits_of(depths[2 * at + 1])
                columns[WAITS, i] = 0
            work[PARTS] += n
            owner[:] = -1
            corner = column << CELL_BITS, row << CELL_BITS
            while True:
                cut, border = order(n, columns, planes, owner, corner, most[0], work)
                if cut == STOPPED or work[SPLITS] > most[1]:
                    return
                if cut == DONE:
                    break
                if n == columns.shape[1]:
                    wider = np.empty((COLUMNS, 2 * n), np.int64)
                    # One by one: to assign a slice, Numba calls what a kept kernel cannot be linked to
                    for k in range(COLUMNS):
                        for i in range(n):
                            wider[k, i] = columns[k, i]
                    columns = wider
                insert(cut, border, n, columns)
                n += 1
            show(owner, numbers, planes, uncut, pieces, corner, size, face, depth)


@helper
def sort_parts(begins, ends, depths, columns, count):
    """List a cell's places in STACK, and sort KEY: farthest first, of equal depths the later place first."""
    n = 0
    for k in range(begins.shape[0]):
        for at in range(begins[k], ends[k]):
            columns[KEY, n], columns[STACK, n] = (bits_of(depths[2 * at]) << 32) | (count - 1 - n), at
            n += 1
    keys = columns[KEY]
    if n > SHORT:
        sort_by_heap(keys, 0, n)
    else:
        sort_by_insertion(keys, 0, n)


@helper
def order(n, columns, planes, owner, corner, most, work):
    """Paint a cell's parts, farthest first: `owner` holds the place of the last at every pixel.

    Returns (DONE, 0), (STOPPED, 0) after too many comparisons, or which part must be cut, and the border.
    """
    head, depth = 0, 0
    while True:
        if depth == 0:
            while head < n and columns[MASK, head] == 0:
                head += 1
            if head == n:
                return DONE, np.int64(0)
            columns[STACK, 0], columns[RESUME, 0], depth = head, head + 1, 1
        p = columns[STACK, depth - 1]

        # The next one that shares pixels with p, of those that are not certainly nearer
        j, nearest = columns[RESUME, depth - 1], columns[HIGH, p]
        own, span = columns[MASK, p], columns[EXTENT, p]
        across, apart = 0, 0
        while j < n and columns[LOW, j] <= nearest:
            if own & columns[MASK, j] != 0 and j != p:
                break
            left, common = columns[MASK, j] != 0 and j != p, span & columns[EXTENT, j]
            disjoint = (common & 255) == 0 or common < 256
            across += left and disjoint
            apart += left and not disjoint
            j += 1
        work[EXTENTS] += across
        work[PIXELS] += apart
        if j == n or columns[LOW, j] > nearest:
            # None has to come before p
            while j < n and columns[MASK, j] == 0:
                j += 1
            work[DEPTHS] += j < n
            bits = own
            while bits != 0:
                bit = trailing_zeros(bits)
                owner[bit] = columns[PLACE, p]
                bits ^= np.int64(1) << bit
                work[PAINTED] += 1
            columns[MASK, p], columns[WAITS, p], depth = 0, 0, depth - 1
            continue
        columns[RESUME, depth - 1] = j + 1
        if work[DEPTHS] + work[EXTENTS] + work[PIXELS] + work[BEHIND] + work[BEFORE] > most:
            return STOPPED, np.int64(0)

        # The planes of the two
        f, g = 3 * columns[PLACE, p], 3 * columns[PLACE, j]
        nearer = nearer_bits(
            planes[f], planes[f + 1], planes[f + 2], columns[SOURCE, p],
            planes[g], planes[g + 1], planes[g + 2], columns[SOURCE, j], corner[0], corner[1],
        )  # fmt: skip
        if own & nearer == 0:
            work[BEHIND] += 1
            if own & ~columns[MASK, j] == 0:
                work[HIDDEN] += 1
                columns[MASK, p], columns[WAITS, p], depth = 0, 0, depth - 1
            continue
        if columns[MASK, j] & nearer == 0:
            work[BEFORE] += 1
            continue
        columns[WAITS, p] = 1
        if own & ~nearer != 0 and columns[MASK, j] & ~nearer != 0:
            # They pierce each other
            work[SPLITS] += 1
            return p, nearer
        if columns[WAITS, j] == 0:
            work[SWAPS] += 1
            columns[STACK, depth], columns[RESUME, depth], depth = j, head, depth + 1
            continue
        # A cycle: from the last that waits, the first that is not within what it waits for. There is one:
        # if all had the same pixels, one of them would be the farthest there
        while columns[MASK, p] & ~columns[MASK, j] == 0:
            depth -= 1
            j, p = p, columns[STACK, depth - 1]
        work[SPLITS] += 1
        return p, columns[MASK, j]


@helper
def insert(cut, border, n, columns):
    """Part the `cut`-th of n: what is outside the border stays, what is within comes next. None waits."""
    for column in range(WAITS):
        for k in range(n, cut, -1):
            columns[column, k] = columns[column, k - 1]
    columns[MASK, cut] &= ~border
    columns[MASK, cut + 1] &= border
    columns[EXTENT, cut], columns[EXTENT, cut + 1] = (
        extent_of(columns[MASK, cut]), extent_of(columns[MASK, cut + 1]),
    )  # fmt: skip
    for k in range(n + 1):
        columns[WAITS, k] = 0


@helper
def show(owner, numbers, planes, uncut, pieces, corner, size, face, depth):
    """Write face and depth of a cell's pixels inside the picture."""
    for bit in range(CELL * CELL):
        x, y = corner[0] + (bit & (CELL - 1)), corner[1] + (bit >> CELL_BITS)
        if x >= size[0] or y >= size[1]:
            continue
        at, pixel = owner[bit], y * size[0] + x
        if at < 0:
            face[pixel], depth[pixel] = -1, np.float32(0)
            continue
        number = numbers[at]
        face[pixel] = number if number < uncut else pieces[number - uncut]
        depth[pixel] = depth_at(planes[3 * at], planes[3 * at + 1], planes[3 * at + 2], x, y)


@helper
def extent_of(mask):
    """The columns (8 bits) and, above them, the rows (8 bits) in which a mask has pixels."""
    columns = mask | (mask >> 32)
    columns |= columns >> 16
    columns |= columns >> 8
    extent = columns & 255
    for row in range(CELL):
        if (mask >> (row << CELL_BITS)) & 255:
            extent |= np.int64(256) << row
    return extent


@helper
def bits_of(depth):
    """The bits of a depth that is not negative."""
    return np.int64(np.float32(depth).view(np.int32))
