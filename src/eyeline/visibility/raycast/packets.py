"""The rays of a tile of pixels go through the tree together: one walk for a thousand rays.

Every box is carried with the range of pixels whose rays can meet it, so that boxes between pixels die at
once, and one behind what all of its rays have hit is not opened. [Wald01, Reshetov05]
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.bvh import CHILD, CORNERS, EXTENT, MIDDLE, NO_CHILD, NUMBER, STACK, fetch_child
from eyeline.geometry.crossing import crosses, exact_crosses, side_shown
from eyeline.jit import kernel, on_stack, trailing_zeros
from eyeline.visibility.raycast.tiles import (
    ACROSS,
    DOWN,
    INFINITE,
    ONE,
    ROOM,
    ROOM_ACROSS,
    TILE,
    aim,
    counts_for,
    first_pixel,
    last_pixel,
    pixels_between,
    take_tile,
)

LANES = 8  # children of a node, faces of a leaf, rays of a block
COORDINATES = 9 * LANES  # of the corners of a leaf's faces
FEW = 6  # rays: a face before so few is tested together with the other small ones of its leaf
PAIRS = LANES * FEW  # of a small face of a leaf and a ray
NOWHERE = -1  # no range
EVERY = (1 << LANES) - 1  # the bits of all lanes

NODES, LEAVES, FACES, TESTS = 0, 1, 2, 3  # columns of what is counted


@kernel
def trace_tiles(part, parts, tree, view, lens, place, nearest_box, sides, distance, face, counts):
    """Trace the rays of every `parts`-th tile against one tree, after what was hit before.

    view: (12,) float64, rows x w, y w and distance of a point: pixel (c, r) sees along x = c, y = r.
    lens: (w0, w1) with w = w0 + w1 distance, and the nearest and farthest distance that counts.
    place: the tree's first face, and the first and last column and row of tiles it may be seen in;
    nearest_box: no point of it is nearer.
    distance (H, W) float32, inf where nothing was hit, face (H, W) int32; counts (4,) int64.
    """
    nodes, children, leaves, numbers = tree.nodes, tree.children, tree.leaves, tree.numbers
    w0, w1, least, most = lens
    first_face, left, right, top, bottom = place
    near, far = np.float32(least), np.float32(most)
    w0_, w1_ = np.float32(w0), np.float32(w1)
    least_w = w0_ + w1_ * near
    height, width = distance.shape
    keys, items = on_stack(np.float32, STACK), on_stack(np.int32, STACK)
    ranges = on_stack(np.int32, STACK)
    nearest, pixels = on_stack(np.float32, LANES), on_stack(np.int32, LANES)
    over, under = on_stack(np.float64, LANES), on_stack(np.float64, LANES)
    corner = on_stack(np.float64, COORDINATES)
    hits = on_stack(np.float32, LANES)
    ray_x, ray_y = on_stack(np.int32, PAIRS), on_stack(np.int32, PAIRS)
    owner, allowed = on_stack(np.int32, PAIRS), on_stack(np.int32, PAIRS)
    few_ax, few_ay, few_ad = (
        on_stack(np.float64, PAIRS),
        on_stack(np.float64, PAIRS),
        on_stack(np.float64, PAIRS),
    )
    few_bx, few_by, few_bd = (
        on_stack(np.float64, PAIRS),
        on_stack(np.float64, PAIRS),
        on_stack(np.float64, PAIRS),
    )
    few_cx, few_cy, few_cd = (
        on_stack(np.float64, PAIRS),
        on_stack(np.float64, PAIRS),
        on_stack(np.float64, PAIRS),
    )
    own_distance = on_stack(np.float32, ROOM)
    own_face = on_stack(np.int32, ROOM)
    row, size, pad = on_stack(np.float32, 12), on_stack(np.float32, 12), on_stack(np.float32, 3)
    for tile in range((right - left + 1) * (bottom - top + 1)):
        tile_x, tile_y = left + tile % (right - left + 1), top + tile // (right - left + 1)
        if (tile_x + tile_y) % parts != part:
            continue
        x_begin, y_begin = tile_x * TILE, tile_y * TILE
        columns, rows = min(TILE, width - x_begin), min(TILE, height - y_begin)
        changed = False
        take_tile(x_begin, y_begin, columns, rows, distance, face, own_distance, own_face)
        middle_x, middle_y = x_begin + (TILE - 1) / 2, y_begin + (TILE - 1) / 2
        aim(tree, view, w0, w1, middle_x, middle_y, row, size, pad)
        keys[0], items[0] = max(near, np.float32(nearest_box)), 0
        ranges[0], waiting = np.int32((columns - 1) << 8 | (rows - 1) << 24), 1
        while waiting > 0:
            waiting -= 1
            key, item, packed = keys[waiting], items[waiting], ranges[waiting]
            x0, x1, y0, y1 = packed & 255, (packed >> 8) & 255, (packed >> 16) & 255, (packed >> 24) & 255
            opened = False
            for y in range(y0, y1 + 1):
                for x in range(x0, x1 + 1):
                    opened |= own_distance[y * ROOM_ACROSS + x] >= key
                if opened:
                    break
            if not opened:
                continue
            if item >= 0:
                counts[NODES] += 1
                # All children at once: the nearest distance, and the range of pixels
                for j in range(LANES):
                    mx, my, mz = (
                        nodes[item, MIDDLE, j],
                        nodes[item, MIDDLE + 1, j],
                        nodes[item, MIDDLE + 2, j],
                    )
                    ex, ey, ez = (
                        nodes[item, EXTENT, j],
                        nodes[item, EXTENT + 1, j],
                        nodes[item, EXTENT + 2, j],
                    )
                    d = row[11] + row[8] * mx + row[9] * my + row[10] * mz
                    e = pad[2] + size[8] * ex + size[9] * ey + size[10] * ez
                    nearest[j] = max(d - e, near)
                    none = (d + e < near) | (d - e > far) | (children[item, CHILD, j] == NO_CHILD)
                    per_near = ONE / max(w0_ + w1_ * (d - e), least_w)
                    per_far = ONE / max(w0_ + w1_ * (d + e), least_w)
                    m = row[3] + row[0] * mx + row[1] * my + row[2] * mz
                    e = pad[0] + size[0] * ex + size[1] * ey + size[2] * ez
                    a, b = pixels_between(m - e, m + e, per_near, per_far, x0, x1)
                    m = row[7] + row[4] * mx + row[5] * my + row[6] * mz
                    e = pad[1] + size[4] * ex + size[5] * ey + size[6] * ez
                    c, f = pixels_between(m - e, m + e, per_near, per_far, y0, y1)
                    none = none | (a > b) | (c > f)
                    pixels[j] = NOWHERE if none else np.int32(a | b << 8 | c << 16 | f << 24)
                # On the stack the nearest lies on top
                base = waiting
                for j in range(LANES):
                    if pixels[j] == NOWHERE:
                        continue
                    at = waiting
                    while at > base and keys[at - 1] < nearest[j]:
                        keys[at], items[at], ranges[at] = keys[at - 1], items[at - 1], ranges[at - 1]
                        at -= 1
                    keys[at], items[at], ranges[at] = nearest[j], children[item, CHILD, j], pixels[j]
                    fetch_child(nodes.ctypes.data, leaves.ctypes.data, children[item, CHILD, j])
                    waiting += 1
                continue
            leaf, counts[LEAVES] = ~item, counts[LEAVES] + 1
            for j in range(LANES):
                x_low, x_high, y_low, y_high, d_low = INFINITE, -INFINITE, INFINITE, -INFINITE, INFINITE
                for v in range(3):
                    at = CORNERS + 3 * v
                    px, py = np.float64(leaves[leaf, at, j]), np.float64(leaves[leaf, at + 1, j])
                    pz = np.float64(leaves[leaf, at + 2, j])
                    xw = view[0] * px + view[1] * py + view[2] * pz + view[3]
                    yw = view[4] * px + view[5] * py + view[6] * pz + view[7]
                    d = view[8] * px + view[9] * py + view[10] * pz + view[11]
                    corner[(3 * v) * LANES + j], corner[(3 * v + 1) * LANES + j] = xw, yw
                    corner[(3 * v + 2) * LANES + j] = d
                    w = w0 + w1 * d
                    x_ = np.float32(xw - middle_x * w) * (ONE / np.float32(w))
                    y_ = np.float32(yw - middle_y * w) * (ONE / np.float32(w))
                    x_low, x_high = min(x_low, x_), max(x_high, x_)
                    y_low, y_high = min(y_low, y_), max(y_high, y_)
                    d_low = min(d_low, np.float32(d))
                a, b = max(first_pixel(x_low), x0), min(last_pixel(x_high), x1)
                c, f = max(first_pixel(y_low), y0), min(last_pixel(y_high), y1)
                own = np.int32(a | b << 8 | c << 16 | f << 24)
                # One that begins before the near plane may be anywhere
                pixels[j] = packed if d_low < near else (NOWHERE if (a > b) | (c > f) else own)
            few = 0
            for j in range(LANES):
                number, packed = first_face + numbers[leaf, NUMBER, j], pixels[j]
                shown = sides[min(number, sides.shape[0] - 1)] if number >= first_face else np.uint8(0)
                if (packed == NOWHERE) | (shown == 0):
                    continue
                counts[FACES] += 1
                a, b, c, f = packed & 255, (packed >> 8) & 255, (packed >> 16) & 255, (packed >> 24) & 255
                count = (b - a + 1) * (f - c + 1)
                counts[TESTS] += count
                ax, ay, ad = corner[j], corner[LANES + j], corner[2 * LANES + j]
                bx, by, bd = corner[3 * LANES + j], corner[4 * LANES + j], corner[5 * LANES + j]
                cx, cy, cd = corner[6 * LANES + j], corner[7 * LANES + j], corner[8 * LANES + j]
                if count <= FEW:
                    for y in range(c, f + 1):
                        for x in range(a, b + 1):
                            ray_x[few], ray_y[few], owner[few], allowed[few] = x, y, number, shown
                            few_ax[few], few_ay[few], few_ad[few] = ax, ay, ad
                            few_bx[few], few_by[few], few_bd[few] = bx, by, bd
                            few_cx[few], few_cy[few], few_cd[few] = cx, cy, cd
                            few += 1
                    continue
                aw, bw, cw = w0 + w1 * ad, w0 + w1 * bd, w0 + w1 * cd
                for y in range(c, f + 1, DOWN):
                    for x in range(a, b + 1, ACROSS):
                        mask, doubt = np.int32(0), np.int32(0)
                        for k in range(LANES):
                            p, q = np.float64(x_begin + x + (k & 3)), np.float64(y_begin + y + (k >> 2))
                            u, v, w, unsure = crosses(
                                ax - p * aw, ay - q * aw, bx - p * bw, by - q * bw, cx - p * cw, cy - q * cw
                            )
                            over[k], under[k] = u * ad + v * bd + w * cd, u + v + w
                            kept = counts_for(side_shown(u, v, w), shown)
                            mask = np.int32(mask | (np.int32(1) << k if kept else np.int32(0)))
                            doubt = np.int32(doubt | (np.int32(1) << k if unsure else np.int32(0)))
                        while doubt != 0:
                            k = trailing_zeros(doubt)
                            doubt = np.int32(doubt & (doubt - 1))
                            p, q = np.float64(x_begin + x + (k & 3)), np.float64(y_begin + y + (k >> 2))
                            u, v, w = exact_crosses(
                                ax - p * aw, ay - q * aw, bx - p * bw, by - q * bw, cx - p * cw, cy - q * cw
                            )
                            over[k], under[k] = u * ad + v * bd + w * cd, u + v + w
                            kept = counts_for(side_shown(u, v, w), shown)
                            bit = np.int32(1 << k)
                            mask = np.int32(mask | bit if kept else mask & ~bit)
                        if mask == 0:
                            continue
                        for k in range(LANES):
                            hits[k] = np.float32(over[k] / under[k])
                        while mask != 0:
                            k = trailing_zeros(mask)
                            mask = np.int32(mask & (mask - 1))
                            d, at = hits[k], (y + (k >> 2)) * ROOM_ACROSS + x + (k & 3)
                            if (d < near) | (np.float64(d) >= most):
                                continue
                            nearer = d < own_distance[at]
                            if nearer | ((d == own_distance[at]) & (number < own_face[at])):
                                own_distance[at], own_face[at], changed = d, number, True
            # Small faces, eight pairs of a face and a ray at a time
            for first in range(0, few, LANES):
                mask, doubt = np.int32(0), np.int32(0)
                for k in range(LANES):
                    at = np.uint64(first + k)
                    p, q = np.float64(x_begin + ray_x[at]), np.float64(y_begin + ray_y[at])
                    ax, ay, ad = few_ax[at], few_ay[at], few_ad[at]
                    bx, by, bd = few_bx[at], few_by[at], few_bd[at]
                    cx, cy, cd = few_cx[at], few_cy[at], few_cd[at]
                    aw, bw, cw = w0 + w1 * ad, w0 + w1 * bd, w0 + w1 * cd
                    u, v, w, unsure = crosses(
                        ax - p * aw, ay - q * aw, bx - p * bw, by - q * bw, cx - p * cw, cy - q * cw
                    )
                    over[k], under[k] = u * ad + v * bd + w * cd, u + v + w
                    kept = counts_for(side_shown(u, v, w), allowed[at])
                    mask = np.int32(mask | (np.int32(1) << k if kept else np.int32(0)))
                    doubt = np.int32(doubt | (np.int32(1) << k if unsure else np.int32(0)))
                # What stands after the last pair is not one
                real = EVERY >> max(first + LANES - few, 0)
                doubt, mask = np.int32(doubt & real), np.int32(mask & real)
                while doubt != 0:
                    k = trailing_zeros(doubt)
                    doubt = np.int32(doubt & (doubt - 1))
                    at = np.uint64(first + k)
                    p, q = np.float64(x_begin + ray_x[at]), np.float64(y_begin + ray_y[at])
                    ax, ay, ad = few_ax[at], few_ay[at], few_ad[at]
                    bx, by, bd = few_bx[at], few_by[at], few_bd[at]
                    cx, cy, cd = few_cx[at], few_cy[at], few_cd[at]
                    aw, bw, cw = w0 + w1 * ad, w0 + w1 * bd, w0 + w1 * cd
                    u, v, w = exact_crosses(
                        ax - p * aw, ay - q * aw, bx - p * bw, by - q * bw, cx - p * cw, cy - q * cw
                    )
                    over[k], under[k] = u * ad + v * bd + w * cd, u + v + w
                    kept = counts_for(side_shown(u, v, w), allowed[at])
                    bit = np.int32(1 << k)
                    mask = np.int32(mask | bit if kept else mask & ~bit)
                if mask == 0:
                    continue
                for k in range(LANES):
                    hits[k] = np.float32(over[k] / under[k])
                while mask != 0:
                    k = trailing_zeros(mask)
                    mask = np.int32(mask & (mask - 1))
                    d, number = hits[k], owner[first + k]
                    own = ray_y[first + k] * ROOM_ACROSS + ray_x[first + k]
                    if (d < near) | (np.float64(d) >= most):
                        continue
                    nearer = d < own_distance[own]
                    if nearer | ((d == own_distance[own]) & (number < own_face[own])):
                        own_distance[own], own_face[own], changed = d, number, True
        if not changed:
            continue
        for y in range(rows):
            for x in range(columns):
                at = np.uint64(y * ROOM_ACROSS + x)
                distance[np.uint64(y_begin + y), np.uint64(x_begin + x)] = own_distance[at]
                face[np.uint64(y_begin + y), np.uint64(x_begin + x)] = own_face[at]
