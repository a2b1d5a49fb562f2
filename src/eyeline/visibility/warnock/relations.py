"""How a face lies to an area of pixels, and when a face that surrounds the area surely hides another there.

Relations are decided on the centres of the area's pixels, in whole numbers. Depths are compared at its four
corner pixels: planes whose order is the same at all four keep it between them. What rounding may do to that
is bounded here, so that a face is only hidden where no pixel could see it.
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.fixedpoint import CENTRE, GUARD, UNITS, edge_bias
from eyeline.jit import helper

DISJOINT, INTERSECTING, CONTAINED, SURROUNDING = range(4)
WORDS = 8  # int64 of a record, a cache line: three corners, the plane's a b c, the scene face, one unused
REACH = GUARD / UNITS  # pixels: no corner and no pixel lies farther out
# Four roundings of float64, at a corner and at a pixel, come to less than 2**-50 of all that is summed
ROUNDING = 2.0**-49
# Depths farther apart than this part of the greater one are different in float32
SINGLE, LEAST_SINGLE = 2.0**-22, 2.0**-148


@helper
def lies(words, r, first_x, first_y, last_x, last_y, left, top, right, bottom, x, y):
    """How a face lies to the pixels left..right, top..bottom of a tile whose first pixel is (x, y).

    first_x, first_y, last_x, last_y: the box of pixels of the face, in the tile as well; a box within the
    area needs no edges, unless it is the area.
    """
    if (first_x > right) | (last_x < left) | (first_y > bottom) | (last_y < top):
        return DISJOINT
    contained = (first_x >= left) & (last_x <= right) & (first_y >= top) & (last_y <= bottom)
    if contained & ((first_x > left) | (last_x < right) | (first_y > top) | (last_y < bottom)):
        return CONTAINED
    how = relation(
        words[WORDS * r], words[WORDS * r + 1], words[WORDS * r + 2],
        (x + left) * UNITS + CENTRE, (y + top) * UNITS + CENTRE, (right - left) * UNITS,
        (bottom - top) * UNITS,
    )  # fmt: skip
    return CONTAINED if contained & (how != SURROUNDING) else how


@helper
def relation(p0, p1, p2, x, y, across, down):
    """DISJOINT, INTERSECTING or SURROUNDING, of a face to the centres from (x, y) to (x + across, y + down).

    p0, p1, p2: corners y << 32 | x that turn clockwise. All centres inside all edges, with the rule for
    centres on an edge: surrounding. All outside one edge: disjoint.
    """
    low0, high0 = edge_range(p1, p2, x, y, across, down)
    low1, high1 = edge_range(p2, p0, x, y, across, down)
    low2, high2 = edge_range(p0, p1, x, y, across, down)
    if (high0 < 0) | (high1 < 0) | (high2 < 0):
        return DISJOINT
    return SURROUNDING if (low0 >= 0) & (low1 >= 0) & (low2 >= 0) else INTERSECTING


@helper
def edge_range(p, q, x, y, across, down):
    """The least and the greatest value of an edge function on a rectangle of centres; inside is 0 or more."""
    px, py = np.int64(np.int32(p)), p >> 32
    a, b = py - (q >> 32), np.int64(np.int32(q)) - px
    value = a * (x - px) + b * (y - py) + edge_bias(a, b)
    over, under = a * across, b * down
    return value + min(over, 0) + min(under, 0), value + max(over, 0) + max(under, 0)


@helper
def height_at(a, b, c, x, y):
    """The depth of a plane in float64, in the order of `depth_at`, which rounds it to float32."""
    return (c + b * np.float64(y)) + a * np.float64(x)


@helper
def slack_of(a, b, c):
    """More than rounding moves a plane's heights, at a corner and at a pixel together."""
    return ROUNDING * (abs(c) + (abs(a) + abs(b)) * REACH)


@helper
def plane_of(words, r):
    """(a, b, c) of a record."""
    at = WORDS * r
    return (
        np.int64(words[at + 3]).view(np.float64), np.int64(words[at + 4]).view(np.float64),
        np.int64(words[at + 5]).view(np.float64),
    )  # fmt: skip


@helper
def farthest(words, r, left, top, right, bottom):
    """A float32 that no depth of a surrounding face is below, on the pixels left..right, top..bottom."""
    a, b, c = plane_of(words, r)
    least = min(
        height_at(a, b, c, left, top), height_at(a, b, c, right, top),
        height_at(a, b, c, left, bottom), height_at(a, b, c, right, bottom),
    )  # fmt: skip
    return np.float32(least - slack_of(a, b, c))


@helper
def hides(words, s, r, left, top, right, bottom):
    """Whether plane s is surely seen before plane r on all pixels left..right, top..bottom."""
    a, b, c = plane_of(words, s)
    d, e, f = plane_of(words, r)
    first = words[WORDS * s + 6] < words[WORDS * r + 6]  # wins a tie
    if (a == d) & (b == e) & (c == f):
        return first
    s0, s1 = height_at(a, b, c, left, top), height_at(a, b, c, right, top)
    s2, s3 = height_at(a, b, c, left, bottom), height_at(a, b, c, right, bottom)
    r0, r1 = height_at(d, e, f, left, top), height_at(d, e, f, right, top)
    r2, r3 = height_at(d, e, f, left, bottom), height_at(d, e, f, right, bottom)
    gap = min(s0 - r0, s1 - r1, s2 - r2, s3 - r3)
    doubt = slack_of(a, b, c) + slack_of(d, e, f)
    if not first:
        most = max(abs(s0), abs(s1), abs(s2), abs(s3), abs(r0), abs(r1), abs(r2), abs(r3))
        doubt += SINGLE * most + LEAST_SINGLE
    return gap > doubt
