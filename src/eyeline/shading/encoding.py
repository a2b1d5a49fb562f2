"""sRGB and back by tables, with an ordered dither, so that gradients show no bands. [IEC 61966-2-1]"""

from __future__ import annotations

import math

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.jit import helper
from eyeline.scene.colour import linear_from_srgb, srgb_from_linear

ENCODED_SIZE = 4096  # 1/16 of a step of 8 bits, and finer


def _threshold_matrix() -> FloatArray:
    """(8, 8) every threshold once, each far from its neighbours. [Bayer73]"""
    matrix = np.zeros((1, 1))
    for _ in range(3):
        matrix = np.block([[4 * matrix, 4 * matrix + 2], [4 * matrix + 3, 4 * matrix + 1]])
    return (matrix + 0.5) / 64


# The tables: display values 0..255 over the square root of light, which sRGB nearly is ...
ENCODED = (255 * srgb_from_linear((np.arange(ENCODED_SIZE + 1) / ENCODED_SIZE) ** 2)).astype(np.float32)
# ... and light from 8 bits: 256 of sRGB, then 256 of plain numbers.
DECODED = np.concatenate([linear_from_srgb(np.arange(256) / 255), np.arange(256) / 255]).astype(np.float32)
# Thresholds stay a tenth away from whole steps, so that colours that are whole steps come out as they are.
DITHER = (0.1 + 0.8 * _threshold_matrix()).astype(np.float32).reshape(-1)


@helper
def encoded(linear, threshold, table):
    """The 8 bits of linear light; table: ENCODED."""
    # Written so that what is no number is black
    light = linear if linear > np.float32(0) else np.float32(0)
    light = light if light < np.float32(1) else np.float32(1)
    step = np.int64(math.sqrt(light) * np.float32(ENCODED_SIZE) + np.float32(0.5))
    return np.uint8(table[step] + threshold)
