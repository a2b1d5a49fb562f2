"""The light around a scene: a bright ceiling, a darker floor, and a soft box overhead, in closed form.

Matt surfaces see it gathered over a hemisphere; mirrors see it blurred by their roughness, dimmed by the
split sum's second factor, with what is thrown on after several bounces. [Karis13; Karis14; Turquin19]
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.jit import helper, kernel
from eyeline.shading.lanes import (
    BLUE,
    GREEN,
    METALLIC,
    NX,
    NY,
    NZ,
    OCCLUSION,
    OPEN,
    OUT_BLUE,
    OUT_GREEN,
    OUT_RED,
    RED,
    ROUGHNESS,
    VX,
    VY,
    VZ,
)

# Radiance of the parts, and where the box hangs; columns of a (12,) float32 array
CEILING, FLOOR, BOX, BOX_AXIS = 0, 3, 6, 9

ZERO, HALF, ONE, TWO = np.float32(0), np.float32(0.5), np.float32(1), np.float32(2)
DIELECTRIC = np.float32(0.04)
# How wide the horizon and the rim of the box are for a mirror, and how much a matt surface adds; cosines
HORIZON, HORIZON_BLUR = np.float32(0.12), np.float32(0.88)
RIM, RIM_BLUR = np.float32(0.05), np.float32(0.95)
BOX_COSINE = np.float32(0.80)


def environment(ceiling: FloatArray, floor: FloatArray, box: FloatArray, box_axis: FloatArray) -> FloatArray:
    """(12,) float32 of the radiance (3,) of each part, and the unit direction to the box."""
    return np.concatenate([ceiling, floor, box, box_axis]).astype(np.float32)


@helper
def split_sum(to_eye, roughness):
    """Scale and offset of the colour seen straight on: what a mirror throws back of an even light."""
    # exp2(-9.28 x) is exp2(-0.58 x) squared four times, and that is nearly a cubic
    power = ONE + to_eye * (
        np.float32(-0.40203) + to_eye * (np.float32(0.08081) - to_eye * np.float32(0.0098))
    )
    power *= power
    power *= power
    power *= power
    power *= power
    smooth = ONE - roughness
    a = min(smooth * smooth, power) * smooth + np.float32(0.0425) - np.float32(0.0275) * roughness
    scale = np.float32(-1.04) * a + np.float32(1.04) - np.float32(0.572) * roughness
    return scale, np.float32(1.04) * a + np.float32(0.022) * roughness - np.float32(0.04)


@helper
def mirrored(upward, to_box, roughness):
    """How much of the ceiling, and of the box, a mirror of this roughness sees; cosines of its ray."""
    horizon = HORIZON + HORIZON_BLUR * roughness
    up = min(max(HALF + HALF * upward / horizon, ZERO), ONE)
    up = up * up * (np.float32(3) - TWO * up)
    rim = RIM + RIM_BLUR * roughness
    box = min(max(HALF + HALF * (to_box - BOX_COSINE) / rim, ZERO), ONE)
    return up, box * box * (np.float32(3) - TWO * box) * (ONE - np.float32(0.75) * roughness)


@helper
def open_to_mirror(to_eye, open_part):
    """How much of what a mirror sees creases leave open, by what they leave of the hemisphere. [Lagarde14]"""
    return min(max((to_eye + open_part) * (to_eye + open_part) - ONE + open_part, ZERO), ONE)


@kernel
def add_environment(lanes, count, parts):
    """Begin the light that leaves with what the surroundings give."""
    ceiling_red, ceiling_green, ceiling_blue = parts[CEILING], parts[CEILING + 1], parts[CEILING + 2]
    floor_red, floor_green, floor_blue = parts[FLOOR], parts[FLOOR + 1], parts[FLOOR + 2]
    box_red, box_green, box_blue = parts[BOX], parts[BOX + 1], parts[BOX + 2]
    bx, by, bz = parts[BOX_AXIS], parts[BOX_AXIS + 1], parts[BOX_AXIS + 2]
    for i in range(count):
        nx, ny, nz = lanes[NX, i], lanes[NY, i], lanes[NZ, i]
        vx, vy, vz = lanes[VX, i], lanes[VY, i], lanes[VZ, i]
        facing = nx * vx + ny * vy + nz * vz
        rx, ry, rz = TWO * facing * nx - vx, TWO * facing * ny - vy, TWO * facing * nz - vz
        to_eye = min(max(facing, ZERO), ONE)
        roughness = lanes[ROUGHNESS, i]
        scale, offset = split_sum(to_eye, roughness)
        # For each part of a white mirror's light that leaves after one bounce, what leaves after several
        bounced = ONE / (scale + offset) - ONE
        up, box = mirrored(ry, rx * bx + ry * by + rz * bz, roughness)
        # How much of it creases leave open
        open_part = lanes[OCCLUSION, i] * lanes[OPEN, i]
        open_mirror = open_to_mirror(to_eye, open_part)
        half_up = (HALF + HALF * ny) * open_part
        half_down = (HALF - HALF * ny) * open_part
        half_box = max(HALF + HALF * (nx * bx + ny * by + nz * bz), ZERO)
        half_box = half_box * half_box * open_part * np.float32(0.25)
        metallic = lanes[METALLIC, i]
        matt = (ONE - metallic) * (ONE - DIELECTRIC)
        base = lanes[RED, i]
        zero = DIELECTRIC + (base - DIELECTRIC) * metallic
        mirror = (zero * scale + offset) * (ONE + zero * bounced) * open_mirror
        seen = floor_red + (ceiling_red - floor_red) * up + box_red * box
        lanes[OUT_RED, i] = (
            base * matt * (ceiling_red * half_up + floor_red * half_down + box_red * half_box) + mirror * seen
        )
        base = lanes[GREEN, i]
        zero = DIELECTRIC + (base - DIELECTRIC) * metallic
        mirror = (zero * scale + offset) * (ONE + zero * bounced) * open_mirror
        seen = floor_green + (ceiling_green - floor_green) * up + box_green * box
        lanes[OUT_GREEN, i] = (
            base * matt * (ceiling_green * half_up + floor_green * half_down + box_green * half_box)
            + mirror * seen
        )
        base = lanes[BLUE, i]
        zero = DIELECTRIC + (base - DIELECTRIC) * metallic
        mirror = (zero * scale + offset) * (ONE + zero * bounced) * open_mirror
        seen = floor_blue + (ceiling_blue - floor_blue) * up + box_blue * box
        lanes[OUT_BLUE, i] = (
            base * matt * (ceiling_blue * half_up + floor_blue * half_down + box_blue * half_box)
            + mirror * seen
        )
