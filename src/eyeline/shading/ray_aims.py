"""Where rays go from surface points: to the open sky, to a lamp's disk, along a mirror's lobe.

Every point turns one well spread pattern by an angle of its pixel, so that neighbours differ where one
pattern would show bands. No number comes by chance. [Roberts18]
"""

from __future__ import annotations

import math

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.jit import helper, kernel
from eyeline.shading.lanes import GX, GY, GZ, NX, NY, NZ, ROUGHNESS, VX, VY, VZ, X, Y, Z
from eyeline.shading.light_table import AT, NEARNESS, WIDTH

TURNS = 256  # angles that a pattern is turned by
ACROSS, DOWN, AGAIN = 0.7548776662466927, 0.5698402909980532, 0.6180339887498949  # parts of a turn
CLEARANCE = np.float32(4)  # of a lamp's own radius: what is nearer to it is its fitting, and casts no shadow
WIDEST = np.float32(0.95)  # of a lobe: its last hundredths go everywhere

ZERO, ONE, TWO, TINY = np.float32(0), np.float32(1), np.float32(2), np.float32(1e-20)


def disk_pattern(count: int) -> FloatArray:
    """(count, 2) float32 evenly over the unit disk, also its first few."""
    number = np.arange(count)
    radius, angle = np.sqrt((0.5 + number * ACROSS) % 1), 2 * np.pi * ((number * DOWN) % 1)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1).astype(np.float32)


def turns_of(pixel: IntArray, width: int, seed: int) -> FloatArray:
    """(K, 2) float32 cosine and sine by which the points of pixels turn their pattern."""
    row, column = np.divmod(pixel.astype(np.int64), width)
    step = ((column * ACROSS + row * DOWN + seed * AGAIN) % 1 * TURNS).astype(np.int64)
    angle = 2 * np.pi / TURNS * np.arange(TURNS)
    return np.stack([np.cos(angle), np.sin(angle)], axis=1).astype(np.float32)[step]


@helper
def sideways(x, y, z):
    """Two unit vectors that with a unit vector (x, y, z) make a frame. [Duff17]"""
    sign = ONE if z >= ZERO else -ONE
    a = -ONE / (sign + z)
    b = x * y * a
    return ONE + sign * x * x * a, sign * b, -sign * x, b, sign + y * y * a, -y


@helper
def set_ray(lanes, i, ray, dx, dy, dz, lift, origins, directions):
    """Write a ray from the point in lane i; one into its face is turned out of it."""
    gx, gy, gz = lanes[GX, i], lanes[GY, i], lanes[GZ, i]
    out = dx * gx + dy * gy + dz * gz
    if out < ZERO:
        dx, dy, dz = dx - TWO * out * gx, dy - TWO * out * gy, dz - TWO * out * gz
    origins[ray, 0], directions[ray, 0] = lanes[X, i] + lift * gx, dx
    origins[ray, 1], directions[ray, 1] = lanes[Y, i] + lift * gy, dy
    origins[ray, 2], directions[ray, 2] = lanes[Z, i] + lift * gz, dz


@kernel
def aim_at_sky(lanes, chosen, pattern, turns, lift, origins, directions):
    """Rays of each chosen lane over its hemisphere, dense about the normal as matt surfaces weigh light."""
    count = pattern.shape[0]
    for m in range(chosen.shape[0]):
        i = chosen[m]
        nx, ny, nz = lanes[NX, i], lanes[NY, i], lanes[NZ, i]
        ax, ay, az, bx, by, bz = sideways(nx, ny, nz)
        for k in range(count):
            x = pattern[k, 0] * turns[i, 0] - pattern[k, 1] * turns[i, 1]
            y = pattern[k, 0] * turns[i, 1] + pattern[k, 1] * turns[i, 0]
            z = math.sqrt(max(ONE - x * x - y * y, ZERO))
            dx, dy, dz = ax * x + bx * y + nx * z, ay * x + by * y + ny * z, az * x + bz * y + nz * z
            set_ray(lanes, i, m * count + k, dx, dy, dz, lift, origins, directions)


@kernel
def aim_at_light(lanes, chosen, lights, row, pattern, turns, lift, origins, directions, reach):
    """Rays of each chosen lane to the disk that a light shines from, and how far it is."""
    count = pattern.shape[0]
    nearness, size = lights[row, NEARNESS], lights[row, WIDTH]
    for m in range(chosen.shape[0]):
        i = chosen[m]
        lx = lights[row, AT] - lanes[X, i] * nearness
        ly = lights[row, AT + 1] - lanes[Y, i] * nearness
        lz = lights[row, AT + 2] - lanes[Z, i] * nearness
        distance = math.sqrt(lx * lx + ly * ly + lz * lz) + TINY
        lx, ly, lz = lx / distance, ly / distance, lz / distance
        ax, ay, az, bx, by, bz = sideways(lx, ly, lz)
        for k in range(count):
            x = (pattern[k, 0] * turns[i, 0] - pattern[k, 1] * turns[i, 1]) * size
            y = (pattern[k, 0] * turns[i, 1] + pattern[k, 1] * turns[i, 0]) * size
            dx, dy, dz = lx + ax * x + bx * y, ly + ay * x + by * y, lz + az * x + bz * y
            ray = m * count + k
            gx, gy, gz = lanes[GX, i], lanes[GY, i], lanes[GZ, i]
            # A face that turns away lies in its own shadow: no ray is needed to tell
            away = dx * gx + dy * gy + dz * gz <= ZERO
            origins[ray, 0], directions[ray, 0] = lanes[X, i] + lift * gx, dx
            origins[ray, 1], directions[ray, 1] = lanes[Y, i] + lift * gy, dy
            origins[ray, 2], directions[ray, 2] = lanes[Z, i] + lift * gz, dz
            end = distance * (ONE - CLEARANCE * size) if nearness > ZERO else np.float32(np.inf)
            reach[ray] = -ONE if away else end


@kernel
def aim_at_mirror(lanes, chosen, pattern, turns, lift, origins, directions):
    """Rays of each chosen lane to where a mirror of its roughness throws what comes from the eye."""
    count = pattern.shape[0]
    for m in range(chosen.shape[0]):
        i = chosen[m]
        nx, ny, nz = lanes[NX, i], lanes[NY, i], lanes[NZ, i]
        vx, vy, vz = lanes[VX, i], lanes[VY, i], lanes[VZ, i]
        ax, ay, az, bx, by, bz = sideways(nx, ny, nz)
        alpha = lanes[ROUGHNESS, i] * lanes[ROUGHNESS, i]
        for k in range(count):
            px, py = pattern[k, 0] * WIDEST, pattern[k, 1] * WIDEST
            # The slope of a facet of the lobe [Walter07, eq. 35]
            slope = alpha / math.sqrt(ONE - px * px - py * py)
            x = (px * turns[i, 0] - py * turns[i, 1]) * slope
            y = (px * turns[i, 1] + py * turns[i, 0]) * slope
            hx, hy, hz = nx + ax * x + bx * y, ny + ay * x + by * y, nz + az * x + bz * y
            scale = TWO * (vx * hx + vy * hy + vz * hz) / (hx * hx + hy * hy + hz * hz)
            dx, dy, dz = scale * hx - vx, scale * hy - vy, scale * hz - vz
            set_ray(lanes, i, m * count + k, dx, dy, dz, lift, origins, directions)
