"""How much of a light arrives at a point: a filter over its map, as wide as the blocker is far. [Reeves87; Fernando05]

A texel is compared with the plane of the receiving face, not with one depth, so that faces do not shade
themselves however wide the filter is. [Isidoro06]
"""

from __future__ import annotations

import math

import numpy as np

from eyeline.jit import helper, kernel
from eyeline.shading.lanes import GX, GY, GZ, LIT, NX, NY, NZ, X, Y, Z
from eyeline.shading.light_table import AT, NEARNESS
from eyeline.shading.shadow_map import BLOCK, CALM, EMPTY, MATRIX, PLANES, UNIT, UNIT_BY_DEPTH, WIDENING

ZERO, ONE = np.float32(0), np.float32(1)
REACH = 4  # texels from the middle that a filter of 8 x 8 covers
NARROWEST = np.float32(1.5)  # texels: the radius of the sharpest outline
STEEPEST = 12.0  # texels of depth for each across: beyond, a face is lit so flatly that it is dark anyway
SLACK = 0.5  # texels of depth that a blocker must stand out by


@kernel
def arrive(lanes, count, maps, lights, light):
    """Fill LIT with the part of one light that arrives, 0..1."""
    first, sides = maps.of_light[light, 0], maps.of_light[light, 1]
    nearness = lights[light, NEARNESS]
    for i in range(count):
        lit = ONE
        x = lights[light, AT] - lanes[X, i] * nearness
        y = lights[light, AT + 1] - lanes[Y, i] * nearness
        z = lights[light, AT + 2] - lanes[Z, i] * nearness
        # What turns away is dark without a shadow
        towards = x * lanes[NX, i] + y * lanes[NY, i] + z * lanes[NZ, i]
        if sides > 0 and towards > 0:
            side = first + (cube_side(-x, -y, -z) if sides > 1 else 0)
            lit = arriving(
                maps.rows, maps.depth, maps.blocks, maps.size, side,
                (lanes[X, i], lanes[Y, i], lanes[Z, i]), (lanes[GX, i], lanes[GY, i], lanes[GZ, i]),
            )  # fmt: skip
        lanes[LIT, i] = lit


@helper
def cube_side(x, y, z):
    """Which of the six maps of a cube a direction meets."""
    if abs(x) >= abs(y) and abs(x) >= abs(z):
        return 0 if x > 0 else 1
    if abs(y) >= abs(z):
        return 2 if y > 0 else 3
    return 4 if z > 0 else 5


@helper
def arriving(rows, depth, blocks, size, index, place, normal):
    """The part of a light, 0..1, that a map lets through to a place on a face with this normal."""
    x, y, z = float(place[0]), float(place[1]), float(place[2])
    w = along(rows, index, MATRIX + 12, x, y, z, 1.0)
    if w <= 0:
        return ONE
    u = along(rows, index, MATRIX, x, y, z, 1.0) / w
    v = along(rows, index, MATRIX + 4, x, y, z, 1.0) / w
    if not (0 <= u < size and 0 <= v < size):
        return ONE
    per_row = size // BLOCK
    state = blocks[index * per_row * per_row + (int(v) // BLOCK) * per_row + int(u) // BLOCK]
    if state == EMPTY:
        return ONE
    here = along(rows, index, MATRIX + 8, x, y, z, 1.0) / w
    unit = rows[index, UNIT] + rows[index, UNIT_BY_DEPTH] * here
    slope_u, slope_v = plane_slopes(rows, index, x, y, z, normal, unit)
    start = index * size * size
    # Depth on the receiver's plane at texel (0, 0), in front of which a texel shades
    slack = SLACK * unit + 0.25 * (abs(slope_u) + abs(slope_v))
    plane = here + slack - slope_u * (u - 0.5) - slope_v * (v - 0.5)
    if state == CALM:
        column, row = int(u), int(v)
        shaded = depth[start + row * size + column] > max(plane + slope_u * column + slope_v * row, 0.0)
        return ZERO if shaded else ONE
    radius = penumbra(rows, depth, size, index, u, v, here, plane, slope_u, slope_v)
    step = 1
    while radius > REACH * step:
        step *= 2
    return filtered(depth, size, start, u, v, plane, slope_u, slope_v, radius, step)


@helper
def along(rows, index, column, x, y, z, w):
    """One row of a matrix times (x, y, z, w)."""
    return (
        rows[index, column] * x
        + rows[index, column + 1] * y
        + rows[index, column + 2] * z
        + rows[index, column + 3] * w
    )


@helper
def plane_slopes(rows, index, x, y, z, normal, unit):
    """How depth grows along u and v on the plane through a place, no steeper than STEEPEST."""
    nx, ny, nz = float(normal[0]), float(normal[1]), float(normal[2])
    nw = -(nx * x + ny * y + nz * z)
    a = along(rows, index, PLANES, nx, ny, nz, nw)
    b = along(rows, index, PLANES + 4, nx, ny, nz, nw)
    c = along(rows, index, PLANES + 8, nx, ny, nz, nw)
    most = STEEPEST * unit
    steep = max(abs(a), abs(b))
    if steep >= most * abs(c):
        # Keep the direction, not the slope
        scale = most / steep if steep > 0 else 0.0
        return (-a * scale, -b * scale) if c > 0 else (a * scale, b * scale)
    return -a / c, -b / c


@helper
def penumbra(rows, depth, size, index, u, v, here, plane, slope_u, slope_v):
    """The radius of the filter, texels: the farther the blockers, the wider."""
    start = index * size * size
    column, row = 4 * (int(u) // 4 - 3) + 2, 4 * (int(v) // 4 - 3) + 2
    total, blockers = 0.0, 0
    for j in range(8):
        y = min(max(row + 4 * j, 0), size - 1)
        for i in range(8):
            x = min(max(column + 4 * i, 0), size - 1)
            there = depth[start + y * size + x]
            if there > max(plane + slope_u * x + slope_v * y, 0.0):
                total += there
                blockers += 1
    if blockers == 0:
        return NARROWEST
    wide = (total / blockers - here) * rows[index, WIDENING]
    return np.float32(min(max(wide, NARROWEST), float(BLOCK)))


@helper
def filtered(depth, size, start, u, v, plane, slope_u, slope_v, radius, step):
    """The part of the texels around (u, v) that do not shade, each weighed by its nearness.

    step: every step-th texel is looked at.
    """
    middle_u, middle_v = (u - 0.5) / step, (v - 0.5) / step
    column, row = math.floor(middle_u) - 3, math.floor(middle_v) - 3
    per_radius = np.float32(step) / radius
    total, open_part = ZERO, ZERO
    for j in range(8):
        away = np.float32(row + j - middle_v) * per_radius
        weight_v = max(ONE - away * away, ZERO)
        if weight_v == 0:
            continue
        y = min(max((row + j) * step, 0), size - 1)
        limit = plane + slope_v * y
        for i in range(8):
            away = np.float32(column + i - middle_u) * per_radius
            weight = max(ONE - away * away, ZERO) * weight_v
            x = min(max((column + i) * step, 0), size - 1)
            total += weight
            # Nothing, depth 0, shades nothing, not even what lies beyond all depth
            if depth[start + y * size + x] <= max(np.float32(limit + slope_u * x), ZERO):
                open_part += weight
    return open_part / total
