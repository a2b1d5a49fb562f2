"""Everything that lights a frame, found once before its strips are drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.shading.light_table import light_table
from eyeline.shading.openness import MOST_PIXELS, REACH_PART, Openness, openness_of
from eyeline.shading.region import Region, on_floor, region_of
from eyeline.shading.shadow_map import BLOCK, ShadowMaps, shadow_maps
from eyeline.shading.studio import lighting_of

if TYPE_CHECKING:
    from eyeline.shading.frame import Frame

MOST_MAPS = 12  # of all lights that cast shadows; a light all around takes six
LEAST_TEXELS, MOST_TEXELS = 256, 1024
EDGE = 8  # pixels around what can darken the floor, for the softness of its outline


class Stage(NamedTuple):
    """Lights, shadows and surroundings, for kernels."""

    lights: FloatArray  # (L, 14)
    environment: FloatArray  # (12,)
    shadows: ShadowMaps
    openness: Openness
    sight: FloatArray  # (4,) see `prepare`
    region: Region  # where the floor can be darker


def stage_of(frame: Frame) -> Stage:
    """The stage of a frame; uses all threads, so call it before the strips are drawn."""
    camera = frame.projected.camera
    eye = camera.world_from_eye[:3, 3]
    lighting = lighting_of(frame.scene, camera)
    # Of the rig only the key casts a shadow; of the scene's own lights as many as there are maps for
    casting = lighting.lights[: 1 if lighting.studio else None] if frame.look.shadows else ()
    # The studio is soft: half as fine as the picture is fine enough
    fineness = min(frame.size) / (2 if lighting.studio else 1)
    texels = min(max(round(fineness / BLOCK) * BLOCK, LEAST_TEXELS), MOST_TEXELS)
    shadows = shadow_maps(frame.scene, casting, len(lighting.lights), eye, texels, MOST_MAPS)
    bounds = frame.scene.bounds
    diagonal = bounds.diagonal or 1.0
    to_light = casting[0].world_from_light[:3, 2] if casting and lighting.studio else None
    corners = bounds.corners if not bounds.is_empty else np.zeros((0, 3))
    near = region_of(corners, frame.projected, 2 * MOST_PIXELS)
    openness = openness_of(frame.visibles[0][0], frame.floor, near, diagonal, frame.look.occlusion)
    floor = region_of(on_floor(bounds, to_light, REACH_PART * diagonal), frame.projected, EDGE)
    return Stage(
        light_table(lighting.lights, eye), lighting.environment, shadows, openness, frame.sight, floor
    )  # fmt: skip
