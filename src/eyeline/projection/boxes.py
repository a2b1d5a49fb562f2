"""Where on the picture's grid the vertices in a box can fall, without looking at one of them.

Rounding keeps order: if a <= b then round(a) <= round(b), and the same holds for sums, products and quotients
of such numbers. So the formula of `placed`, step by step the same but with the least and the greatest that
each number can be, gives bounds that hold for every vertex in the box to the last bit. [Moore66]
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.fixedpoint import GUARD
from eyeline.jit import helper

SURE = 2.0**-19  # of a sum's largest terms: more than float32 loses of it, in the numbers and in the matrix


@helper
def span(a, b, c, d, box):
    """The least and greatest a x + b y + c z + d of points in a box (low x y z, high x y z)."""
    lx, ly, lz, hx, hy, hz = box
    low = a * (lx if a >= 0 else hx) + b * (ly if b >= 0 else hy) + c * (lz if c >= 0 else hz) + d
    high = a * (hx if a >= 0 else lx) + b * (hy if b >= 0 else ly) + c * (hz if c >= 0 else lz) + d
    return low, high


@helper
def box_on_grid(m, across, down, box):
    """(all placed, left, top, right, bottom, farthest, nearest) of the vertices in a box, as `placed` places.

    Where some of them may lie behind the near plane or beyond the guard band nothing else is told.
    """
    one, half, guard = np.float32(1), np.float32(0.5), np.float32(GUARD)
    low_w, high_w = span(m[12], m[13], m[14], m[15], box)
    low_back, high_back = span(m[8], m[9], m[10], m[11], box)
    low_x, high_x = span(m[0], m[1], m[2], m[3], box)
    low_y, high_y = span(m[4], m[5], m[6], m[7], box)
    low_r, high_r = one / high_w, one / low_w
    low_x, high_x = low_x * (low_r if low_x >= 0 else high_r), high_x * (high_r if high_x >= 0 else low_r)
    low_y, high_y = low_y * (low_r if low_y >= 0 else high_r), high_y * (high_r if high_y >= 0 else low_r)
    far = low_back * (low_r if low_back >= 0 else high_r)
    near = high_back * (high_r if high_back >= 0 else low_r)
    left, right = (low_x + one) * across + half, (high_x + one) * across + half
    top, bottom = (one - high_y) * down + half, (one - low_y) * down + half
    sure = (high_back <= low_w) & (low_w > np.float32(0)) & (far > np.float32(-np.inf))
    sure = sure & (near < np.float32(np.inf)) & (left > -guard) & (right < guard)
    sure = sure & (top > -guard) & (bottom < guard)
    if not sure:
        return False, np.int64(0), np.int64(0), np.int64(0), np.int64(0), np.float32(0), np.float32(0)
    return (
        True,
        np.int64(np.floor(left)),
        np.int64(np.floor(top)),
        np.int64(np.floor(right)),
        np.int64(np.floor(bottom)),
        far,
        near,
    )


@helper
def is_beyond(a, b, c, d, box, size):
    """Whether a x + b y + c z + d < 0 in a whole box, however rounded; size: |a|, |b|, |c|, |d| or more."""
    _, high = span(a, b, c, d, box)
    lx, ly, lz, hx, hy, hz = box
    terms = (
        size[0] * max(abs(lx), abs(hx)) + size[1] * max(abs(ly), abs(hy)) + size[2] * max(abs(lz), abs(hz))
    )
    return high < -SURE * (terms + size[3])


@helper
def row_of(m, k):
    """A row of a matrix, in float64."""
    return np.float64(m[4 * k]), np.float64(m[4 * k + 1]), np.float64(m[4 * k + 2]), np.float64(m[4 * k + 3])


@helper
def combined(p, s, q, t):
    """s p + t q of two rows, and a bound of what they are made of."""
    total = (s * p[0] + t * q[0], s * p[1] + t * q[1], s * p[2] + t * q[2], s * p[3] + t * q[3])
    s, t = abs(s), abs(t)
    size = (
        s * abs(p[0]) + t * abs(q[0]),
        s * abs(p[1]) + t * abs(q[1]),
        s * abs(p[2]) + t * abs(q[2]),
        s * abs(p[3]) + t * abs(q[3]),
    )
    return total, size


@helper
def is_out_of_view(m, width, height, box):
    """Whether nothing in a box can be seen: all is behind the near plane, or on one side of the picture.

    The picture counts as one pixel wider on each side, for samples beside the pixels' centres.
    """
    lx, ly, lz, hx, hy, hz = box
    box = (np.float64(lx), np.float64(ly), np.float64(lz), np.float64(hx), np.float64(hy), np.float64(hz))
    x, y, back, w = row_of(m, 0), row_of(m, 1), row_of(m, 2), row_of(m, 3)
    out = False
    p, size = combined(w, 1.0, back, -1.0)
    out = out | is_beyond(p[0], p[1], p[2], p[3], box, size)
    for sign in (-1.0, 1.0):
        p, size = combined(w, 1.0 + 2.0 / width, x, sign)
        out = out | is_beyond(p[0], p[1], p[2], p[3], box, size)
        p, size = combined(w, 1.0 + 2.0 / height, y, sign)
        out = out | is_beyond(p[0], p[1], p[2], p[3], box, size)
    return out
