"""Pictures on surfaces: the image, how it repeats and filters, and where it lies."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from eyeline.errors import GeometryError
from eyeline.geometry.arrays import ByteArray, FloatArray

Wrap = Literal["repeat", "mirror", "clamp"]


@dataclass(frozen=True, eq=False)
class Texture:
    """An image and its sampler. Equal images are shared by identity of `pixels`."""

    pixels: ByteArray  # (H, W, 4) RGBA as stored: sRGB in colour slots, plain numbers in the others
    wrap: tuple[Wrap, Wrap] = ("repeat", "repeat")  # along u, along v
    nearest: bool = False  # magnification shows the texels; otherwise bilinear
    mipmaps: bool = True  # minification blends between halved images; otherwise aliases
    name: str = ""

    def __post_init__(self) -> None:
        """Refuse what is not an RGBA image."""
        shape = self.pixels.shape
        if len(shape) != 3 or shape[2] != 4 or 0 in shape or self.pixels.dtype != np.uint8:
            raise GeometryError(f"texture pixels are {self.pixels.dtype} {shape}; uint8 (H, W, 4) is needed")


@dataclass(frozen=True, eq=False)
class TextureSlot:
    """A texture where a material uses it: which UV set, moved how. [KHR_texture_transform]"""

    texture: Texture
    uv_set: int = 0
    offset: tuple[float, float] = (0.0, 0.0)
    rotation: float = 0.0  # radians, counter-clockwise in the image
    scale: tuple[float, float] = (1.0, 1.0)

    @property
    def texture_from_uv(self) -> FloatArray:
        """(2, 3) the matrix that moves (u, v, 1); v runs down the image."""
        c, s = np.cos(self.rotation), np.sin(self.rotation)
        (x, y), (sx, sy) = self.offset, self.scale
        return np.array([[c * sx, s * sy, x], [-s * sx, c * sy, y]])
