"""How much of a light arrives at a point: a filter over its map, as wide as the blocker is far.

[Reeves87; Fernando05] A texel is compared with the plane of the receiving face, not with one depth, so that
faces do not shade themselves however wide the filter is. [Isidoro06]
"""

from __future__ import annotations

import math

import numpy as np

from eyeline.jit import helper, kernel
from eyeline.shading.lanes import GX, GY, GZ, LIT, NX, NY, NZ, X, Y, Z
from eyeline.shading.light_table import AT, NEARNESS
from eyeline.shading.shadow_map import BLOCK, CALM, EMPTY, MATRIX, PLANES, UNIT, UNIT_BY_DEPTH, WIDENING

ZERO, ONE = np.float32(0), np.float32(1)
SEARCHED, STRIDE = 5, 3  # blockers are sought at 5 x 5 texels, every third
REACH = 4.0  # texels: a wider filter looks at every second only
NARROWEST, WIDEST = 2.0, float(BLOCK)  # texels: the radius of the sharpest and the softest outline
STEEPEST = 100.0  # texels of depth for each across: beyond, a face is lit so flatly that it is dark anyway
SLACK, SLACK_OF_SLOPE = 0.5, 0.1  # texels of depth, and of the slope, that a blocker must stand out by


@kernel
def arrive(lanes, count, maps, lights, light):
    """Fill LIT with the part of one light that arrives, 0..1."""
    first, sides = maps.of_light[light, 0], maps.of_light[light, 1]
    nearness = lights[light, NEARNESS]
    for i in range(count):
        lanes[LIT, i] = ONE
        x = lights[light, AT] - lanes[X, i] * nearness
        y = lights[light, AT + 1] - lanes[Y, i] * nearness
        z = lights[light, AT + 2] - lanes[Z, i] * nearness
        # What turns away is dark without a shadow
        if sides > 0 and x * lanes[NX, i] + y * lanes[NY, i] + z * lanes[NZ, i] > 0:
            side = first + (cube_side(-x, -y, -z) if sides > 1 else 0)
            normal = lanes[GX, i], lanes[GY, i], lanes[GZ, i]
            lanes[LIT, i] = arriving(maps, side, lanes[X, i], lanes[Y, i], lanes[Z, i], normal)


@helper
def cube_side(x, y, z):
    """Which of the six maps of a cube a direction meets."""
    if abs(x) >= abs(y) and abs(x) >= abs(z):
        return 0 if x > 0 else 1
    if abs(y) >= abs(z):
        return 2 if y > 0 else 3
    return 4 if z > 0 else 5


@helper
def arriving(maps, index, x, y, z, normal):
    """The part of a light, 0..1, that a map lets through to a place on a face with this normal."""
    rows, size = maps.rows, maps.size
    w = along(rows, index, MATRIX + 12, x, y, z, 1.0)
    per_w = 1.0 / w
    u = along(rows, index, MATRIX, x, y, z, 1.0) * per_w
    v = along(rows, index, MATRIX + 4, x, y, z, 1.0) * per_w
    # Near its border, and behind its eye, a map knows nothing
    if not (w > 0 and BLOCK <= u < size - BLOCK and BLOCK <= v < size - BLOCK):
        return ONE
    per_row = size // BLOCK
    state = maps.blocks[index * per_row * per_row + (int(v) // BLOCK) * per_row + int(u) // BLOCK]
    if state == EMPTY:
        return ONE
    here = along(rows, index, MATRIX + 8, x, y, z, 1.0) * per_w
    unit = rows[index, UNIT] + rows[index, UNIT_BY_DEPTH] * here
    slope_u, slope_v = plane_slopes(rows, index, x, y, z, normal, unit)
    start = index * (size * size + size * size // 4)
    here += SLACK * unit + SLACK_OF_SLOPE * (abs(slope_u) + abs(slope_v))
    found, depth_of_found = 0, ZERO
    if state != CALM:
        found, depth_of_found = blockers(maps.depth, start, size, u, v, here, slope_u, slope_v)
    if found == 0:
        column, row = int(u), int(v)
        # Nothing, depth 0, shades nothing, not even what lies beyond all depth
        limit = max(here + slope_u * (column + 0.5 - u) + slope_v * (row + 0.5 - v), 0.0)
        return ZERO if maps.depth[start + row * size + column] > limit else ONE
    if found == SEARCHED * SEARCHED:
        return ZERO
    wide = (depth_of_found / found - here) * rows[index, WIDENING]
    radius = min(max(wide, NARROWEST), WIDEST)
    if radius > REACH:
        return filtered(maps.depth, start + size * size, size // 2, 1, u, v, here, slope_u, slope_v, radius)
    return filtered(maps.depth, start, size, 0, u, v, here, slope_u, slope_v, radius)


@helper
def along(rows, index, column, x, y, z, w):
    """One row of a matrix times (x, y, z, w)."""
    m = rows
    return (
        m[index, column] * x + m[index, column + 1] * y + m[index, column + 2] * z + m[index, column + 3] * w
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
def blockers(depth, start, size, u, v, here, slope_u, slope_v):
    """How many of some texels far around (u, v) shade the receiver's plane, and their depths' sum."""
    column, row = int(u) - STRIDE * (SEARCHED // 2), int(v) - STRIDE * (SEARCHED // 2)
    limit = np.float32(here + slope_u * (column + 0.5 - u) + slope_v * (row + 0.5 - v))
    du, dv = np.float32(STRIDE * slope_u), np.float32(STRIDE * slope_v)
    found, total = 0, ZERO
    for j in range(SEARCHED):
        base = start + (row + STRIDE * j) * size + column
        for i in range(SEARCHED):
            there = depth[base + STRIDE * i]
            shading = there > ZERO and there > limit + du * np.float32(i)
            found += 1 if shading else 0
            total += there if shading else ZERO
        limit += dv
    return found, total


@helper
def filtered(depth, start, size, level, u, v, here, slope_u, slope_v, radius):
    """The part of a level's texels within a radius around (u, v) that do not shade; near ones weigh more."""
    step = 1 << level
    middle_u, middle_v, reach = (u - 0.5) / step, (v - 0.5) / step, radius / step
    left, top = math.ceil(middle_u - reach), math.ceil(middle_v - reach)
    right, bottom = math.floor(middle_u + reach), math.floor(middle_v + reach)
    du, dv = np.float32(slope_u * step), np.float32(slope_v * step)
    per_reach = np.float32(1 / (reach * reach))
    total, shaded = ZERO, ZERO
    away_v = np.float32(top - middle_v)
    for row in range(top, bottom + 1):
        weight_v = ONE - away_v * away_v * per_reach
        away_u = np.float32(left - middle_u)
        limit = np.float32(here) + dv * away_v
        for column in range(left, right + 1):
            weight = (ONE - away_u * away_u * per_reach) * weight_v
            there = depth[start + row * size + column]
            total += weight
            shaded += weight if there > ZERO and there > limit + du * away_u else ZERO
            away_u += ONE
        away_v += ONE
    return max(ONE - shaded / total, ZERO)
