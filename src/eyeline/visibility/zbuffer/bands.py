"""Bins become a picture, band by band: the depth buffer's second half.

A band's keys stay in the cache while fragments and records fall on them; the greater key wins, so neither the
order of the faces nor the number of threads can matter.
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.fixedpoint import BEFORE_CENTRE, CENTRE, UNITS, depth_at, edge_bias
from eyeline.jit import helper, kernel
from eyeline.visibility.zbuffer.binning import BAND_BITS, BLOCK, WORDS, make_key
from eyeline.visibility.zbuffer.scratch import LINE

ROWS = 1 << BAND_BITS
NARROW = 2 * LINE  # pixels: a face that is wider is drawn by its spans
SMALL = 32 * UNITS  # of a box's sides, so that int32 holds its edge functions, also a line beside it
FAR = 32768.0  # pixels: farther than any picture is wide
LEVEL = 1048576.0  # stands for 1 / 0 at a level edge: half a unit outside it is then farther than FAR


@kernel
def draw_bands(part, parts, size, scratch, depth_bits, face):
    """Fill depth_bits (depth as int32) and face, both flat, in bands part, part + parts, ...

    Returns how many depth tests that took.
    """
    ends, previous, pixels, keys, records = scratch[:5]
    width, height = size
    buffer = scratch.buffer[part]
    pitch = buffer.shape[0] // ROWS
    spans = np.empty(2 * ROWS, np.int32)
    tests = 0
    for band in range(part, ((height - 1) >> BAND_BITS) + 1, parts):
        row0 = band << BAND_BITS
        row1 = min(height, row0 + ROWS) - 1
        left, right = width, -1
        for binned in range(ends.shape[0]):
            end = ends[binned, band]
            while end > 0:
                begin = (end - 1) & -BLOCK
                drawn = draw_entries(
                    pixels[binned, begin:end], keys[binned, begin:end], records[binned],
                    spans, buffer, pitch, width, row0, row1,
                )  # fmt: skip
                left, right, tests = min(left, drawn[0]), max(right, drawn[1]), tests + drawn[2]
                end = previous[binned, begin // BLOCK]
        if right < left:
            blank(depth_bits[row0 * width : (row1 + 1) * width], face[row0 * width : (row1 + 1) * width])
            continue
        # Beside the columns that something fell on the keys are still 0, and need no look
        for y in range(row0, row1 + 1):
            begin, row = y * width, (y - row0) * pitch
            blank(depth_bits[begin : begin + left], face[begin : begin + left])
            finish(
                buffer[row + left : row + right + 1],
                depth_bits[begin + left : begin + right + 1],
                face[begin + left : begin + right + 1],
            )
            blank(depth_bits[begin + right + 1 : begin + width], face[begin + right + 1 : begin + width])
    return tests


@helper
def draw_entries(pixels, keys, records, spans, buffer, pitch, width, row0, row1):
    """Draw entries of a bin; the first and last column that they fell on, and how many pixels that is.

    A NARROW record is drawn by its edge functions, a line of pixels wide and down all its rows, in int32,
    which is exact for SMALL ones; any other, and one that is cut by the picture's right border, by its spans.
    """
    leftmost, rightmost, tests, lanes = width, -1, 0, line_of(pitch)
    for j in range(pixels.shape[0]):
        if pixels[j] >= 0:
            x = np.int64(pixels[j] & 65535)
            leftmost, rightmost = min(leftmost, x), max(rightmost, x)
            at = np.uint32(((pixels[j] >> 16) - row0) * pitch + x)
            buffer[at] = max(buffer[at], keys[j])
            tests += 1
            continue
        record = np.uint64(keys[j] * WORDS)
        p0, p1, p2 = records[record], records[record + np.uint64(1)], records[record + np.uint64(2)]
        x0, y0, x1, y1 = np.int64(np.int32(p0)), p0 >> 32, np.int64(np.int32(p1)), p1 >> 32
        x2, y2 = np.int64(np.int32(p2)), p2 >> 32
        least_x, most_x, least_y, most_y = min(x0, x1, x2), max(x0, x1, x2), min(y0, y1, y2), max(y0, y1, y2)
        left, right = max((least_x + BEFORE_CENTRE) >> 8, 0), ((most_x + BEFORE_CENTRE) >> 8) - 1
        top, bottom = (
            max((least_y + BEFORE_CENTRE) >> 8, row0),
            min(((most_y + BEFORE_CENTRE) >> 8) - 1, row1),
        )
        leftmost, rightmost = min(leftmost, left), max(rightmost, min(right, width - 1))
        if right >= min(left + NARROW, width) or max(most_x - least_x, most_y - least_y) > SMALL:
            set_spans(x0, y0, x1, y1, x2, y2, left, min(right, width - 1), top, bottom, spans)
            tests += draw_spans(record, records, left, top, bottom, spans, buffer, row0, pitch)
            continue
        a = np.int64(records[record + np.uint64(3)]).view(np.float64)
        b = np.int64(records[record + np.uint64(4)]).view(np.float64)
        c = np.int64(records[record + np.uint64(5)]).view(np.float64)
        low_half = records[record + np.uint64(6)]
        cx, cy = left * UNITS + CENTRE, top * UNITS + CENTRE
        e0, a0, b0 = edge(x1, y1, x2, y2, cx, cy)
        e1, a1, b1 = edge(x2, y2, x0, y0, cx, cy)
        e2, a2, b2 = edge(x0, y0, x1, y1, cx, cy)
        for x in range(left, right + 1, LINE):
            f0, f1, f2 = e0, e1, e2
            for y in range(top, bottom + 1):
                begin, covered = np.uint64((y - row0) * pitch + x), np.int32(0)
                for i in range(lanes):
                    lane = np.int32(i)
                    g0, g1, g2 = (
                        np.int32(f0 + np.int32(a0 * lane)),
                        np.int32(f1 + np.int32(a1 * lane)),
                        np.int32(f2 + np.int32(a2 * lane)),
                    )
                    inside = (g0 | g1 | g2) >= 0
                    key = make_key(depth_at(a, b, c, np.float64(x) + np.float64(lane), y), low_half)
                    place = begin + np.uint64(i)
                    buffer[place] = max(buffer[place], key if inside else np.int64(0))
                    covered = np.int32(covered + np.int32(inside))
                tests += covered
                f0, f1, f2 = np.int32(f0 + b0), np.int32(f1 + b1), np.int32(f2 + b2)
            e0, e1, e2 = np.int32(e0 + LINE * a0), np.int32(e1 + LINE * a1), np.int32(e2 + LINE * a2)
    return leftmost, rightmost, tests


@helper
def edge(x0, y0, x1, y1, cx, cy):
    """The edge function of an edge that leads clockwise at the centre (cx, cy), and its steps of a pixel."""
    a, b = y0 - y1, x1 - x0
    e = a * (cx - x0) + b * (cy - y0) + edge_bias(a, b)
    return np.int32(e), np.int32(a * UNITS), np.int32(b * UNITS)


@helper
def line_of(pitch):
    """LINE, in a way that the compiler does not see through: else it unrolls loops and finds no vectors."""
    return min(pitch, LINE) & LINE


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
def set_spans(x0, y0, x1, y1, x2, y2, left, right, top, bottom, spans):
    """The first and last pixel of a face, given clockwise, on each row of a box, from the box's left.

    spans: the first of row r at r, the last at ROWS + r.
    """
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
def draw_spans(record, records, left, top, bottom, spans, buffer, row0, pitch):
    """Draw a record's face where its spans are; how many pixels that is."""
    a = np.int64(records[record + np.uint64(3)]).view(np.float64)
    b = np.int64(records[record + np.uint64(4)]).view(np.float64)
    c = np.int64(records[record + np.uint64(5)]).view(np.float64)
    low_half = records[record + np.uint64(6)]
    pixels, lanes = 0, line_of(pitch)
    for r in range(bottom - top + 1):
        low, high, y = left + np.int64(spans[r]), left + np.int64(spans[ROWS + r]), top + r
        if low > high:
            continue
        pixels += high - low + 1
        begin = np.uint64((y - row0) * pitch)
        for x in range(low, high + 1, LINE):
            x0, last = np.float64(x), np.int32(high - x)
            for i in range(lanes):
                key = make_key(depth_at(a, b, c, x0 + np.float64(np.int32(i)), y), low_half)
                place = begin + np.uint64(x + i)
                buffer[place] = max(buffer[place], key if np.int32(i) <= last else np.int64(0))
    return pixels


@helper
def greater(a, b):
    """The greater of two numbers, none of which is NaN: one instruction."""
    return a if a > b else b


@helper
def lesser(a, b):
    """The lesser of two numbers, none of which is NaN: one instruction."""
    return a if a < b else b
