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
from eyeline.shading.openness import look_up
from eyeline.shading.reflectance import add_light, prepare
from eyeline.shading.shadow import arrive
from eyeline.shading.surface_points import SurfacePoints
from eyeline.shading.tone import show

if TYPE_CHECKING:
    from eyeline.shading.frame import Frame
    from eyeline.shading.stage import Stage


def colours_of(frame: Frame, stage: Stage, points: SurfacePoints, faceted: bool = False) -> FloatArray:
    """(K, 4) float32: what the screen shows of each point, linear 0..1, alpha last and not multiplied.

    stage: `stage_of(frame)`. faceted: each face by its own normal.
    """
    colours = np.empty((len(points), 4), np.float32)
    lanes, painted = np.empty((ROWS, TILE), np.float32), np.full(TILE, -1)
    shade_tiles(
        frame.geometry, frame.materials, DECODED, (points.face, points.x, points.y), bool(faceted), stage,
        2.0**frame.look.exposure, float(frame.look.tone == "neutral"), lanes, painted, colours,
    )  # fmt: skip
    return colours


@kernel
def shade_tiles(geometry, materials, decoded, points, faceted, stage, gain, neutral, lanes, painted, colours):
    """Fill colours (K, 4)."""
    total = points[0].shape[0]
    for begin in range(0, total, lanes.shape[1]):
        end = min(total, begin + lanes.shape[1])
        gather(geometry, materials, decoded, points, begin, end, faceted, lanes, painted)
        prepare(lanes, end - begin, stage.sight)
        look_up(lanes, end - begin, stage.openness)
        add_environment(lanes, end - begin, stage.environment)
        for light in range(stage.lights.shape[0]):
            arrive(lanes, end - begin, stage.shadows, stage.lights, light)
            add_light(lanes, end - begin, stage.lights, light)
        show(lanes, end - begin, np.float32(gain), np.float32(neutral), colours, begin)
