"""The backdrop where the studio floor lies in shadow: darker, and nothing else."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from eyeline.geometry.arrays import ByteArray
from eyeline.jit import kernel
from eyeline.shading.encoding import DECODED, DITHER, ENCODED, encoded
from eyeline.shading.lanes import GX, GY, GZ, LIT, NX, NY, NZ, OPEN, ROWS, TILE, X, Y, Z
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
    lanes = np.empty((ROWS, TILE), np.float32)
    shade_floor(
        shaded, strip.of_sample, strip.top, (region.left, top, region.right, bottom),
        floor.place, floor.below_eye, stage, lanes, (ENCODED, DECODED, DITHER),
    )  # fmt: skip
    return shaded


@kernel
def shade_floor(shaded, of_sample, strip_top, region, place, below_eye, stage, lanes, tables):
    """Darken shaded (rows, W, 4), which holds the backdrop, where the floor is; a tile of a row at a time."""
    table, decoded, dither = tables
    left, top, right, bottom = region
    width = shaded.shape[1]
    for row in range(top, bottom):
        for begin in range(left, right, lanes.shape[1]):
            count = min(right - begin, lanes.shape[1])
            place_floor(lanes, count, begin, row, place, below_eye)
            for i in range(count):
                p = (row - strip_top) * width + begin + i
                bare = False
                for s in range(of_sample.shape[0]):
                    bare = bare or of_sample[s, p] < 0
                # What is covered, or above the horizon, has no side that a light could reach
                if not bare:
                    lanes[NY, i] = ZERO
            arrive(lanes, count, stage.shadows, stage.lights, 0)
            look_up(lanes, count, stage.openness)
            for i in range(count):
                light = KEY_PART * lanes[LIT, i] + (ONE - KEY_PART) * lanes[OPEN, i]
                if light < ONE and lanes[NY, i] > ZERO:
                    threshold = dither[(row & 7) * 8 + ((begin + i) & 7)]
                    y, x = row - strip_top, begin + i
                    for k in range(3):
                        shaded[y, x, k] = encoded(decoded[shaded[y, x, k]] * light, threshold, table)


@kernel
def place_floor(lanes, count, begin, row, place, below_eye):
    """Fill the lanes with where the rays of a row's pixels meet the floor, and its normal; (0, 0, 0) where not."""
    down = row + 0.5
    for i in range(count):
        across = begin + i + 0.5
        w = place[2, 0] * across + place[2, 1] * down + place[2, 2]
        met = ONE if w > 0 else ZERO
        per_w = 1.0 / w if w > 0 else 0.0
        lanes[X, i] = (place[0, 0] * across + place[0, 1] * down + place[0, 2]) * per_w
        lanes[Y, i] = below_eye * met
        lanes[Z, i] = (place[1, 0] * across + place[1, 1] * down + place[1, 2]) * per_w
        lanes[NX, i], lanes[NY, i], lanes[NZ, i] = ZERO, met, ZERO
        lanes[GX, i], lanes[GY, i], lanes[GZ, i] = ZERO, ONE, ZERO
