"""Octrees walked from front to back, tile after tile, each node against the pyramid of what stands before it.

Tiles are the same for any number of threads, and each is walked by itself: so are answer and counters.
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.fixedpoint import (
    BEFORE_CENTRE,
    CENTRE,
    UNITS,
    depth_at,
    depth_plane,
    edge_bias,
    signed_area,
)
from eyeline.geometry.octree import BEGIN, CHILD, CHILDREN, END, LEAF, LEAST, WIDTH
from eyeline.jit import helper, kernel
from eyeline.visibility.octree.outlook import DEEP, box_of, matrix_of, outlook, place_leaf
from eyeline.visibility.octree.pyramid import CELLS, NEAREST, TILE, TILE_BITS, hides, key_of, refresh

WIDE = 8  # pixels of a row from which it is drawn without branches
UNIT_BITS = 8  # UNITS = 1 << UNIT_BITS
VISITED, HIDDEN, DRAWN, TESTS, COUNTERS = range(5)


@kernel
def walk_tiles(part, parts, picture, grid, meshes, depth_bits, face, work):
    """Fill tiles part, part + parts, ... of depth_bits (depth as int32) and face, both flat.

    grid, meshes: a Grove each, the same for all tiles. work: (COUNTERS,) is added to.
    """
    width, height = picture[0], picture[1]
    columns, rows = (width + TILE - 1) >> TILE_BITS, (height + TILE - 1) >> TILE_BITS
    keys, pyramid = np.empty(TILE * TILE, np.int64), np.empty(CELLS, np.int64)
    stack, spots = np.empty((DEEP, 6), np.int64), np.empty(9 * LEAF, np.int32)
    depths = np.empty(3 * LEAF, np.float32)
    for tile in range(part, columns * rows, parts):
        left, top = (tile % columns) << TILE_BITS, (tile // columns) << TILE_BITS
        right, bottom = min(left + TILE, width), min(top + TILE, height)
        clear(keys, pyramid, right - left, bottom - top)
        at = (left, top, right - 1, bottom - 1)
        for grove in (grid, meshes):
            walk(grove, picture, at, keys, pyramid, stack, spots, depths, work)
        for y in range(top, bottom):
            begin, row = y * width + left, (y - top) << TILE_BITS
            end = begin + right - left
            finish(keys[row : row + TILE], depth_bits[begin:end], face[begin:end])


@helper
def clear(keys, pyramid, width, height):
    """Nothing in the picture's part of a tile; beside it what nothing hides."""
    keys[:] = 0
    pyramid[:] = 0
    if width == TILE and height == TILE:
        return
    for y in range(TILE):
        keys[(y << TILE_BITS) + (width if y < height else 0) : (y + 1) << TILE_BITS] = NEAREST
    refresh(pyramid, keys, 0, 0, TILE - 1, TILE - 1)


@helper
def finish(keys, depth_bits, face):
    """Split keys into depth and face; a key of depth 0 is nothing, as far as the back."""
    for i in range(face.shape[0]):
        bits = np.int32(keys[i] >> 32)
        depth_bits[i] = bits
        face[i] = ~np.int32(keys[i]) if bits != 0 else np.int32(-1)


@helper
def walk(grove, picture, tile, keys, pyramid, stack, spots, depths, work):
    """Walk a grove in one tile (left, top, right, bottom): every start, below it from front to back."""
    forest = grove.forest
    left, top, right, bottom = tile
    count = forest.nodes.shape[0] // WIDTH
    for start in range(grove.starts.shape[0]):
        for column in range(6):
            stack[0, column] = grove.starts[start, column]
        if stack[0, 1] > right or stack[0, 3] < left or stack[0, 2] > bottom or stack[0, 4] < top:
            continue
        k = grove.starts[start, 6]
        m, first = matrix_of(forest.matrices, k), forest.firsts[k]
        waiting = 1
        while waiting > 0:
            waiting -= 1
            key, node = stack[waiting, 0], stack[waiting, 5]
            x0, y0 = max(stack[waiting, 1], left) - left, max(stack[waiting, 2], top) - top
            x1, y1 = min(stack[waiting, 3], right) - left, min(stack[waiting, 4], bottom) - top
            work[VISITED] += 1
            if hides(pyramid, keys, key, x0, y0, x1, y1):
                work[HIDDEN] += 1
                continue
            children = forest.nodes[node * WIDTH + CHILDREN]
            if children == 0:
                if start < grove.reminders or not holds(grove.recalled, k * count + node):
                    place_leaf(forest, node, m, picture, spots, depths)
                    draw_leaf(forest, k, node, first, tile, keys, spots, depths, work)
                    refresh(pyramid, keys, x0, y0, x1, y1)
                continue
            base, eldest = waiting, forest.nodes[node * WIDTH + CHILD]
            for child in range(eldest, eldest + children):
                number = forest.nodes[child * WIDTH + LEAST] + first
                own = outlook(forest.on_grid, m, box_of(forest.boxes, child), number, picture)
                if own[0] <= 0 or own[1] > right or own[3] < left or own[2] > bottom or own[4] < top:
                    continue
                # The nearest comes to lie on top, of equals the first
                spot = waiting
                while spot > base and stack[spot - 1, 0] >= own[0]:
                    for column in range(6):
                        stack[spot, column] = stack[spot - 1, column]
                    spot -= 1
                stack[spot, 0], stack[spot, 1], stack[spot, 2], stack[spot, 3], stack[spot, 4] = own
                stack[spot, 5] = child
                waiting += 1


