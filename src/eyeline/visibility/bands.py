"""Bins become a picture, band by band: the depth buffer's second half.

A band's keys stay in the cache while fragments and records fall on them; the greater key wins, so neither the
order of the faces nor the number of threads can matter.
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.fixedpoint import BEFORE_CENTRE, CENTRE, depth_at, edge_bias
from eyeline.jit import helper, kernel
from eyeline.visibility.binning import BAND_BITS, BLOCK, make_key

LANES = 16  # pixels of a row that are drawn at once


@kernel
def draw_bands(part, parts, size, scratch, depth_bits, face):
    """Fill depth_bits (depth as int32) and face, both flat, in bands part, part + parts, ...

    Returns how many depth tests that took.
    """
    ends, previous, pixels, keys, corners, planes, sources = scratch
    width, height = size
    buffer = np.empty((width << BAND_BITS) + 4 * LANES, np.int64)
    tests = 0
    for band in range(part, ((height - 1) >> BAND_BITS) + 1, parts):
        row0 = band << BAND_BITS
        row1 = min(height, row0 + (1 << BAND_BITS)) - 1
        buffer[:] = 0
        for source in range(ends.shape[0]):
            own_pixels, own_keys = pixels[source], keys[source]
            own_corners, own_planes, own_sources = corners[source], planes[source], sources[source]
            end = ends[source, band]
            while end > 0:
                begin = (end - 1) & -BLOCK
                for j in range(begin, end):
                    if own_pixels[j] >= 0:
                        o = np.uint32(((own_pixels[j] >> 16) - row0) * width + (own_pixels[j] & 65535))
                        buffer[o] = max(buffer[o], own_keys[j])
                    else:
                        tests -= 1
                        tests += draw_record(
                            own_keys[j], own_corners, own_planes, own_sources, buffer, row0, row1, width
                        )
                tests += end - begin
                end = previous[source, begin // BLOCK]
        finish(buffer, depth_bits[row0 * width : (row1 + 1) * width], face[row0 * width : (row1 + 1) * width])
    return tests


@helper
def finish(buffer, depth_bits, face):
    """Split keys into depth and face; a key of depth 0 is nothing, as far as the back."""
    for i in range(depth_bits.shape[0]):
        bits = np.int32(buffer[i] >> 32)
        depth_bits[i] = bits
        face[i] = ~np.int32(buffer[i]) if bits != 0 else np.int32(-1)


@helper
def draw_record(record, corners, planes, sources, buffer, row0, row1, width):
    """Draw a record's face on rows row0..row1, which are in the buffer; how many pixels it covers there."""
    x0, y0 = np.int64(corners[6 * record]), np.int64(corners[6 * record + 1])
    x1, y1 = np.int64(corners[6 * record + 2]), np.int64(corners[6 * record + 3])
    x2, y2 = np.int64(corners[6 * record + 4]), np.int64(corners[6 * record + 5])
    a, b, c = planes[3 * record], planes[3 * record + 1], planes[3 * record + 2]
    left, right = (min(x0, x1, x2) + BEFORE_CENTRE) >> 8, ((max(x0, x1, x2) + BEFORE_CENTRE) >> 8) - 1
    top, bottom = (min(y0, y1, y2) + BEFORE_CENTRE) >> 8, ((max(y0, y1, y2) + BEFORE_CENTRE) >> 8) - 1
    narrow = (right - left < LANES) & (bottom - top < 64)
    left, right, top, bottom = max(left, 0), min(right, width - 1), max(top, row0), min(bottom, row1)
    cx, cy = left * 256 + CENTRE, top * 256 + CENTRE
    a0, b0, a1, b1, a2, b2 = y1 - y2, x2 - x1, y2 - y0, x0 - x2, y0 - y1, x1 - x0
    e0 = a0 * (cx - x1) + b0 * (cy - y1) + edge_bias(a0, b0)
    e1 = a1 * (cx - x2) + b1 * (cy - y2) + edge_bias(a1, b1)
    e2 = a2 * (cx - x0) + b2 * (cy - y0) + edge_bias(a2, b2)
    a0, b0, a1, b1, a2, b2 = a0 * 256, b0 * 256, a1 * 256, b1 * 256, a2 * 256, b2 * 256
    source, pixels = sources[record], 0
    if narrow:
        f0, f1, f2 = np.int32(e0), np.int32(e1), np.int32(e2)
        s0, s1, s2 = np.int32(a0), np.int32(a1), np.int32(a2)
        last, fx = np.int32(right - left), np.float64(left)
        for y in range(top, bottom + 1):
            at = (y - row0) * width + left
            row = buffer[at : at + LANES]
            for i in range(LANES):
                inside = (
                    np.int32(
                        np.int32(f0 + np.int32(np.int32(i) * s0))
                        | np.int32(f1 + np.int32(np.int32(i) * s1))
                        | np.int32(f2 + np.int32(np.int32(i) * s2))
                    )
                    >= 0
                ) & (np.int32(i) <= last)
                key = make_key(depth_at(a, b, c, fx + np.float64(np.int32(i)), y), source)
                row[i] = max(row[i], key if inside else np.int64(0))
                pixels += inside
            f0, f1, f2 = np.int32(f0 + b0), np.int32(f1 + b1), np.int32(f2 + b2)
    else:
        s0, s1, s2 = np.float64(a0), np.float64(a1), np.float64(a2)
        i0, i1, i2 = inverse(s0), inverse(s1), inverse(s2)
        # Half a unit more: no quotient is whole then, and none is rounded to the other side of a whole number
        g0, g1, g2 = np.float64(e0) + 0.5, np.float64(e1) + 0.5, np.float64(e2) + 0.5
        for y in range(top, bottom + 1):
            low, high = narrowed(g0, s0, i0, 0.0, np.float64(right - left))
            low, high = narrowed(g1, s1, i1, low, high)
            low, high = narrowed(g2, s2, i2, low, high)
            g0, g1, g2 = g0 + np.float64(b0), g1 + np.float64(b1), g2 + np.float64(b2)
            if low > high:
                continue
            x = left + np.int64(low)
            fx = np.float64(x)
            last = np.int32(high - low)
            pixels += np.int64(last) + 1
            at = (y - row0) * width + x
            row = buffer[at : at + ((np.int64(last) + 16) & -16)]
            for i in range(row.shape[0]):
                key = make_key(depth_at(a, b, c, fx + np.float64(np.int32(i)), y), source)
                row[i] = max(row[i], key if np.int32(i) <= last else np.int64(0))
    return pixels


@helper
def inverse(a):
    """1 / a; 0 for 0."""
    return 1.0 / a if a != 0.0 else 0.0


@helper
def narrowed(e, a, inverse, low, high):
    """low..high, narrowed to the i with e + a i > 0."""
    q = -e * inverse
    low = max(low, np.ceil(q)) if a > 0 else low
    high = min(high, np.floor(q)) if a < 0 else high
    return low, (-1.0 if (a == 0) & (e < 0) else high)
