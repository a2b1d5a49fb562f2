"""The backdrop where the studio floor lies in shadow: darker, and nothing else."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from eyeline.geometry.arrays import ByteArray
from eyeline.jit import kernel
from eyeline.shading.encoding import DECODED, DITHER, ENCODED, encoded
from eyeline.shading.openness import open_at
from eyeline.shading.shadow import arriving

if TYPE_CHECKING:
    from eyeline.shading.frame import Strip
    from eyeline.shading.stage import Stage

KEY_PART = np.float32(0.40)  # of the floor's light comes from the key; the rest from all around
ZERO, ONE = np.float32(0), np.float32(1)


def shaded_backdrop(strip: Strip, stage: Stage) -> ByteArray:
    """(rows, W, 4) the backdrop with the floor's shadows on it."""
    backdrop = strip.backdrop
    floor = strip.frame.floor
    if floor is None:
        return backdrop
    shaded = np.empty_like(backdrop)
    shade_floor(
        backdrop.reshape(-1, 4), shaded.reshape(-1, 4), strip.of_sample, strip.top, backdrop.shape[1],
        floor.place, floor.distances, floor.below_eye, stage.shadows, stage.openness,
        float(strip.frame.projected.camera.fov is not None), (ENCODED, DECODED, DITHER),
    )  # fmt: skip
    return shaded


@kernel
def shade_floor(
    backdrop,
    shaded,
    of_sample,
    top,
    width,
    place,
    distances,
    below_eye,
    shadows,
    openness,
    perspective,
    tables,
):
    """Fill shaded with the backdrop, darkened where the floor is."""
    table, decoded, dither = tables
    samples = of_sample.shape[0]
    for p in range(backdrop.shape[0]):
        for k in range(4):
            shaded[p, k] = backdrop[p, k]
        bare = False
        for s in range(samples):
            bare = bare or of_sample[s, p] < 0
        column, row = p % width + 0.5, top + p // width + 0.5
        w = place[2, 0] * column + place[2, 1] * row + place[2, 2]
        if not bare or w <= 0:
            continue
        x = (place[0, 0] * column + place[0, 1] * row + place[0, 2]) / w
        z = (place[1, 0] * column + place[1, 1] * row + place[1, 2]) / w
        lit = ONE
        if shadows.rows.shape[0] > 0:
            lit = arriving(
                shadows.rows,
                shadows.depth,
                shadows.blocks,
                shadows.size,
                0,
                (x, below_eye, z),
                (0.0, 1.0, 0.0),
            )
        distance = distances[0] * column + distances[1] * row + distances[2]
        if perspective > 0:
            distance = 1.0 / distance
        around = open_at(
            openness.width, openness.open, openness.distance, openness.alike,
            np.float32(column), np.float32(row), np.float32(distance),
        )  # fmt: skip
        light = KEY_PART * lit + (ONE - KEY_PART) * around
        if light < ONE:
            threshold = dither[((top + p // width) & 7) * 8 + ((p % width) & 7)]
            for k in range(3):
                shaded[p, k] = encoded(decoded[backdrop[p, k]] * light, threshold, table)
