"""Images halved again and again, side by side in one flat array for kernels. [Williams83]"""

from __future__ import annotations

import weakref
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from eyeline.geometry.arrays import ByteArray, FloatArray, IntArray
from eyeline.scene.colour import linear_from_srgb, srgb_from_linear
from eyeline.scene.texture import Texture
from eyeline.shading.joined import joined

# Columns of `images`
WIDTH, HEIGHT, LEVELS, WRAP_U, WRAP_V, NEAREST, DECODING = range(7)
LEVEL = 7  # and on: where in the texels each level begins
MOST_LEVELS = 16
REPEAT, MIRROR, CLAMP = 0, 1, 2
WRAPS = {"repeat": REPEAT, "mirror": MIRROR, "clamp": CLAMP}
SRGB, PLAIN = 0, 256  # which half of encoding.DECODED turns the bytes into numbers


class Textures(NamedTuple):
    """X images with their samplers."""

    images: IntArray  # (max(X, 1), 7 + 16) int64
    texels: ByteArray  # flat RGBA of every level of every image


_chains: dict[tuple[int, bool], tuple[weakref.ref[ByteArray], ByteArray, list[tuple[int, int]]]] = {}


def textures_of(used: Sequence[tuple[Texture, bool]]) -> Textures:
    """The table of textures, each with whether its colours are sRGB."""
    images = np.zeros((max(len(used), 1), LEVEL + MOST_LEVELS), np.int64)
    chains = [mipmaps(texture.pixels, srgb) for texture, srgb in used]
    start = 0
    for row, (texture, srgb), (chain, sizes) in zip(images, used, chains, strict=False):
        wrap_u, wrap_v = (WRAPS[wrap] for wrap in texture.wrap)
        levels = len(sizes) if texture.mipmaps else 1
        row[:LEVEL] = *sizes[0], levels, wrap_u, wrap_v, texture.nearest, SRGB if srgb else PLAIN
        areas = [4 * width * height for width, height in sizes]
        row[LEVEL : LEVEL + len(sizes)] = start + np.cumsum([0, *areas[:-1]])
        start += chain.size
    return Textures(images, joined([chain for chain, _ in chains], np.uint8))


def mipmaps(pixels: ByteArray, srgb: bool) -> tuple[ByteArray, list[tuple[int, int]]]:
    """Every level of an image, flat, and their (width, height); kept for as long as the image lives."""
    for key in [key for key, (image, _, _) in list(_chains.items()) if image() is None]:
        _chains.pop(key, None)
    kept = _chains.get((id(pixels), srgb))
    if kept is None:
        levels = _levels(pixels, srgb)
        sizes = [(level.shape[1], level.shape[0]) for level in levels]
        flat = np.concatenate([level.reshape(-1) for level in levels])
        kept = _chains[id(pixels), srgb] = weakref.ref(pixels), flat, sizes
    return kept[1], kept[2]


def _levels(pixels: ByteArray, srgb: bool) -> list[ByteArray]:
    """The image and its halves down to one texel, filtered in linear light."""
    levels = [np.ascontiguousarray(pixels)]
    decode = linear_from_srgb(np.arange(256) / 255).astype(np.float32) if srgb else None
    linear: FloatArray = pixels.astype(np.float32) / 255
    if decode is not None:
        linear[..., :3] = decode[pixels[..., :3]]
    while linear.shape[0] * linear.shape[1] > 1 and len(levels) < MOST_LEVELS:
        linear = _halved(_halved(linear, 0), 1)
        shown = linear.copy()
        if srgb:
            shown[..., :3] = srgb_from_linear(linear[..., :3])
        levels.append((shown * 255 + 0.5).astype(np.uint8))
    return levels


def _halved(image: FloatArray, axis: int) -> FloatArray:
    """Half the rows (axis 0) or columns (1): means of what they cover; odd ones overlap. [Guthe05]"""
    count = image.shape[axis]
    if count == 1:
        return image
    moved = np.moveaxis(image, axis, 0)
    half = count // 2
    if count % 2 == 0:
        return np.moveaxis((moved[0::2] + moved[1::2]) / 2, 0, axis)
    step = np.arange(half, dtype=np.float32).reshape(-1, *([1] * (moved.ndim - 1)))
    total = moved[0:-1:2] * (half - step) + moved[1::2] * half + moved[2::2] * (step + 1)
    return np.moveaxis(total / count, 0, axis)
