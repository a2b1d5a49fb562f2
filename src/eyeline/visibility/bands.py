"""Bins become a picture, band by band: the depth buffer's second half.

A band's keys stay in the cache while fragments and records fall on them; the greater key wins, so neither the
order of the faces nor the number of threads can matter.
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.fixedpoint import BEFORE_CENTRE, CENTRE, UNITS, depth_at, edge_bias
from eyeline.jit import helper, kernel
from eyeline.visibility.binning import BAND_BITS, BLOCK, make_key

ROWS = 1 << BAND_BITS
LANES = 16  # pixels of a row that are drawn at once
FAR = 32768.0  # pixels: farther than any picture is wide
LEVEL = 1048576.0  # stands for 1 / 0 at a level edge: half a unit outside it is then farther than FAR


@kernel
def draw_bands(part, parts, size, scratch, depth_bits, face):
    """Fill depth_bits (depth as int32) and face, both flat, in bands part, part + parts, ...

    Returns how many depth tests that took.
    """
    ends, previous, pixels, keys, corners, planes, sources = scratch
    width, height = size
    buffer = np.zeros(width * ROWS + 2 * LANES, np.int64)
    spans = np.empty(2 * ROWS, np.int32)
    tests = 0
    for band in range(part, ((height - 1) >> BAND_BITS) + 1, parts):
        row0 = band << BAND_BITS
        row1 = min(height, row0 + ROWS) - 1
        left, right = width, -1
        for binned in range(ends.shape[0]):
            own_pixels, own_keys = pixels[binned], keys[binned]
            own_corners, own_planes, own_sources = corners[binned], planes[binned], sources[binned]
            end = ends[binned, band]
            while end > 0:
                begin = (end - 1) & -BLOCK
                for j in range(begin, end):
                    if own_pixels[j] >= 0:
                        x = own_pixels[j] & 65535
                        left, right = min(left, x), max(right, x)
                        at = np.uint32(((own_pixels[j] >> 16) - row0) * width + x)
                        buffer[at] = max(buffer[at], own_keys[j])
                        tests += 1
                    else:
                        record = own_keys[j]
                        box = set_spans(record, own_corners, width, row0, row1, spans)
                        left, right = min(left, box[0]), max(right, box[1])
                        tests += draw_spans(record, own_planes, own_sources, box, spans, buffer, row0, width)
                end = previous[binned, begin // BLOCK]
        # Beside the columns that something fell on the keys are still 0, and need no look
        left = min(left, right + 1)
        for y in range(row0, row1 + 1):
            begin, row = y * width, (y - row0) * width
            blank(depth_bits[begin : begin + left], face[begin : begin + left])
            finish(
                buffer[row + left : row + right + 1],
                depth_bits[begin + left : begin + right + 1],
                face[begin + left : begin + right + 1],
            )
            blank(depth_bits[begin + right + 1 : begin + width], face[begin + right + 1 : begin + width])
    return tests


@helper
def blank(depth_bits, face):
    """Pixels that nothing fell on."""
    depth_bits[:] = 0
    face[:] = -1


@helper
def finish(keys, depth_bits, face):
    """Split keys into depth and face, and clear them; a key of depth 0 is nothing, as far as the back."""
    for i in range(keys.shape[0]):
        bits = np.int32(keys[i] >> 32)
        depth_bits[i] = bits
        face[i] = ~np.int32(keys[i]) if bits != 0 else np.int32(-1)
        keys[i] = 0


@helper
def set_spans(record, corners, width, row0, row1, spans):
    """The box of a record's face on rows row0..row1, and the first and last pixel of each of its rows.

    spans: from the box's left; the first of row r at r, the last at ROWS + r.
    """
    x0, y0 = np.int64(corners[6 * record]), np.int64(corners[6 * record + 1])
    x1, y1 = np.int64(corners[6 * record + 2]), np.int64(corners[6 * record + 3])
    x2, y2 = np.int64(corners[6 * record + 4]), np.int64(corners[6 * record + 5])
    left = max((min(x0, x1, x2) + BEFORE_CENTRE) >> 8, 0)
    right = min(((max(x0, x1, x2) + BEFORE_CENTRE) >> 8) - 1, width - 1)
    top = max((min(y0, y1, y2) + BEFORE_CENTRE) >> 8, row0)
    bottom = min(((max(y0, y1, y2) + BEFORE_CENTRE) >> 8) - 1, row1)
    cx, cy, most = left * UNITS + CENTRE, top * UNITS + CENTRE, right - left
    e0, b0, lower0, begin0, upper0, end0 = bounds(x1, y1, x2, y2, cx, cy, most)
    e1, b1, lower1, begin1, upper1, end1 = bounds(x2, y2, x0, y0, cx, cy, most)
    e2, b2, lower2, begin2, upper2, end2 = bounds(x0, y0, x1, y1, cx, cy, most)
    # Eight rows at a time, without branches: the loop becomes vector instructions
    for r in range((bottom - top + 8) & -8):
        f0, f1, f2 = e0 + b0 * np.float64(r), e1 + b1 * np.float64(r), e2 + b2 * np.float64(r)
        low = greater(greater(f0 * lower0 + begin0, f1 * lower1 + begin1), f2 * lower2 + begin2)
        high = lesser(lesser(f0 * upper0 + end0, f1 * upper1 + end1), f2 * upper2 + end2)
        # No bound is whole, so that cutting off its fraction rounds one up and the other down
        spans[r] = np.int32(lesser(greater(low, -0.5), FAR) + 1.0)
        spans[ROWS + r] = np.int32(greater(high, -0.5) + 1.0) - np.int32(1)
    return left, right, top, bottom


@helper
def bounds(x0, y0, x1, y1, cx, cy, most):
    """What an edge that leads clockwise demands of pixels right of and below the centre (cx, cy).

    (e, b, lower, begin, upper, end): r rows below, with f = e + b r, a pixel i to the right is inside from
    f lower + begin to f upper + end, of which one is the edge's and the other beyond the box. All is exact:
    e has half a unit more than the edge function, so that no quotient is whole, and none is rounded to the
    other side of a whole number.
    """
    a, b = y0 - y1, x1 - x0
    e = np.float64(a * (cx - x0) + b * (cy - y0) + edge_bias(a, b)) + 0.5
    inverse = -1.0 / np.float64(a * UNITS) if a != 0 else -LEVEL
    down = np.float64(b * UNITS)
    rises = a >= 0
    lower, begin = (inverse if rises else 0.0), (0.0 if rises else -0.5)
    upper, end = (0.0 if rises else inverse), (np.float64(most) + 0.5 if rises else 0.0)
    return e, down, lower, begin, upper, end


@helper
def draw_spans(record, planes, sources, box, spans, buffer, row0, width):
    """Draw a record's face where its spans are; how many pixels that is."""
    a, b, c, source = planes[3 * record], planes[3 * record + 1], planes[3 * record + 2], sources[record]
    left, right, top, bottom = box
    pixels, narrow = 0, right - left < LANES
    for y in range(top, bottom + 1):
        low, high = np.int64(spans[y - top]), np.int64(spans[ROWS + y - top])
        if low > high:
            continue
        pixels += high - low + 1
        at = (y - row0) * width + left
        if narrow:
            # One step from the box's left: its number of lanes is known, nothing is left over
            first, last, x = np.int32(low), np.int32(high), np.float64(left)
            row = buffer[at : at + LANES]
            for i in range(LANES):
                key = make_key(depth_at(a, b, c, x + np.float64(np.int32(i)), y), source)
                row[i] = max(row[i], key if (np.int32(i) >= first) & (np.int32(i) <= last) else np.int64(0))
        else:
            last, x = np.int32(high - low), np.float64(left + low)
            row = buffer[at + low : at + low + ((high - low + LANES) & -LANES)]
            for i in range(row.shape[0]):
                key = make_key(depth_at(a, b, c, x + np.float64(np.int32(i)), y), source)
                row[i] = max(row[i], key if np.int32(i) <= last else np.int64(0))
    return pixels


@helper
def greater(a, b):
    """The greater of two numbers, none of which is NaN: one instruction."""
    return a if a > b else b


@helper
def lesser(a, b):
    """The lesser of two numbers, none of which is NaN: one instruction."""
    return a if a < b else b
