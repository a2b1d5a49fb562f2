"""Samples to pixels: transparent layers over what stands behind, the mean of the samples, and sRGB."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import ByteArray, FloatArray, IntArray
from eyeline.jit import kernel
from eyeline.shading.encoding import DECODED, DITHER, ENCODED, encoded


@dataclass(frozen=True, eq=False)
class Layers:
    """Transparent fragments in front of the samples of P pixels, far to near."""

    first: IntArray  # (n, P + 1) int64: where the fragments of each sample's pixel begin
    colour: FloatArray  # (L, 4) float32, linear 0..1, alpha last, not multiplied by it


NO_LAYERS = Layers(np.zeros((0, 0), np.int64), np.zeros((0, 4), np.float32))


def resolve(
    of_sample: IntArray,
    colour: FloatArray,
    layers: Layers | None,
    backdrop: ByteArray,
    picture: ByteArray,
    top: int = 0,
) -> None:
    """Fill picture (rows, W, 4), straight alpha, sRGB.

    of_sample: (n, P) rows of colour (K, 4) linear 0..1, or -1; backdrop: (rows, W, 4) sRGB; top: the row of
    the whole picture that is the first here, so that the dither goes on from strip to strip.
    The mean is taken of what the screen shows, after the tone map, so that bright edges stay smooth.
    """
    layers = layers or NO_LAYERS
    width = picture.shape[1]
    picture[...] = backdrop
    resolve_pixels(
        of_sample, colour, layers.first, layers.colour, backdrop.reshape(-1, 4), picture.reshape(-1, 4),
        width, top, ENCODED, DECODED, DITHER,
    )  # fmt: skip


@kernel
def resolve_pixels(of_sample, colour, first, layer, backdrop, picture, width, top, table, decoded, dither):
    """Blend, average and encode every pixel of picture, which holds the backdrop."""
    samples, count = of_sample.shape
    layered = first.shape[0] > 0
    share_of_one = np.float32(1) / np.float32(samples)
    for p in range(count):
        point = of_sample[0, p]
        alike = not layered or first[0, p] == first[0, p + 1]
        for s in range(1, samples):
            alike = alike and of_sample[s, p] == point and (not layered or first[s, p] == first[s, p + 1])
        if alike and point < 0:
            continue
        red, green, blue, alpha = np.float32(0), np.float32(0), np.float32(0), np.float32(0)
        for s in range(samples):
            point = of_sample[s, p]
            if point >= 0:
                a = colour[point, 3]
                r, g, b = colour[point, 0] * a, colour[point, 1] * a, colour[point, 2] * a
            else:
                a = np.float32(0)
                r, g, b = a, a, a
            rest = np.float32(1) - a
            if rest > 0:
                back = decoded[256 + np.int64(backdrop[p, 3])] * rest
                r += decoded[backdrop[p, 0]] * back
                g += decoded[backdrop[p, 1]] * back
                b += decoded[backdrop[p, 2]] * back
                a += back
            if layered:
                for k in range(first[s, p], first[s, p + 1]):
                    over = layer[k, 3]
                    rest = np.float32(1) - over
                    r = r * rest + layer[k, 0] * over
                    g = g * rest + layer[k, 1] * over
                    b = b * rest + layer[k, 2] * over
                    a = a * rest + over
            red += r
            green += g
            blue += b
            alpha += a
            if alike:
                break
        if not alike:
            red, green, blue, alpha = (
                red * share_of_one,
                green * share_of_one,
                blue * share_of_one,
                alpha * share_of_one,
            )
        if alpha > 0 and alpha < 1:
            red, green, blue = red / alpha, green / alpha, blue / alpha
        threshold = dither[((top + p // width) & 7) * 8 + ((p % width) & 7)]
        picture[p, 0] = encoded(red, threshold, table)
        picture[p, 1] = encoded(green, threshold, table)
        picture[p, 2] = encoded(blue, threshold, table)
        picture[p, 3] = np.uint8(min(alpha, np.float32(1)) * np.float32(255) + np.float32(0.5))
