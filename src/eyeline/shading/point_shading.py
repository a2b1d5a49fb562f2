"""Surface points to colours, a tile at a time: gather, light, tone map.

Everything that is shaded goes through `colours_of`: opaque faces and transparent fragments alike.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.shading.attributes import gather
from eyeline.shading.encoding import DECODED
from eyeline.shading.environment import add_environment
from eyeline.shading.lanes import ROWS, SPARE, TILE
from eyeline.shading.openness import look_up
from eyeline.shading.reflectance import add_light, prepare
from eyeline.shading.shadow import GROUP, arrive
from eyeline.shading.surface_points import SurfacePoints
from eyeline.shading.texturing import lay_textures
from eyeline.shading.tone import show

if TYPE_CHECKING:
    from eyeline.shading.frame import Frame
    from eyeline.shading.stage import Stage


def colours_of(frame: Frame, stage: Stage, points: SurfacePoints, faceted: bool = False) -> FloatArray:
    """(K, 4) float32: what the screen shows of each point, linear 0..1, alpha last and not multiplied.

    stage: `stage_of(frame)`. faceted: each face by its own normal.
    """
    count = len(points)
    colours = np.empty((count, 4), np.float32)
    lanes, painted = np.empty((ROWS, TILE + SPARE), np.float32), np.full(TILE, -1)
    where = points.face, points.x, points.y
    gain, neutral = np.float32(2.0**frame.look.exposure), np.float32(frame.look.tone == "neutral")
    begin = 0
    while begin < count:
        end = tile_end(points, begin)
        size = end - begin
        gather(frame.geometry, frame.materials, where, begin, end, faceted, lanes, painted)
        if frame.textured:
            lay_textures(frame.geometry, frame.materials, DECODED, where, begin, end, lanes)
        prepare(lanes, size, stage.sight)
        look_up(lanes, size, stage.openness)
        add_environment(lanes, size, stage.environment)
        for light in range(len(stage.lights)):
            arrive(lanes, size, stage.shadows, stage.lights, light)
            add_light(lanes, size, stage.lights, light)
        show(lanes, size, gain, neutral, colours, begin)
        begin = end
    return colours


def tile_end(points: SurfacePoints, begin: int) -> int:
    """Where the tile ends that begins at a point: between groups of columns, so that no strip shows."""
    end = min(len(points), begin + TILE)
    if end < len(points):
        groups = points.x[begin : end + 1].astype(np.int64) // GROUP
        changes = np.flatnonzero(groups[1:] != groups[:-1])
        end = begin + 1 + int(changes[-1]) if len(changes) else end
    return end
