"""What stands behind everything: a studio gradient, one colour, or nothing."""

from __future__ import annotations

from functools import lru_cache
from typing import Literal

import numpy as np

from eyeline.geometry.arrays import ByteArray, IntArray
from eyeline.scene.material import Colour
from eyeline.shading.encoding import DITHER, srgb_from_linear

# Slightly cool light greys, linear: in the middle, where the product stands, and in the corners.
MIDDLE = 0.86 * np.array([0.985, 1.0, 1.02])
CORNER = 0.52 * np.array([0.985, 1.0, 1.02])
MIDDLE_HEIGHT = 0.42  # of the picture, from above


SHADES = 4096  # of the gradient: a twentieth of a step of 8 bits


@lru_cache(maxsize=8)
def backdrop(background: Literal["studio", "transparent"] | Colour, width: int, height: int) -> ByteArray:
    """(H, W, 4) uint8 sRGB, dithered; kept for the next frame, so change it no more."""
    picture = np.zeros((height, width, 4), np.uint8)
    if background == "transparent":
        return picture
    if background == "studio":
        part = np.linspace(0, 1, SHADES)[:, None]
        linear = MIDDLE + (CORNER - MIDDLE) * part
        shade_of = studio_gradient(width, height)
    else:
        linear = np.array([background], float)
        shade_of = np.zeros((height, width), np.intp)
    shown = (255 * srgb_from_linear(np.clip(linear, 0, 1))).astype(np.float32)
    threshold = np.tile(DITHER.reshape(8, 8), (height // 8 + 1, width // 8 + 1))[:height, :width]
    picture[..., :3] = shown[shade_of] + threshold[..., None]
    picture[..., 3] = 255
    return picture


def studio_gradient(width: int, height: int) -> IntArray:
    """(H, W) which of the SHADES: a pool of light behind the product that falls off to the corners."""
    y = (np.arange(height) + 0.5) / height - MIDDLE_HEIGHT
    x = ((np.arange(width) + 0.5) / width - 0.5) * min(1.0, width / height)
    distance = np.minimum(1.0, (x[None, :] ** 2 + y[:, None] ** 2) / 0.64)
    fall = distance * (2 - distance)
    shades: IntArray = (fall * (SHADES - 1) + 0.5).astype(np.intp)
    return shades
