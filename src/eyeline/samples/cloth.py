"""Sackcloth: a woven texture with stripes and an ear of wheat, painted by code."""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.scene.material import Material
from eyeline.scene.texture import Texture, TextureSlot

PIXELS = 512  # of the whole, front and back side by side
LINEN, INK = np.array([226.0, 205.0, 166.0]), np.array([38.0, 74.0, 128.0])  # sRGB


@cache
def sackcloth() -> Material:
    """Linen with two blue stripes and, on the left half of the texture, an ear of wheat."""
    across, down = np.meshgrid(
        (np.arange(PIXELS) + 0.5) / PIXELS, (np.arange(PIXELS) + 0.5) / PIXELS, indexing="xy"
    )
    weave = np.sin(across * PIXELS * 0.9) * np.sin(down * PIXELS * 0.9)
    slubs = np.random.default_rng(7).normal(size=(2, PIXELS))
    threads = 5 * weave + 3.0 * slubs[0][:, None] + 3.0 * slubs[1][None, :]
    stripes = np.maximum(_band(down, 0.80, 0.022), _band(down, 0.865, 0.007))
    # The left half is the front, half as wide in the texture as on the sack
    ink = np.maximum(stripes, wheat((across - 0.25) * 2 * 0.75, 0.52 - down))
    ink = ink * (0.86 + 0.05 * slubs[0][:, None] * slubs[1][None, :].clip(-1, 1))
    colours = LINEN + threads[..., None] + (INK - LINEN) * ink[..., None]
    pixels = np.full((PIXELS, PIXELS, 4), 255, np.uint8)
    pixels[..., :3] = np.clip(np.rint(colours), 0, 255)
    texture = Texture(pixels, name="sackcloth")
    return Material(
        "sackcloth", (1.0, 1.0, 1.0, 1.0), roughness=0.95, base_color_texture=TextureSlot(texture)
    )


def wheat(x: FloatArray, y: FloatArray) -> FloatArray:
    """An ear of wheat about the origin, 0.4 high: 1 where there is ink, 0 where there is none."""
    ink = np.where((np.abs(x - 0.02 * np.sin(6 * y)) < 0.006) & (np.abs(y + 0.02) < 0.19), 1.0, 0.0)
    for row in range(5):
        for side in (-1, 1):
            ink = np.maximum(ink, _grain(x, y, (side * 0.036, -0.02 + 0.042 * row), -side * 0.55))
    return np.maximum(ink, _grain(x, y, (0.0, 0.20), 0.0))


def _grain(x: FloatArray, y: FloatArray, middle: tuple[float, float], turn: float) -> FloatArray:
    c, s = math.cos(turn), math.sin(turn)
    a, b = x - middle[0], y - middle[1]
    along, beside = (c * b - s * a) / 0.034, (c * a + s * b) / 0.015
    return _soft(1 - (along * along + beside * beside), 0.2)


def _band(values: FloatArray, middle: float, half: float) -> FloatArray:
    return _soft(half - np.abs(values - middle), 1.5 / PIXELS)


def _soft(inside: FloatArray, width: float) -> FloatArray:
    """0 to 1 where something rises through 0, over a width."""
    soft: FloatArray = np.clip(inside / width + 0.5, 0, 1)
    return soft
