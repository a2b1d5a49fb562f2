"""The picture's grid of 1/256 pixel: exact edges, who owns a pixel, and the one formula for depth.

Snapped coordinates are whole numbers, x right, y down; pixel p is centred at 256 p + 128. Every decision
about coverage is the sign of a whole number below 2**53, so it is the same in int64 and in float64, on every
machine. Whoever fills faces uses these functions: two methods that see the same face then see the same depth,
bit for bit.
"""

from __future__ import annotations

import numpy as np

from eyeline.jit import helper

UNITS = 256  # in a pixel
CENTRE = 128  # of a pixel, from its left or upper border
BEFORE_CENTRE = UNITS - CENTRE - 1  # (x + BEFORE_CENTRE) >> 8 is the first pixel centred at x or after it
GUARD = 1 << 23  # coordinates stay within -GUARD..GUARD, so that edge functions stay below 2**50
LARGEST_SIDE = 16384  # pixels of a picture: half of the guard band
SLOPING, ROUNDING = 2.0**-23, 2.0**-48  # how far rounding can carry `depth_at`; see `greatest_depth`


@helper
def signed_area(x0, y0, x1, y1, x2, y2):
    """Twice the area in square units: positive where the corners turn clockwise on the screen, y down."""
    return (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)


@helper
def edge_bias(a, b):
    """0 for a top or left edge, -1 for another: a pixel is inside where all a x + b y + c + bias >= 0.

    (a, b) = (y0 - y1, x1 - x0) of an edge that leads clockwise around its face. A centre on an edge of two
    faces is owned by the one to whose left or top the edge is.
    """
    return np.int32((a > 0) | ((a == 0) & (b > 0))) - np.int32(1)


@helper
def depth_plane(x0, y0, z0, x1, y1, z1, x2, y2, z2):
    """(a, b, c) of the plane through three snapped corners that turn clockwise, for `depth_at`.

    It starts from the topmost corner, of those the leftmost: a face has one plane, wherever its corners
    begin.
    """
    second = (y1 < y0) | ((y1 == y0) & (x1 < x0))
    x, y, z = (x1 if second else x0), (y1 if second else y0), (z1 if second else z0)
    third = (y2 < y) | ((y2 == y) & (x2 < x))
    x, y, z = (x2 if third else x), (y2 if third else y), (z2 if third else z)
    second = second & (not third)
    ux = np.float64(np.int32((x0 if third else (x2 if second else x1)) - x))
    uy = np.float64(np.int32((y0 if third else (y2 if second else y1)) - y))
    uz = np.float64(z0 if third else (z2 if second else z1)) - np.float64(z)
    vx = np.float64(np.int32((x1 if third else (x0 if second else x2)) - x))
    vy = np.float64(np.int32((y1 if third else (y0 if second else y2)) - y))
    vz = np.float64(z1 if third else (z0 if second else z2)) - np.float64(z)
    scale = 256.0 / (ux * vy - vx * uy)
    a, b = (uz * vy - vz * uy) * scale, (vz * ux - uz * vx) * scale
    column, row = np.float64(np.int32(x - CENTRE)) / 256.0, np.float64(np.int32(y - CENTRE)) / 256.0
    return a, b, np.float64(z) - a * column - b * row


@helper
def depth_at(a, b, c, x, y):
    """The depth of a plane at the centre of pixel (x, y), in this order of operations and no other."""
    return np.float32((c + b * np.float64(y)) + a * np.float64(x))


@helper
def greatest_depth(farthest, nearest, across, down):
    """The most that `depth_at` can give at a covered centre of any face with corners in a box.

    farthest, nearest: float32 depths of the box; across, down: its sides, 1/256 pixel.

    A covered centre lies between the corners, and so does its exact depth; what is computed is that, and the
    rounding of at most 16 operations, each by 2**-53 of its terms. Those are the depth itself, and a and b
    times a column or row: 2**16 pixels at most, with |a| <= (nearest - farthest) 2 down 256 / area, |b| the
    same with across, and a whole area, so that it is 1 at least. The product is 2**-24 (nearest - farthest)
    (across + down); it is doubled here. On a box of one depth a and b are 0, and the bound is that depth.
    """
    high = np.float64(nearest)
    slope = (high - np.float64(farthest)) * np.float64(across + down)
    return np.float32(high + slope * SLOPING + abs(high) * ROUNDING)
