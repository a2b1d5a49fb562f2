"""From light to what a screen can show: highlights roll off, colours below them stay. [KhronosNeutral24]"""

from __future__ import annotations

import numpy as np

from eyeline.jit import kernel
from eyeline.shading.lanes import (
    ALPHA,
    BLUE,
    EMISSIVE_BLUE,
    EMISSIVE_GREEN,
    EMISSIVE_RED,
    GREEN,
    OUT_BLUE,
    OUT_GREEN,
    OUT_RED,
    RED,
    UNLIT,
)

ZERO, ONE = np.float32(0), np.float32(1)
# The constants of the published operator
FRESNEL = np.float32(0.04)  # the haze that a dielectric's reflection adds to every colour
TOE = np.float32(6.25)  # 1 / (4 * FRESNEL)
TOE_END = np.float32(0.08)
SHOULDER = np.float32(0.8 - 0.04)  # where compression begins
HEADROOM = np.float32(1 - (0.8 - 0.04))
DESATURATION = np.float32(0.15)


@kernel
def show(lanes, count, gain, neutral, colour, begin):
    """Fill colour (K, 4) from row `begin` on with what the screen shows of the light that leaves.

    gain: what exposure multiplies light by; neutral: 1 maps tones, 0 clips. Unlit points bypass both.
    """
    for i in range(count):
        red = (lanes[OUT_RED, i] + lanes[EMISSIVE_RED, i]) * gain
        green = (lanes[OUT_GREEN, i] + lanes[EMISSIVE_GREEN, i]) * gain
        blue = (lanes[OUT_BLUE, i] + lanes[EMISSIVE_BLUE, i]) * gain
        # Toe
        low = min(red, min(green, blue))
        offset = (low - TOE * low * low if low < TOE_END else FRESNEL) * neutral
        red, green, blue = red - offset, green - offset, blue - offset
        # Shoulder: the brightest channel is compressed, and what it loses turns to white
        peak = max(red, max(green, blue))
        over = max(peak - SHOULDER, ZERO) * neutral
        pressed = peak - over + over * HEADROOM / (over + HEADROOM)
        scale = pressed / max(peak, SHOULDER)
        scale = scale if over > ZERO else ONE
        white = ONE - ONE / (DESATURATION * (peak - pressed) + ONE)
        red = red * scale + (pressed - red * scale) * white
        green = green * scale + (pressed - green * scale) * white
        blue = blue * scale + (pressed - blue * scale) * white
        unlit = lanes[UNLIT, i]
        lanes[OUT_RED, i] = red + (lanes[RED, i] - red) * unlit
        lanes[OUT_GREEN, i] = green + (lanes[GREEN, i] - green) * unlit
        lanes[OUT_BLUE, i] = blue + (lanes[BLUE, i] - blue) * unlit
    for i in range(count):
        colour[begin + i, 0] = lanes[OUT_RED, i]
        colour[begin + i, 1] = lanes[OUT_GREEN, i]
        colour[begin + i, 2] = lanes[OUT_BLUE, i]
        colour[begin + i, 3] = lanes[ALPHA, i]
