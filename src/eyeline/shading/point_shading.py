"""Surface points to colours, a tile at a time: gather, light, tone map.

Everything that is shaded goes through `colours_of`: opaque faces and transparent fragments alike.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.jit import kernel
from eyeline.shading.attributes import gather
from eyeline.shading.encoding import DECODED
from eyeline.shading.environment import add_environment
from eyeline.shading.lanes import ROWS, TILE
from eyeline.shading.reflectance import add_light, prepare
from eyeline.shading.surface_points import SurfacePoints
from eyeline.shading.tone import show

if TYPE_CHECKING:
    from eyeline.shading.frame import Frame


def colours_of(frame: Frame, points: SurfacePoints, *, faceted: bool = False) -> FloatArray:
    """(K, 4) float32: what the screen shows of each point, linear 0..1, alpha last and not multiplied."""
    colours = np.empty((len(points), 4), np.float32)
    lanes = np.empty((ROWS, TILE), np.float32)
    shade_tiles(
        frame.geometry, frame.materials, DECODED, (points.face, points.x, points.y), bool(faceted),
        frame.sight, frame.light_table, frame.lighting.environment,
        2.0**frame.look.exposure, float(frame.look.tone == "neutral"), lanes, colours,
    )  # fmt: skip
    return colours


def attributes_of(frame: Frame, points: SurfacePoints) -> FloatArray:
    """(ROWS, K) float32: what the surface is like at each point, in the rows that `lanes` names; normals unit."""
    lanes = np.empty((ROWS, max(len(points), 1)), np.float32)
    gather(
        frame.geometry, frame.materials, DECODED, (points.face, points.x, points.y), 0, len(points), False, lanes
    )  # fmt: skip
    prepare(lanes, len(points), frame.sight)
    return lanes


@kernel
def shade_tiles(
    geometry, materials, decoded, points, faceted, sight, lights, surroundings, gain, neutral, lanes, colours
):
    """Fill colours (K, 4)."""
    total = points[0].shape[0]
    for begin in range(0, total, lanes.shape[1]):
        end = min(total, begin + lanes.shape[1])
        gather(geometry, materials, decoded, points, begin, end, faceted, lanes)
        prepare(lanes, end - begin, sight)
        add_environment(lanes, end - begin, surroundings)
        for row in range(lights.shape[0]):
            add_light(lanes, end - begin, lights, row)
        show(lanes, end - begin, np.float32(gain), np.float32(neutral), colours, begin)
