"""The backdrop where the studio floor lies in shadow: darker, and nothing else."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from eyeline.geometry.arrays import ByteArray
from eyeline.jit import kernel
from eyeline.shading.encoding import DECODED, DITHER, ENCODED, encoded
from eyeline.shading.lanes import GX, GY, GZ, LIT, NX, NY, NZ, OPEN, ROWS, SPARE, TILE, X, Y, Z
from eyeline.shading.openness import look_up
from eyeline.shading.shadow import arrive

if TYPE_CHECKING:
    from eyeline.shading.frame import Strip
    from eyeline.shading.stage import Stage

KEY_PART = np.float32(0.40)  # of the floor's light comes from the key; the rest from all around
ZERO, ONE = np.float32(0), np.float32(1)


def shaded_backdrop(strip: Strip, stage: Stage) -> ByteArray:
    """(rows, W, 4) the backdrop with the floor's shadows on it."""
    floor, region = strip.frame.floor, stage.region
    top, bottom = max(strip.top, region.top), min(strip.bottom, region.bottom)
    if floor is None or top >= bottom or region.width == 0:
        return strip.backdrop
    shaded = strip.backdrop.copy()
    lanes = np.empty((ROWS, TILE + SPARE), np.float32)
    rows = max(1, TILE // region.width)
    for first in range(top, bottom, rows):
        last = min(bottom, first + rows)
        for left in range(region.left, region.right, TILE):
            window = left, first, min(region.right, left + TILE), last
            count = (window[2] - left) * (last - first)
            place_floor(
                lanes, window, floor.place, floor.below_eye, strip.of_sample, strip.top, shaded.shape[1]
            )
            arrive(lanes, count, stage.shadows, stage.lights, 0)
            look_up(lanes, count, stage.openness)
            darken(shaded, lanes, window, strip.top, (ENCODED, DECODED, DITHER))
    return shaded


@kernel
def darken(shaded, lanes, window, strip_top, tables):
    """Darken a window of shaded (rows, W, 4), which holds the backdrop, where the floor is."""
    table, decoded, dither = tables
    left, top, right, bottom = window
    i = -1
    for row in range(top, bottom):
        for column in range(left, right):
            i += 1
            light = KEY_PART * lanes[LIT, i] + (ONE - KEY_PART) * lanes[OPEN, i]
            if light < ONE and lanes[NY, i] > ZERO:
                threshold = dither[(row & 7) * 8 + (column & 7)]
                y = row - strip_top
                for k in range(3):
                    shaded[y, column, k] = encoded(decoded[shaded[y, column, k]] * light, threshold, table)


@kernel
def place_floor(lanes, window, place, below_eye, of_sample, strip_top, width):
    """Fill the lanes with where a window's pixels meet the floor, and its normal: (0, 0, 0) where not.

    What is covered has no normal either: no light is asked for.
    """
    left, top, right, bottom = window
    i = -1
    for row in range(top, bottom):
        down = row + 0.5
        start = (row - strip_top) * width
        for column in range(left, right):
            i += 1
            across = column + 0.5
            w = place[2, 0] * across + place[2, 1] * down + place[2, 2]
            bare = False
            for s in range(of_sample.shape[0]):
                bare = bare or of_sample[s, start + column] < 0
            met = ONE if w > 0 and bare else ZERO
            per_w = 1.0 / w if w > 0 else 0.0
            lanes[X, i] = (place[0, 0] * across + place[0, 1] * down + place[0, 2]) * per_w
            lanes[Y, i] = below_eye * met
            lanes[Z, i] = (place[1, 0] * across + place[1, 1] * down + place[1, 2]) * per_w
            lanes[NX, i], lanes[NY, i], lanes[NZ, i] = ZERO, met, ZERO
            lanes[GX, i], lanes[GY, i], lanes[GZ, i] = ZERO, ONE, ZERO
