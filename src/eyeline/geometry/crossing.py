"""Whether a line goes through a face, with exact signs: no ray slips between faces that share an edge.

The face is moved so that the line becomes the origin of a plane [Woop13]. Then it is inside where all three
cross products of neighbouring corners have one sign; 0, a line through an edge, is inside on either side.
Faces that share two corners see opposite numbers for their edge, bit for bit, because a product does not
depend on the order of its factors; where rounding could have changed a sign, it is found without rounding.
"""

from __future__ import annotations

import numpy as np

from eyeline.jit import helper

# Two products of float64 and their difference are off by less than this part of the products' sizes
DOUBT = 2.0**-51
SPLIT = 2.0**27 + 1  # cuts a float64 into two halves whose products have no rounding [Dekker71]


@helper
def crosses(ax, ay, bx, by, cx, cy):
    """c x b, a x c and b x a of a face's corners around the line, and whether a sign is in doubt."""
    u0, u1, v0, v1, w0, w1 = cx * by, cy * bx, ax * cy, ay * cx, bx * ay, by * ax
    u, v, w = u0 - u1, v0 - v1, w0 - w1
    unsure_u = abs(u) <= DOUBT * (abs(u0) + abs(u1))
    unsure_v = abs(v) <= DOUBT * (abs(v0) + abs(v1))
    return u, v, w, unsure_u | unsure_v | (abs(w) <= DOUBT * (abs(w0) + abs(w1)))


@helper
def exact_crosses(ax, ay, bx, by, cx, cy):
    """c x b, a x c and b x a of a face's corners, with the right signs."""
    return exact_cross(cx, cy, bx, by), exact_cross(ax, ay, cx, cy), exact_cross(bx, by, ax, ay)


@helper
def exact_cross(ax, ay, bx, by):
    """ax by - ay bx with the right sign, and 0 only within a rounding of 0."""
    p, q = ax * by, ay * bx
    return (p - q) + (lost(ax, by, p) - lost(ay, bx, q))


@helper
def lost(a, b, product):
    """What rounding took from a product: a b - product, exactly. [Dekker71]"""
    far, near = a * SPLIT, b * SPLIT
    a_high, b_high = far - (far - a), near - (near - b)
    a_low, b_low = a - a_high, b - b_high
    return ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low


@helper
def side_shown(u, v, w):
    """1 where corners turn clockwise around the line (x right, y down), -1 where counter-clockwise.

    u, v, w: of `crosses`; 0 where the line passes the face, or runs along it.
    """
    low, high = min(u, min(v, w)), max(u, max(v, w))
    return np.int32((high <= 0.0) & (low < 0.0)) - np.int32((low >= 0.0) & (high > 0.0))
