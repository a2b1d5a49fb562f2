"""The backdrop where the studio floor lies in shadow: darker, and nothing else."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from eyeline.geometry.arrays import ByteArray, FloatArray, IntArray
from eyeline.jit import kernel
from eyeline.shading.encoding import DECODED, DITHER, ENCODED, encoded
from eyeline.shading.lanes import COLUMN, GX, GY, GZ, LIT, NX, NY, NZ, OPEN, ROWS, SPARE, TILE, X, Y, Z
from eyeline.shading.openness import look_up
from eyeline.shading.region import Region
from eyeline.shading.shadow import arrive

if TYPE_CHECKING:
    from eyeline.shading.frame import Strip
    from eyeline.shading.stage import Stage

Light = Callable[[FloatArray, IntArray], None]

KEY_PART = np.float32(0.40)  # of the floor's light comes from the key; the rest from all around
ZERO, ONE = np.float32(0), np.float32(1)


def shaded_backdrop(strip: Strip, stage: Stage) -> ByteArray:
    """(rows, W, 4) the backdrop with the floor's shadows on it, by maps."""

    def light(lanes: FloatArray, pixel: IntArray) -> None:
        arrive(lanes, len(pixel), stage.shadows, stage.lights, 0)
        look_up(lanes, len(pixel), stage.openness)

    return darkened_backdrop(strip, stage.region, light)


def darkened_backdrop(strip: Strip, region: Region, light: Light) -> ByteArray:
    """(rows, W, 4) the backdrop, darker where `light` says that less arrives on the floor in a region.

    light(lanes, pixel) fills LIT and OPEN of the places on the floor that pixels (K,) of the picture show.
    """
    floor = strip.frame.floor
    top, bottom = max(strip.top, region.top), min(strip.bottom, region.bottom)
    if floor is None or top >= bottom or region.width == 0:
        return strip.backdrop
    shaded = strip.backdrop.copy()
    lanes, pixels = np.empty((ROWS, TILE + SPARE), np.float32), np.empty(TILE, np.int64)
    rows = max(1, TILE // region.width)
    for first in range(top, bottom, rows):
        last = min(bottom, first + rows)
        for left in range(region.left, region.right, TILE):
            window = left, first, min(region.right, left + TILE), last
            count = place_floor(
                lanes,
                pixels,
                window,
                floor.place,
                floor.below_eye,
                strip.of_sample,
                strip.top,
                shaded.shape[1],
            )
            light(lanes, pixels[:count] + strip.first_pixel)
            darken(shaded, lanes, pixels, count, strip.top, (ENCODED, DECODED, DITHER))
    return shaded


@kernel
def place_floor(lanes, pixels, window, place, below_eye, of_sample, strip_top, width):
    """Fill pixels with those of a window that show the floor, and the lanes with where; how many."""
    left, top, right, bottom = window
    count = 0
    for row in range(top, bottom):
        down = row + 0.5
        start = (row - strip_top) * width
        for column in range(left, right):
            across = column + 0.5
            w = place[2, 0] * across + place[2, 1] * down + place[2, 2]
            bare = False
            for s in range(of_sample.shape[0]):
                bare = bare or of_sample[s, start + column] < 0
            if not bare or w <= 0:
                continue
            per_w = 1.0 / w
            pixels[count] = start + column
            lanes[X, count] = (place[0, 0] * across + place[0, 1] * down + place[0, 2]) * per_w
            lanes[COLUMN, count] = column
            lanes[Y, count] = below_eye
            lanes[Z, count] = (place[1, 0] * across + place[1, 1] * down + place[1, 2]) * per_w
            lanes[NX, count], lanes[NY, count], lanes[NZ, count] = ZERO, ONE, ZERO
            lanes[GX, count], lanes[GY, count], lanes[GZ, count] = ZERO, ONE, ZERO
            count += 1
    return count


@kernel
def darken(shaded, lanes, pixels, count, strip_top, tables):
    """Darken pixels of shaded (rows, W, 4), which holds the backdrop, where the floor lies in shadow."""
    table, decoded, dither = tables
    width = shaded.shape[1]
    for i in range(count):
        light = KEY_PART * lanes[LIT, i] + (ONE - KEY_PART) * lanes[OPEN, i]
        if light < ONE:
            row, column = pixels[i] // width, pixels[i] % width
            threshold = dither[((strip_top + row) & 7) * 8 + (column & 7)]
            for k in range(3):
                shaded[row, column, k] = encoded(decoded[shaded[row, column, k]] * light, threshold, table)
