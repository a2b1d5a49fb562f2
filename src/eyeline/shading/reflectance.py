"""How much of a light a surface throws to the eye: metallic-roughness over whole vectors of points.

Lambert under a GGX coat with Smith's joint masking and Schlick's Fresnel, and what the coat throws on after
more than one bounce. [glTF 2.0, appendix B; Walter07; Heitz14; Turquin19]
"""

from __future__ import annotations

import math

import numpy as np

from eyeline.jit import helper, kernel
from eyeline.shading.lanes import (
    BLUE,
    GREEN,
    GX,
    GY,
    GZ,
    LIT,
    METALLIC,
    NX,
    NY,
    NZ,
    OUT_BLUE,
    OUT_GREEN,
    OUT_RED,
    RED,
    ROUGHNESS,
    VX,
    VY,
    VZ,
    X,
    Y,
    Z,
)
from eyeline.shading.light_table import (
    AT,
    AXIS,
    COLOR,
    CONE_OFFSET,
    CONE_SCALE,
    NEARNESS,
    RANGE,
    WIDTH,
)

ZERO, HALF, ONE, TWO = np.float32(0), np.float32(0.5), np.float32(1), np.float32(2)
TINY = np.float32(1e-20)  # keeps quotients finite where the numerator is 0 as well
PER_PI = np.float32(1 / np.pi)
DIELECTRIC = np.float32(0.04)  # what glass and plastic reflect straight back, index of refraction 1.5
LEAST_ALPHA = np.float32(1e-3)  # a perfect mirror shows no lamp that is a point
LEAST_FACING = np.float32(1e-4)  # a normal that leans away from the eye counts as seen edge-on


@kernel
def prepare(lanes, count, sight):
    """Make normals unit, and find the direction to the eye.

    sight: (4,) the direction to an orthographic camera, or 0, and how much of the place goes against it:
    1 for a perspective one, which stands at 0.
    """
    eye_x, eye_y, eye_z, nearness = sight[0], sight[1], sight[2], sight[3]
    for i in range(count):
        x, y, z = lanes[NX, i], lanes[NY, i], lanes[NZ, i]
        scale = ONE / math.sqrt(x * x + y * y + z * z + TINY)
        lanes[NX, i], lanes[NY, i], lanes[NZ, i] = x * scale, y * scale, z * scale
        x, y, z = lanes[GX, i], lanes[GY, i], lanes[GZ, i]
        scale = ONE / math.sqrt(x * x + y * y + z * z + TINY)
        lanes[GX, i], lanes[GY, i], lanes[GZ, i] = x * scale, y * scale, z * scale
        x = eye_x - lanes[X, i] * nearness
        y = eye_y - lanes[Y, i] * nearness
        z = eye_z - lanes[Z, i] * nearness
        scale = ONE / math.sqrt(x * x + y * y + z * z + TINY)
        lanes[VX, i], lanes[VY, i], lanes[VZ, i] = x * scale, y * scale, z * scale
        lanes[LIT, i] = ONE


@kernel
def add_light(lanes, count, lights, row):
    """Add what one light contributes where LIT lets it."""
    ax, ay, az = lights[row, AXIS], lights[row, AXIS + 1], lights[row, AXIS + 2]
    px, py, pz = lights[row, AT], lights[row, AT + 1], lights[row, AT + 2]
    red, green, blue = lights[row, COLOR], lights[row, COLOR + 1], lights[row, COLOR + 2]
    nearness, reach = lights[row, NEARNESS], lights[row, RANGE]
    cone_scale, cone_offset, width = lights[row, CONE_SCALE], lights[row, CONE_OFFSET], lights[row, WIDTH]
    for i in range(count):
        # Direction and strength of the light here; one far away is a direction, and has no nearness
        lx = px - lanes[X, i] * nearness
        ly = py - lanes[Y, i] * nearness
        lz = pz - lanes[Z, i] * nearness
        squared = lx * lx + ly * ly + lz * lz + TINY
        scale = ONE / math.sqrt(squared)
        lx, ly, lz = lx * scale, ly * scale, lz * scale
        part = squared * reach
        window = min(max(ONE - part * part, ZERO), ONE)
        cone = min(max((lx * ax + ly * ay + lz * az) * cone_scale + cone_offset, ZERO), ONE)
        arriving = (ONE - nearness + nearness * window / squared) * cone * cone * lanes[LIT, i]
        # Angles
        nx, ny, nz = lanes[NX, i], lanes[NY, i], lanes[NZ, i]
        vx, vy, vz = lanes[VX, i], lanes[VY, i], lanes[VZ, i]
        to_light = nx * lx + ny * ly + nz * lz
        to_eye = max(nx * vx + ny * vy + nz * vz, LEAST_FACING)
        arriving *= max(to_light, ZERO)
        to_light = max(to_light, LEAST_FACING)
        hx, hy, hz = lx + vx, ly + vy, lz + vz
        scale = ONE / math.sqrt(hx * hx + hy * hy + hz * hz + TINY)
        to_half = min((nx * hx + ny * hy + nz * hz) * scale, ONE)
        grazing = ONE - min((vx * hx + vy * hy + vz * hz) * scale, ONE)
        # A wide lamp blurs its own reflection as roughness would
        alpha = min(max(lanes[ROUGHNESS, i] * lanes[ROUGHNESS, i], LEAST_ALPHA) + width, ONE)
        a2 = alpha * alpha
        spread = to_half * to_half * (a2 - ONE) + ONE
        lobe = a2 * PER_PI / (spread * spread)
        rest = ONE - a2
        masked = to_light * math.sqrt(to_eye * to_eye * rest + a2) + to_eye * math.sqrt(
            to_light * to_light * rest + a2
        )
        lobe *= HALF / masked
        bounced = bounced_for_one(to_eye, lanes[ROUGHNESS, i] * lanes[ROUGHNESS, i])
        fresnel = grazing * grazing * grazing * grazing * grazing
        # Metals colour their mirror and have no matt under it
        metallic = lanes[METALLIC, i]
        matt = (ONE - metallic) * PER_PI
        base = lanes[RED, i]
        zero = DIELECTRIC + (base - DIELECTRIC) * metallic
        f = zero + (ONE - zero) * fresnel
        lanes[OUT_RED, i] += ((ONE - f) * base * matt + f * lobe * (ONE + zero * bounced)) * arriving * red
        base = lanes[GREEN, i]
        zero = DIELECTRIC + (base - DIELECTRIC) * metallic
        f = zero + (ONE - zero) * fresnel
        lanes[OUT_GREEN, i] += (
            ((ONE - f) * base * matt + f * lobe * (ONE + zero * bounced)) * arriving * green
        )
        base = lanes[BLUE, i]
        zero = DIELECTRIC + (base - DIELECTRIC) * metallic
        f = zero + (ONE - zero) * fresnel
        lanes[OUT_BLUE, i] += ((ONE - f) * base * matt + f * lobe * (ONE + zero * bounced)) * arriving * blue


@helper
def bounced_for_one(to_eye, alpha):
    """What leaves a white mirror after several bounces, for each part that leaves after one. [Turquin19]

    A fit to 1 / E - 1, with E the part of the light of an even sky that the lobe alone throws to the eye.
    """
    first = np.float32(0.397) + to_eye * (np.float32(1.087) - np.float32(1.862) * to_eye)
    second = np.float32(-0.395) + to_eye * (np.float32(1.636) + np.float32(1.32) * to_eye)
    return alpha * (first + alpha * second)