@helper
def holds(numbers, number):
    """Whether a rising list holds a number."""
    low, high = 0, numbers.shape[0]
    while low < high:
        middle = (low + high) >> 1
        if numbers[middle] < number:
            low = middle + 1
        else:
            high = middle
    return low < numbers.shape[0] and numbers[low] == number


@helper
def draw_leaf(forest, standing, node, first, tile, keys, spots, depths, work):
    """Let a leaf's faces fall on a tile; those with a vertex that is not placed are drawn as their pieces."""
    left, top, right, bottom = tile
    side_at, side_step = forest.sides_at[standing, 0], forest.sides_at[standing, 1]
    for slot in range(forest.nodes[node * WIDTH + BEGIN], forest.nodes[node * WIDTH + END]):
        work[DRAWN] += 1
        i, j, k = (
            np.int64(forest.corners[3 * slot]),
            np.int64(forest.corners[3 * slot + 1]),
            np.int64(forest.corners[3 * slot + 2]),
        )
        ax, ay, bx, by = np.int64(spots[2 * i]), np.int64(spots[2 * i + 1]), spots[2 * j], spots[2 * j + 1]
        cx, cy = np.int64(spots[2 * k]), np.int64(spots[2 * k + 1])
        bx, by = np.int64(bx), np.int64(by)
        area = signed_area(ax, ay, bx, by, cx, cy)
        side = forest.sides[side_at + side_step * slot]
        if not ((area > 0 and side & 2) or (area < 0 and side & 1)):
            continue
        if area < 0:
            bx, by, cx, cy, j, k = cx, cy, bx, by, k, j
        x0, x1 = (min(ax, bx, cx) + BEFORE_CENTRE) >> 8, ((max(ax, bx, cx) + BEFORE_CENTRE) >> 8) - 1
        y0, y1 = (min(ay, by, cy) + BEFORE_CENTRE) >> 8, ((max(ay, by, cy) + BEFORE_CENTRE) >> 8) - 1
        x0, x1, y0, y1 = max(x0, left), min(x1, right), max(y0, top), min(y1, bottom)
        if x0 > x1 or y0 > y1:
            continue
        z0, z1, z2 = depths[i], depths[j], depths[k]
        if not (abs(z0) < np.inf and abs(z1) < np.inf and abs(z2) < np.inf):
            continue
        a, b, c = depth_plane(
            np.int32(ax), np.int32(ay), z0, np.int32(bx), np.int32(by), z1, np.int32(cx), np.int32(cy), z2
        )
        number = forest.numbers[slot] + first
        px, py = x0 * UNITS + CENTRE, y0 * UNITS + CENTRE
        e0, e1, e2 = (
            edge_at(ax, ay, bx, by, px, py),
            edge_at(bx, by, cx, cy, px, py),
            edge_at(cx, cy, ax, ay, px, py),
        )
        a0, a1, a2 = (ay - by) << UNIT_BITS, (by - cy) << UNIT_BITS, (cy - ay) << UNIT_BITS
        for y in range(y0, y1 + 1):
            row = ((y - top) << TILE_BITS) - left
            if x1 - x0 >= WIDE:
                work[TESTS] += draw_row(
                    keys[row + x0 : row + x1 + 1], (e0, e1, e2), (a0, a1, a2), (a, b, c), x0, y, number
                )
            else:
                f0, f1, f2 = e0, e1, e2
                for x in range(x0, x1 + 1):
                    if (f0 | f1 | f2) >= 0:
                        key = key_of(depth_at(a, b, c, np.int32(x), y), number)
                        keys[row + x] = max(keys[row + x], key)
                        work[TESTS] += 1
                    f0, f1, f2 = f0 + a0, f1 + a1, f2 + a2
            e0, e1, e2 = (
                e0 + ((bx - ax) << UNIT_BITS),
                e1 + ((cx - bx) << UNIT_BITS),
                e2 + ((ax - cx) << UNIT_BITS),
            )


@helper
def draw_row(keys, edges, steps, plane, first, y, number):
    """Let a face fall on a row from its pixel `first` on, without branches; how many pixels it covers."""
    e0, e1, e2 = edges
    a0, a1, a2 = steps
    a, b, c = plane
    pixels = 0
    for i in range(keys.shape[0]):
        inside = (e0 | e1 | e2) >= 0
        key = key_of(depth_at(a, b, c, np.int32(first + i), y), number)
        keys[i] = max(keys[i], key if inside else np.int64(0))
        pixels += inside
        e0, e1, e2 = e0 + a0, e1 + a1, e2 + a2
    return pixels


@helper
def edge_at(x0, y0, x1, y1, px, py):
    """The edge function of an edge that leads clockwise, with its bias: 0 or more is inside."""
    a, b = y0 - y1, x1 - x0
    return a * (px - x0) + b * (py - y0) + edge_bias(a, b)
