"""How much of a light arrives at a point: a filter over its map, as wide as the blocker is far.

[Reeves87; Fernando05] A texel is compared with the plane of the receiving face, not with one depth, so that
faces do not shade themselves however wide the filter is. [Isidoro06]
"""

from __future__ import annotations

import math

import numpy as np

from eyeline.jit import helper, kernel
from eyeline.shading.lanes import COLUMN, GX, GY, GZ, LIT, NX, NY, NZ, X, Y, Z
from eyeline.shading.light_table import AT, NEARNESS
from eyeline.shading.shadow_map import (
    BLOCK,
    CALM,
    EMPTY,
    MATRIX,
    PLANES,
    POOL,
    TEXELS_OF_LEVELS,
    UNIT,
    UNIT_BY_DEPTH,
    WIDENING,
)

ZERO, HALF, ONE, TWO = np.float32(0), np.float32(0.5), np.float32(1), np.float32(2)
SEARCHED = 4  # blockers are sought in 4 x 4 pools, which reach as far as the widest filter
REACH = 4  # texels: a wider filter looks at every second only
NARROWEST, WIDEST = (
    np.float32(2),
    np.float32(BLOCK),
)  # texels: the radius of the sharpest and the softest outline
STEEPEST = 100.0  # texels of depth for each across: beyond, a face is lit so flatly that it is dark anyway
SLACK, SLACK_OF_SLOPE = 1.5, 0.1  # texels of depth, and of the slope, that a blocker must stand out by
# Rows of a tile's places in a map: where, how deep, and how depth grows along u and v on the face's plane
U, V, HERE, SLOPE_U, SLOPE_V, LIGHT = 0, 1, 2, 3, 4, 5
OUTSIDE = -1.0  # in row U: the map has nothing to say
UNKNOWN = np.float32(-1)  # in row LIGHT
GROUP = 32  # columns of pixels whose lanes may tell each other's light
LONGEST = 8  # lanes from one that is looked up to the next
ALIKE, DARK = np.float32(0.25), np.float32(1e-5)  # parts of the light


@kernel
def arrive(lanes, count, maps, lights, light):
    """Fill LIT with the part of one light that arrives, 0..1."""
    first, sides = maps.of_light[light, 0], maps.of_light[light, 1]
    for i in range(count):
        lanes[LIT, i] = ONE
    if sides == 0:
        return
    places = np.empty((6, count), np.float32)
    room = np.empty((2, 2 * REACH), np.float32)
    for side in range(sides):
        place_in_map(lanes, count, maps.rows, first + side, maps.size, places)
        drop_others(lanes, count, lights, light, side if sides > 1 else -1, places)
        begin = 0
        while begin < count:
            # Lanes of one group of columns stand side by side
            group, end = int(lanes[COLUMN, begin]) // GROUP, begin + 1
            while end < count and int(lanes[COLUMN, end]) // GROUP == group:
                end += 1
            light_span(maps, first + side, places, begin, end - 1, room)
            begin = end
        for i in range(count):
            lanes[LIT, i] = places[LIGHT, i] if places[U, i] >= ZERO else lanes[LIT, i]


@helper
def light_span(maps, index, places, first, last, room):
    """Fill the light of lanes first .. last: from lane to lane in strides, and between two that tell it."""
    light = places[LIGHT]
    for lane in range(first, last + 1):
        light[lane] = UNKNOWN
    begin, stride = first, 0
    while True:
        end = min(begin + stride, last)
        if light[end] == UNKNOWN:
            light[end] = arriving(maps, index, places, end, room)
        if end - begin < 2 or between(maps.rows, index, places, begin, end):
            begin, stride = end, min(max(2 * stride, 1), LONGEST)
            if begin == last:
                break
        else:
            stride = (end - begin) // 2


@helper
def between(rows, index, places, begin, end):
    """Fill the light between two lanes where theirs tells it; whether it did.

    The filter is never narrower than NARROWEST: where it finds nothing, or all, at two places less than twice
    as far apart, it does so in between; and what it finds changes slowly.
    """
    us, vs, depths, light = places[U], places[V], places[HERE], places[LIGHT]
    u, v, depth, part = us[begin], vs[begin], depths[begin], light[begin]
    scale = ONE / np.float32(end - begin)
    du, dv, deeper = (us[end] - u) * scale, (vs[end] - v) * scale, (depths[end] - depth) * scale
    change = light[end] - part
    apart = max(abs(du), abs(dv)) * np.float32(end - begin)
    same = min(part, light[end]) == ONE or max(part, light[end]) < DARK
    if u < ZERO or apart > (TWO * NARROWEST if same else NARROWEST) or abs(change) > ALIKE:
        return False
    # Where an outline begins is looked up
    if not same and max(part, light[end]) == ONE:
        return False
    rise = np.float32(2 * (rows[index, UNIT] + rows[index, UNIT_BY_DEPTH] * depth))
    joint = True
    for lane in range(begin + 1, end):
        along = np.float32(lane - begin)
        joint = joint and abs(us[lane] - u - du * along) < ONE and abs(vs[lane] - v - dv * along) < ONE
        joint = joint and abs(depths[lane] - depth - deeper * along) < rise
    if joint:
        for lane in range(begin + 1, end):
            light[lane] = part + change * scale * np.float32(lane - begin)
    return joint


