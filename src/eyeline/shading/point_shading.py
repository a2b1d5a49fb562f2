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
from eyeline.shading.lanes import OCCLUSION, ROWS, TILE, X, Y, Z
from eyeline.shading.openness import open_at
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
    lanes = np.empty((ROWS, TILE), np.float32)
    shade_tiles(
        frame.geometry, frame.materials, DECODED, (points.face, points.x, points.y), bool(faceted),
        stage,
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
def shade_tiles(geometry, materials, decoded, points, faceted, stage, gain, neutral, lanes, colours):
    """Fill colours (K, 4)."""
    total = points[0].shape[0]
    for begin in range(0, total, lanes.shape[1]):
        end = min(total, begin + lanes.shape[1])
        gather(geometry, materials, decoded, points, begin, end, faceted, lanes)
        prepare(lanes, end - begin, stage.sight)
        close_in(lanes, stage.openness, stage.gaze, points, begin, end)
        add_environment(lanes, end - begin, stage.environment)
        for light in range(stage.lights.shape[0]):
            arrive(lanes, end - begin, stage.shadows, stage.lights, light)
            add_light(lanes, end - begin, stage.lights, light)
        show(lanes, end - begin, np.float32(gain), np.float32(neutral), colours, begin)


@kernel
def close_in(lanes, openness, gaze, points, begin, end):
    """Multiply OCCLUSION by how open the surroundings on the screen are."""
    _, xs, ys = points
    for point in range(begin, end):
        i = point - begin
        distance = lanes[X, i] * gaze[0] + lanes[Y, i] * gaze[1] + lanes[Z, i] * gaze[2]
        lanes[OCCLUSION, i] *= open_at(
            openness.width, openness.open, openness.distance, openness.alike, xs[point], ys[point], distance
        )
