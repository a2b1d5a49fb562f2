"""What stands behind everything: a studio gradient, one colour, or nothing."""

from __future__ import annotations

from functools import lru_cache
from typing import Literal

import numpy as np

from eyeline.geometry.arrays import ByteArray, FloatArray, IntArray
from eyeline.scene.colour import srgb_from_linear
from eyeline.scene.material import Colour
from eyeline.shading.encoding import DITHER

# Slightly cool light greys, linear: in the middle, where the product stands, and in the corners.
MIDDLE = 0.86 * np.array([0.985, 1.0, 1.02])
CORNER = 0.52 * np.array([0.985, 1.0, 1.02])
MIDDLE_HEIGHT = 0.42  # of the picture, from above
SHADES = 4096  # of the gradient: a twentieth of a step of 8 bits
BAYER = 8  # pixels along a side of the dither's square


@lru_cache(maxsize=8)
def backdrop(background: Literal["studio", "transparent"] | Colour, width: int, height: int) -> ByteArray:
    """(H, W, 4) uint8 sRGB, dithered; kept for the next frame, so change it no more."""
    if background == "transparent":
        return np.zeros((height, width, 4), np.uint8)
    studio = background == "studio"
    linear = studio_shades() if studio else np.array([background], float)
    colours = dithered(linear)
    # Where the row of `colours` for each pixel of the dither's square begins
    begin = np.arange(BAYER * BAYER, dtype=np.int32).reshape(BAYER, BAYER) * np.int32(len(linear))
    begin = np.tile(begin, (1, width // BAYER + 1))[:, :width]
    picture = np.empty((height, width), np.uint32)
    for top in range(0, height, BAYER):
        rows = picture[top : top + BAYER]
        place = begin[: len(rows)]
        if studio:
            place = place + studio_gradient(width, height, top, top + len(rows))
        rows[...] = colours[place]
    return picture.view(np.uint8).reshape(height, width, 4)


def dithered(linear: FloatArray) -> IntArray:
    """(64 S,) uint32: the four bytes of S colours (S, 3), linear 0..1, at each threshold of the dither."""
    shown = (255 * srgb_from_linear(np.clip(linear, 0, 1))).astype(np.float32)
    pixels = np.full((len(DITHER), len(shown), 4), 255, np.uint8)
    pixels[..., :3] = shown + DITHER[:, None, None]
    return pixels.view(np.uint32).reshape(-1)


def studio_shades() -> FloatArray:
    """(SHADES, 3) linear, from the middle to the corners."""
    part = np.linspace(0, 1, SHADES)[:, None]
    shades: FloatArray = MIDDLE + (CORNER - MIDDLE) * part
    return shades


def studio_gradient(width: int, height: int, top: int, bottom: int) -> IntArray:
    """(rows, W) int32 which shade: a pool of light behind the product that falls off to the corners."""
    y = (np.arange(top, bottom) + 0.5) / height - MIDDLE_HEIGHT
    x = ((np.arange(width) + 0.5) / width - 0.5) * min(1.0, width / height)
    across, down = (x * x / 0.64).astype(np.float32), (y * y / 0.64).astype(np.float32)
    distance = np.minimum(np.float32(1), across[None, :] + down[:, None])
    fall = distance * (np.float32(2) - distance)
    shades: IntArray = (fall * np.float32(SHADES - 1) + np.float32(0.5)).astype(np.int32)
    return shades