@helper
def place_in_map(lanes, count, rows, index, size, places):
    """Where each lane lies in a map, and its plane there: whole vectors at a time."""
    m = rows[index]
    inner, outer = float(BLOCK), float(size - BLOCK)
    us, vs = places[U], places[V]
    depths, slopes_u, slopes_v = places[HERE], places[SLOPE_U], places[SLOPE_V]
    xs, ys, zs = lanes[X], lanes[Y], lanes[Z]
    nxs, nys, nzs = lanes[GX], lanes[GY], lanes[GZ]
    m0, m1, m2, m3 = m[MATRIX], m[MATRIX + 1], m[MATRIX + 2], m[MATRIX + 3]
    m4, m5, m6, m7 = m[MATRIX + 4], m[MATRIX + 5], m[MATRIX + 6], m[MATRIX + 7]
    m8, m9, m10, m11 = m[MATRIX + 8], m[MATRIX + 9], m[MATRIX + 10], m[MATRIX + 11]
    m12, m13, m14, m15 = m[MATRIX + 12], m[MATRIX + 13], m[MATRIX + 14], m[MATRIX + 15]
    p0, p1, p2, p3 = m[PLANES], m[PLANES + 1], m[PLANES + 2], m[PLANES + 3]
    p4, p5, p6, p7 = m[PLANES + 4], m[PLANES + 5], m[PLANES + 6], m[PLANES + 7]
    p8, p9, p10, p11 = m[PLANES + 8], m[PLANES + 9], m[PLANES + 10], m[PLANES + 11]
    unit_0, unit_1 = m[UNIT], m[UNIT_BY_DEPTH]
    for i in range(count):
        x, y, z = float(xs[i]), float(ys[i]), float(zs[i])
        w = m12 * x + m13 * y + m14 * z + m15
        per_w = 1.0 / w
        u = (m0 * x + m1 * y + m2 * z + m3) * per_w
        v = (m4 * x + m5 * y + m6 * z + m7) * per_w
        here = (m8 * x + m9 * y + m10 * z + m11) * per_w
        # Near its border, and behind its eye, a map knows nothing
        inside = (w > 0) & (u >= inner) & (u < outer) & (v >= inner) & (v < outer)
        # How depth grows along u and v on the plane, no steeper than STEEPEST
        nx, ny, nz = float(nxs[i]), float(nys[i]), float(nzs[i])
        nw = -(nx * x + ny * y + nz * z)
        a = p0 * nx + p1 * ny + p2 * nz + p3 * nw
        b = p4 * nx + p5 * ny + p6 * nz + p7 * nw
        c = p8 * nx + p9 * ny + p10 * nz + p11 * nw
        unit = unit_0 + unit_1 * here
        # Keep the direction of what is steeper, not the slope
        least = max(abs(a), abs(b)) / (STEEPEST * unit)
        c = c if abs(c) > least else (least if c > 0 else -least)
        c = c if c != 0 else 1.0
        slope_u, slope_v = -a / c, -b / c
        us[i] = u if inside else OUTSIDE
        vs[i] = v
        depths[i] = here + SLACK * unit + SLACK_OF_SLOPE * (abs(slope_u) + abs(slope_v))
        slopes_u[i], slopes_v[i] = slope_u, slope_v


@helper
def drop_others(lanes, count, lights, light, side, places):
    """Take lanes out of a map that turn from the light, or that another side of its cube holds."""
    nearness = lights[light, NEARNESS]
    ax, ay, az = lights[light, AT], lights[light, AT + 1], lights[light, AT + 2]
    us = places[U]
    for i in range(count):
        x, y, z = ax - lanes[X, i] * nearness, ay - lanes[Y, i] * nearness, az - lanes[Z, i] * nearness
        # What turns away is dark without a shadow
        away = x * lanes[NX, i] + y * lanes[NY, i] + z * lanes[NZ, i] <= ZERO
        us[i] = OUTSIDE if away else us[i]
    if side >= 0:
        for i in range(count):
            x, y, z = ax - lanes[X, i] * nearness, ay - lanes[Y, i] * nearness, az - lanes[Z, i] * nearness
            if cube_side(-x, -y, -z) != side:
                us[i] = OUTSIDE


