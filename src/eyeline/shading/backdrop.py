"""What stands behind everything: a studio gradient, one colour, or nothing."""

from __future__ import annotations

from functools import lru_cache
from typing import Literal

import numpy as np

from eyeline.geometry.arrays import ByteArray, FloatArray
from eyeline.scene.material import Colour
from eyeline.shading.encoding import DITHER, srgb_from_linear

# Slightly cool light greys, linear: in the middle, where the product stands, and in the corners.
MIDDLE = 0.86 * np.array([0.985, 1.0, 1.02])
CORNER = 0.52 * np.array([0.985, 1.0, 1.02])
MIDDLE_HEIGHT = 0.42  # of the picture, from above


@lru_cache(maxsize=8)
def backdrop(background: Literal["studio", "transparent"] | Colour, width: int, height: int) -> ByteArray:
    """(H, W, 4) uint8 sRGB, dithered; read-only, kept for the next frame."""
    picture = np.zeros((height, width, 4), np.uint8)
    if background != "transparent":
        linear = studio_gradient(width, height) if background == "studio" else np.array(background, float)
        shown = 255 * srgb_from_linear(np.clip(linear, 0, 1))
        threshold = np.resize(
            np.tile(DITHER.reshape(8, 8), (height // 8 + 1, width // 8 + 1))[:height, :width], (height, width)
        )
        picture[..., :3] = shown + threshold[..., None]
        picture[..., 3] = 255
    picture.flags.writeable = False
    return picture


def studio_gradient(width: int, height: int) -> FloatArray:
    """(H, W, 3) linear: a pool of light behind the product that falls off to the corners."""
    y = (np.arange(height) + 0.5) / height - MIDDLE_HEIGHT
    x = ((np.arange(width) + 0.5) / width - 0.5) * min(1.0, width / height)
    distance = np.minimum(1.0, (x[None, :] ** 2 + y[:, None] ** 2) / 0.64)
    fall = distance * (2 - distance)
    return MIDDLE + (CORNER - MIDDLE) * fall[..., None]
