"""The picture in cells of 8x8 pixels: what a face covers of one is 64 bits of one whole number.

Two faces lie over each other in a cell where their masks share a bit; a face that is cut is a mask that is
parted. Coverage is the picture's own, bit for bit: a centre on a shared edge belongs to one face.
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.fixedpoint import (
    BEFORE_CENTRE,
    CENTRE,
    UNITS,
    depth_at,
    depth_plane,
    edge_bias,
    signed_area,
)
from eyeline.jit import helper, kernel
from eyeline.projection.projected import CLOCKWISE, COUNTER_CLOCKWISE

CELL_BITS = 3
CELL = 1 << CELL_BITS  # pixels, across and down: a mask is 64 bits, row after row


@kernel
def count_parts(part, parts, faces, xy, sides, size, counts):
    """Count the cells that the boxes of a range of faces touch; how many of the faces turn away.

    counts: (cells * parts,) int32; the counter of a cell and this part is raised.
    """
    width, height = size
    cells = (width + CELL - 1) >> CELL_BITS
    step = 0 if sides.shape[0] == 1 else 1
    count, away = faces.shape[0] // 3, 0
    for face in range(count * part // parts, count * (part + 1) // parts):
        i0, i1, i2 = 2 * faces[3 * face], 2 * faces[3 * face + 1], 2 * faces[3 * face + 2]
        x0, y0, x1, y1 = np.int64(xy[i0]), np.int64(xy[i0 + 1]), np.int64(xy[i1]), np.int64(xy[i1 + 1])
        x2, y2 = np.int64(xy[i2]), np.int64(xy[i2 + 1])
        area = signed_area(x0, y0, x1, y1, x2, y2)
        if area == 0 or (sides[face * step] & (CLOCKWISE if area > 0 else COUNTER_CLOCKWISE)) == 0:
            away += 1
            continue
        left = max((min(x0, x1, x2) + BEFORE_CENTRE) >> 8, 0) >> CELL_BITS
        right = min(((max(x0, x1, x2) + BEFORE_CENTRE) >> 8) - 1, width - 1)
        top = max((min(y0, y1, y2) + BEFORE_CENTRE) >> 8, 0) >> CELL_BITS
        bottom = min(((max(y0, y1, y2) + BEFORE_CENTRE) >> 8) - 1, height - 1)
        for row in range(top, (bottom >> CELL_BITS) + 1):
            for column in range(left, (right >> CELL_BITS) + 1):
                counts[(row * cells + column) * parts + part] += 1
    return away


@kernel
def fill_parts(part, parts, faces, xy, depth, sides, size, rows, free, numbers, masks, depths, planes):
    """Write what a range of faces covers in the cells of some rows of cells, where `free` says; move it on.

    rows: first and end. free: (cells of these rows * parts,) int64, the next place of a cell and this part.
    For every place: number, mask, least and greatest depth (2,), plane (3,).
    """
    width, height = size
    cells = (width + CELL - 1) >> CELL_BITS
    step = 0 if sides.shape[0] == 1 else 1
    count = faces.shape[0] // 3
    for face in range(count * part // parts, count * (part + 1) // parts):
        i0, i1, i2 = faces[3 * face], faces[3 * face + 1], faces[3 * face + 2]
        x0, y0, z0 = np.int64(xy[2 * i0]), np.int64(xy[2 * i0 + 1]), depth[i0]
        x1, y1, z1 = np.int64(xy[2 * i1]), np.int64(xy[2 * i1 + 1]), depth[i1]
        x2, y2, z2 = np.int64(xy[2 * i2]), np.int64(xy[2 * i2 + 1]), depth[i2]
        left = max((min(x0, x1, x2) + BEFORE_CENTRE) >> 8, 0)
        right = min(((max(x0, x1, x2) + BEFORE_CENTRE) >> 8) - 1, width - 1)
        top = max((min(y0, y1, y2) + BEFORE_CENTRE) >> 8, rows[0] << CELL_BITS)
        bottom = min(((max(y0, y1, y2) + BEFORE_CENTRE) >> 8) - 1, height - 1, (rows[1] << CELL_BITS) - 1)
        if left > right or top > bottom:
            continue
        area = signed_area(x0, y0, x1, y1, x2, y2)
        if area == 0 or (sides[face * step] & (CLOCKWISE if area > 0 else COUNTER_CLOCKWISE)) == 0:
            continue
        # Corners 1 and 2 of a counter-clockwise face change places, so that its edges lead clockwise
        if area < 0:
            x1, y1, z1, x2, y2, z2 = x2, y2, z2, x1, y1, z1
        a, b, c = depth_plane(x0, y0, z0, x1, y1, z1, x2, y2, z2)
        for row in range(top >> CELL_BITS, (bottom >> CELL_BITS) + 1):
            t, u = max(top, row << CELL_BITS), min(bottom, (row << CELL_BITS) + CELL - 1)
            for column in range(left >> CELL_BITS, (right >> CELL_BITS) + 1):
                s, r = max(left, column << CELL_BITS), min(right, (column << CELL_BITS) + CELL - 1)
                mask = covered_bits(x0, y0, x1, y1, x2, y2, s, r, t, u)
                if mask == 0:
                    continue
                low, high = depth_range(a, b, c, s, r, t, u)
                if low <= np.float32(0):
                    mask &= nearer_bits(a, b, c, 0, 0.0, 0.0, 0.0, -1, column << CELL_BITS, row << CELL_BITS)
                    low = np.float32(0)
                    if mask == 0:
                        continue
                cell = ((row - rows[0]) * cells + column) * parts + part
                place = free[cell]
                numbers[place], masks[place] = face, mask
                depths[2 * place], depths[2 * place + 1] = low, high
                planes[3 * place], planes[3 * place + 1], planes[3 * place + 2] = a, b, c
                free[cell] = place + 1


@helper
def covered_bits(x0, y0, x1, y1, x2, y2, left, right, top, bottom):
    """The mask of a face, given clockwise, in a box of pixels inside one cell."""
    cx, cy = left * UNITS + CENTRE, top * UNITS + CENTRE
    e0, a0, b0 = edge_from(x1, y1, x2, y2, cx, cy)
    e1, a1, b1 = edge_from(x2, y2, x0, y0, cx, cy)
    e2, a2, b2 = edge_from(x0, y0, x1, y1, cx, cy)
    width, height = right - left, bottom - top
    # An edge function is greatest and least at corners of the box
    most0 = e0 + max(a0, 0) * width + max(b0, 0) * height
    most1 = e1 + max(a1, 0) * width + max(b1, 0) * height
    most2 = e2 + max(a2, 0) * width + max(b2, 0) * height
    mask, one = np.int64(0), np.int64(1)
    if (most0 | most1 | most2) < 0:
        return mask
    least0 = e0 + min(a0, 0) * width + min(b0, 0) * height
    least1 = e1 + min(a1, 0) * width + min(b1, 0) * height
    least2 = e2 + min(a2, 0) * width + min(b2, 0) * height
    if (least0 | least1 | least2) >= 0:
        line = ((one << (width + 1)) - one) << (left & (CELL - 1))
        for y in range(top, bottom + 1):
            mask |= line << ((y & (CELL - 1)) << CELL_BITS)
        return mask
    for y in range(top, bottom + 1):
        f0, f1, f2 = e0, e1, e2
        bit = one << (((y & (CELL - 1)) << CELL_BITS) | (left & (CELL - 1)))
        for _ in range(width + 1):
            mask |= bit if (f0 | f1 | f2) >= 0 else np.int64(0)
            f0, f1, f2, bit = f0 + a0, f1 + a1, f2 + a2, bit << one
        e0, e1, e2 = e0 + b0, e1 + b1, e2 + b2
    return mask


@helper
def edge_from(x0, y0, x1, y1, cx, cy):
    """The edge function of an edge that leads clockwise at the centre (cx, cy), and its steps of a pixel."""
    a, b = y0 - y1, x1 - x0
    return a * (cx - x0) + b * (cy - y0) + edge_bias(a, b), a * UNITS, b * UNITS


@helper
def depth_range(a, b, c, left, right, top, bottom):
    """The least and the greatest depth of a plane at the pixels of a box.

    They stand at its corners even after rounding: every operation of `depth_at` is monotonic in x and in y.
    """
    low = depth_at(a, b, c, left if a >= 0 else right, top if b >= 0 else bottom)
    return low, depth_at(a, b, c, right if a >= 0 else left, bottom if b >= 0 else top)


@helper
def nearer_bits(a, b, c, source, a1, b1, c1, source1, x, y):
    """The pixels of the cell at (x, y) where the first plane is nearer; a tie goes to the lower number.

    It is where the first side of the line stands in which the planes cut each other.
    """
    mask, bit = np.int64(0), np.int64(1)
    for row in range(CELL):
        for column in range(CELL):
            own = depth_at(a, b, c, x + column, y + row)
            other = depth_at(a1, b1, c1, x + column, y + row)
            mask |= bit if own > other or (own == other and source < source1) else np.int64(0)
            bit <<= np.int64(1)
    return mask
