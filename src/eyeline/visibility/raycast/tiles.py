"""A tile of pixels: which of them may see a box, and what their rays have hit so far."""

from __future__ import annotations

import numpy as np

from eyeline.jit import helper
from eyeline.projection.projected import CLOCKWISE, COUNTER_CLOCKWISE

TILE = 32  # pixels of a tile's side; ranges of pixels are packed into bytes
ACROSS, DOWN = 4, 2  # a block is 4x2 rays
ROOM_ACROSS, ROOM_DOWN = TILE + ACROSS - 1, TILE + DOWN - 1  # a tile, and what blocks hang over its border
ROOM = ROOM_ACROSS * ROOM_DOWN
ROUNDING = 2.0**-21  # eight roundings of float32, as a part of what is summed
SLACK = np.float32(2.0**-13)  # pixels: more than a quotient within a tile is rounded by

ZERO, ONE, INFINITE = np.float32(0), np.float32(1), np.float32(np.inf)


@helper
def first_pixel(low):
    """The first pixel of a tile whose centre is at `low` pixels from the tile's middle, or after it."""
    place = low + np.float32(TILE / 2 + 0.5) - SLACK
    return np.int32(min(max(place, ZERO), np.float32(TILE)))


@helper
def last_pixel(high):
    """The last pixel of a tile whose centre is before `high` pixels from the tile's middle, or -1."""
    place = high + np.float32(TILE / 2 + 0.5) + SLACK
    return np.int32(min(max(place, ZERO), np.float32(TILE))) - np.int32(1)


@helper
def pixels_between(low, high, per_near, per_far, first, last):
    """Which pixels of first .. last may see something between low and high, both yet to be divided by w."""
    begin = first_pixel(low * (per_far if low > ZERO else per_near))
    end = last_pixel(high * (per_near if high > ZERO else per_far))
    return max(begin, first), min(end, last)


@helper
def counts_for(side, sides):
    """Whether the side of a face that a ray meets is one of those that count."""
    return ((side > 0) & (sides & CLOCKWISE != 0)) | ((side < 0) & (sides & COUNTER_CLOCKWISE != 0))


@helper
def take_tile(x_begin, y_begin, columns, rows, distance, face, own_distance, own_face):
    """Copy what a tile's rays have hit so far; what blocks hang over its border has hit nothing."""
    for i in range(ROOM):
        own_distance[i], own_face[i] = INFINITE, -1
    for y in range(rows):
        for x in range(columns):
            at = np.uint64(y * ROOM_ACROSS + x)
            own_distance[at] = distance[np.uint64(y_begin + y), np.uint64(x_begin + x)]
            own_face[at] = face[np.uint64(y_begin + y), np.uint64(x_begin + x)]


@helper
def aim(tree, view, w0, w1, middle_x, middle_y, row, size, pad):
    """Fill the rows of the view from a tile's middle, in float32 for boxes, and what that rounds at most."""
    for r in range(3):
        shift = middle_x if r == 0 else (middle_y if r == 1 else 0.0)
        total = 0.0
        for k in range(4):
            number = view[4 * r + k] - shift * (w1 * view[8 + k] + (w0 if k == 3 else 0.0))
            row[4 * r + k], size[4 * r + k] = number, abs(number)
            total += abs(number) * (max(abs(tree.low[k]), abs(tree.high[k])) if k < 3 else 1.0)
        pad[r] = total * ROUNDING