@helper
def cube_side(x, y, z):
    """Which of the six maps of a cube a direction meets."""
    if abs(x) >= abs(y) and abs(x) >= abs(z):
        return 0 if x > 0 else 1
    if abs(y) >= abs(z):
        return 2 if y > 0 else 3
    return 4 if z > 0 else 5


@helper
def arriving(maps, index, places, lane, room):
    """The part of a light, 0..1, that a map lets through to a lane's place; room: for `filtered`."""
    size, depth = maps.size, maps.depth
    u, v, here = places[U, lane], places[V, lane], places[HERE, lane]
    if u < ZERO:
        return ONE
    per_row = size // BLOCK
    column, row = np.int64(u), np.int64(v)
    state = maps.blocks[(index * per_row + row // BLOCK) * per_row + column // BLOCK]
    if state == EMPTY:
        return ONE
    slope_u, slope_v = places[SLOPE_U, lane], places[SLOPE_V, lane]
    start = index * TEXELS_OF_LEVELS * (size // POOL) * (size // POOL)
    if state == CALM:
        limit = here + slope_u * (column + HALF - u) + slope_v * (row + HALF - v)
        # Nothing, depth 0, shades nothing, not even what lies beyond all depth
        return ZERO if depth[start + row * size + column] > max(limit, ZERO) else ONE
    pools = start + size * size + size * size // 4
    radius = radius_of(maps.rows, index, depth, pools, size // POOL, u, v, here, slope_u, slope_v)
    level = 1 if radius > REACH else 0
    start += level * size * size
    return filtered(depth, start, size >> level, level, u, v, here, slope_u, slope_v, radius, room)


@helper
def radius_of(rows, index, depth, start, size, u, v, here, slope_u, slope_v):
    """How wide the outline is, texels, by the pools near (u, v) that stand out from the receiver's plane."""
    column, row = np.int64(u / POOL + HALF) - SEARCHED // 2, np.int64(v / POOL + HALF) - SEARCHED // 2
    # A pool holds the nearest of its texels: on the plane itself that one lies this much before its middle
    before = np.float32((POOL - 1) / 2) * (abs(slope_u) + abs(slope_v))
    away_u, away_v = np.float32(column * POOL + POOL // 2) - u, np.float32(row * POOL + POOL // 2) - v
    limit = here + slope_u * away_u + slope_v * away_v + before
    du, dv = POOL * slope_u, POOL * slope_v
    found, total = ZERO, ZERO
    for j in range(SEARCHED):
        base = np.uint64(start + (row + j) * size + column)
        found_in_row, total_in_row = ZERO, ZERO
        for k in range(SEARCHED):
            there = depth[base + np.uint64(k)]
            shading = there > max(limit + du * np.float32(k), ZERO)
            found_in_row += ONE if shading else ZERO
            total_in_row += there if shading else ZERO
        found += found_in_row
        total += total_in_row
        limit += dv
    if found == ZERO:
        return NARROWEST
    wide = (total / found - here) * np.float32(rows[index, WIDENING])
    return min(max(wide, NARROWEST), WIDEST)


@helper
def filtered(depth, start, size, level, u, v, here, slope_u, slope_v, radius, room):
    """The part of a level's texels within a radius around (u, v) that do not shade; near ones weigh more."""
    step = np.float32(1 << level)
    middle_u, middle_v, reach = (u - HALF) / step, (v - HALF) / step, radius / step
    left, top = np.int64(math.ceil(middle_u - reach)), np.int64(math.ceil(middle_v - reach))
    # As many columns as rows, so that loops are short of surprises
    taps = np.int64(math.ceil(reach)) * 2
    du, dv = slope_u * step, slope_v * step
    per_reach = ONE / (reach * reach)
    weights, rises = room[0], room[1]
    away = np.float32(left) - middle_u
    across = ZERO
    for k in range(taps):
        weight = max(ONE - away * away * per_reach, ZERO)
        weights[k], rises[k] = weight, du * away
        across += weight
        away += ONE
    away = np.float32(top) - middle_v
    down, shaded = ZERO, ZERO
    for j in range(taps):
        weight = max(ONE - away * away * per_reach, ZERO)
        limit = here + dv * away
        base = np.uint64(start + (top + j) * size + left)
        total = ZERO
        for k in range(taps):
            there = depth[base + np.uint64(k)]
            total += weights[k] if there > max(limit + rises[k], ZERO) else ZERO
        shaded += total * weight
        down += weight
        away += ONE
    return max(ONE - shaded / (across * down), ZERO)
