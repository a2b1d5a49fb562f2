"""What a texture shows at a place: wrapped, and blended between texels and between levels. [Williams83]"""

from __future__ import annotations

import math

import numpy as np

from eyeline.jit import helper
from eyeline.shading.texture_table import (
    CLAMP,
    DECODING,
    HEIGHT,
    LEVEL,
    LEVELS,
    MIRROR,
    NEAREST,
    WIDTH,
    WRAP_U,
    WRAP_V,
)


@helper
def wrapped(index, size, wrap):
    """The texel that stands at `index` of an image that goes on beyond its `size`."""
    if wrap == CLAMP:
        return min(max(index, 0), size - 1)
    if 0 <= index < size:
        return index
    if wrap == MIRROR:
        turn = index % (2 * size)
        return min(turn, 2 * size - 1 - turn)
    return index % size


@helper
def footprint_level(du_dx, dv_dx, du_dy, dv_dy, levels):
    """Which level's texels are as large as a pixel; between two of them a fraction, 0 when magnified.

    The derivatives are texels of level 0 per pixel. Between powers of two it is linear in the size.
    """
    area = max(du_dx * du_dx + dv_dx * dv_dx, du_dy * du_dy + dv_dy * dv_dy)
    level = 0
    while area >= 4.0 and level < levels - 1:
        area *= 0.25
        level += 1
    # Written so that what is no number is not blurred
    if not area > 1.0:
        return float(level)
    return min(level + math.sqrt(area) - 1.0, levels - 1.0)


@helper
def texel_blend(images, texels, decoded, image, level, u, v):
    """Four channels at (u, v) of one level, blended between its four nearest texels."""
    width = max(images[image, WIDTH] >> level, 1)
    height = max(images[image, HEIGHT] >> level, 1)
    start = images[image, LEVEL + level]
    decoding = images[image, DECODING]
    x, y = u * width - 0.5, v * height - 0.5
    column, row = math.floor(x), math.floor(y)
    right, down = np.float32(x - column), np.float32(y - row)
    left, up = np.float32(1) - right, np.float32(1) - down
    x0, x1 = wrapped(column, width, images[image, WRAP_U]), wrapped(column + 1, width, images[image, WRAP_U])
    y0, y1 = wrapped(row, height, images[image, WRAP_V]), wrapped(row + 1, height, images[image, WRAP_V])
    a, b = start + 4 * (y0 * width + x0), start + 4 * (y0 * width + x1)
    c, d = start + 4 * (y1 * width + x0), start + 4 * (y1 * width + x1)
    wa, wb, wc, wd = left * up, right * up, left * down, right * down
    red = decoded[decoding + texels[a]] * wa + decoded[decoding + texels[b]] * wb
    red += decoded[decoding + texels[c]] * wc + decoded[decoding + texels[d]] * wd
    green = decoded[decoding + texels[a + 1]] * wa + decoded[decoding + texels[b + 1]] * wb
    green += decoded[decoding + texels[c + 1]] * wc + decoded[decoding + texels[d + 1]] * wd
    blue = decoded[decoding + texels[a + 2]] * wa + decoded[decoding + texels[b + 2]] * wb
    blue += decoded[decoding + texels[c + 2]] * wc + decoded[decoding + texels[d + 2]] * wd
    alpha = decoded[256 + texels[a + 3]] * wa + decoded[256 + texels[b + 3]] * wb
    alpha += decoded[256 + texels[c + 3]] * wc + decoded[256 + texels[d + 3]] * wd
    return red, green, blue, alpha


@helper
def texel(images, texels, decoded, image, u, v):
    """Four channels of the nearest texel."""
    width, height = images[image, WIDTH], images[image, HEIGHT]
    decoding = images[image, DECODING]
    x = wrapped(math.floor(u * width), width, images[image, WRAP_U])
    y = wrapped(math.floor(v * height), height, images[image, WRAP_V])
    at = images[image, LEVEL] + 4 * (y * width + x)
    red, green = decoded[decoding + texels[at]], decoded[decoding + texels[at + 1]]
    return red, green, decoded[decoding + texels[at + 2]], decoded[256 + texels[at + 3]]


@helper
def sampled(images, texels, decoded, image, u, v, level):
    """Four channels of a texture at (u, v), at a level that may lie between two."""
    if level <= 0.0 and images[image, NEAREST]:
        return texel(images, texels, decoded, image, u, v)
    lower = int(level)
    part = np.float32(level - lower)
    red, green, blue, alpha = texel_blend(images, texels, decoded, image, lower, u, v)
    if part > 0 and lower + 1 < images[image, LEVELS]:
        red1, green1, blue1, alpha1 = texel_blend(images, texels, decoded, image, lower + 1, u, v)
        red += (red1 - red) * part
        green += (green1 - green) * part
        blue += (blue1 - blue) * part
        alpha += (alpha1 - alpha) * part
    return red, green, blue, alpha
