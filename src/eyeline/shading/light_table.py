"""Lights as rows of numbers for kernels, seen from the eye. [KHR_lights_punctual]"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.scene.light import Light

# Columns
AXIS = 0  # (3,) against the way a spot shines; unit
AT = 3  # (3,) its place from the eye; of a directional light the unit direction to it
NEARNESS = 6  # 1 has a place, 0 has only a direction
COLOR = 7  # (3,) lux or candela
RANGE = 10  # 1 over the squared range; 0 has none
CONE_SCALE, CONE_OFFSET = 11, 12
WIDTH = 13  # what its size adds to the width of its reflection
COLUMNS = 14


@dataclass(frozen=True, eq=False)
class PlacedLight:
    """A light where it stands, and how large it is."""

    light: Light
    world_from_light: FloatArray  # (4, 4) rigid; it shines along -z
    size: float = 0.0  # radius over distance: 0 is a point


def light_row(placed: PlacedLight, eye: FloatArray) -> list[float]:
    """The row of one light; eye (3,): where the camera stands."""
    light, matrix = placed.light, placed.world_from_light
    back = matrix[:3, 2]
    directional = light.kind == "directional"
    at = back if directional else matrix[:3, 3] - eye
    scale, offset = 0.0, 1.0
    if light.kind == "spot":
        outer, inner = math.cos(light.outer_cone), math.cos(light.inner_cone)
        scale = 1 / max(1e-3, inner - outer)
        offset = -outer * scale
    return [
        *back, *at, 0.0 if directional else 1.0, *(part * light.intensity for part in light.color),
        0.0 if math.isinf(light.range) else 1 / light.range**2, scale, offset, placed.size,
    ]  # fmt: skip


def light_table(lights: Sequence[PlacedLight], eye: FloatArray) -> FloatArray:
    """(L, 14) float32."""
    return np.array([light_row(one, eye) for one in lights], np.float32).reshape(-1, COLUMNS)
