"""What a node of an octree can cover, before any of its faces is looked at; and which faces must be cut."""

from __future__ import annotations

import numpy as np

from eyeline.geometry.fixedpoint import BEFORE_CENTRE, CENTRE, greatest_depth
from eyeline.geometry.octree import BEGIN, CHILD, CHILDREN, END, LEAF, LEAST, POINT, POINTS, WIDTH
from eyeline.jit import helper, kernel
from eyeline.projection.boxes import box_on_grid, is_out_of_view
from eyeline.projection.vertices import placed
from eyeline.visibility.octree.pyramid import NEAREST, key_of

DEEP = 512  # nodes that wait at most: seven on each level, of octants and of faces dealt out in their order
CULLED = -1  # the key of what cannot be seen


@helper
def matrix_of(matrices, k):
    """A standing's matrix as scalars."""
    return (
        matrices[k, 0], matrices[k, 1], matrices[k, 2], matrices[k, 3],
        matrices[k, 4], matrices[k, 5], matrices[k, 6], matrices[k, 7],
        matrices[k, 8], matrices[k, 9], matrices[k, 10], matrices[k, 11],
        matrices[k, 12], matrices[k, 13], matrices[k, 14], matrices[k, 15],
    )  # fmt: skip


@helper
def box_of(boxes, node):
    """A node's box as scalars."""
    at = 6 * np.int64(node)
    return boxes[at], boxes[at + 1], boxes[at + 2], boxes[at + 3], boxes[at + 4], boxes[at + 5]


@helper
def outlook(on_grid, m, box, number, picture):
    """(key, left, top, right, bottom): a node's greatest key, and the pixels it can cover, borders inside.

    number: the least of its faces. picture: width, height, shift x, shift y. The key is CULLED where nothing
    can be seen, and NEAREST where vertices may lie behind the near plane or beyond the guard band.
    """
    width, height, dx, dy = picture
    if on_grid:
        sure, far, near = True, box[2], box[5]
        left, top, right, bottom = np.int64(box[0]), np.int64(box[1]), np.int64(box[3]), np.int64(box[4])
    else:
        across, down = np.float32(width * CENTRE), np.float32(height * CENTRE)
        sure, left, top, right, bottom, far, near = box_on_grid(m, across, down, box)
    if not sure:
        key = CULLED if is_out_of_view(m, width, height, box) else np.int64(NEAREST)
        return key, np.int64(0), np.int64(0), np.int64(width - 1), np.int64(height - 1)
    depth = greatest_depth(far, near, right - left, bottom - top)
    key = key_of(depth, number) if depth > 0 else np.int64(CULLED)
    left, right = max((left - dx + BEFORE_CENTRE) >> 8, 0), min((right - dx + BEFORE_CENTRE) >> 8, width) - 1
    top, bottom = max((top - dy + BEFORE_CENTRE) >> 8, 0), min((bottom - dy + BEFORE_CENTRE) >> 8, height) - 1
    return (key if left <= right and top <= bottom else np.int64(CULLED)), left, top, right, bottom


@kernel
def survey(forest, standings, nodes, picture, found):
    """The outlooks of nodes, each of one of the standings: found (N, 5)."""
    for i in range(nodes.shape[0]):
        k, node = standings[i], nodes[i]
        number = forest.nodes[node * WIDTH + LEAST] + forest.firsts[k]
        m = matrix_of(forest.matrices, k)
        found[i, 0], found[i, 1], found[i, 2], found[i, 3], found[i, 4] = outlook(
            forest.on_grid, m, box_of(forest.boxes, node), number, picture
        )


@helper
def place_leaf(forest, node, m, picture, spots, depths):
    """Place a leaf's vertices: spots x, y in turn, and depths."""
    width, height, dx, dy = picture
    begin, end = forest.nodes[node * WIDTH + POINT], forest.nodes[node * WIDTH + POINTS]
    points = forest.points[3 * np.int64(begin) : 3 * np.int64(end)]
    across, down = np.float32(width * CENTRE), np.float32(height * CENTRE)
    for i in range(end - begin):
        x, y, z = points[3 * i], points[3 * i + 1], points[3 * i + 2]
        if forest.on_grid:
            column, row, depth = np.int32(x), np.int32(y), z
        else:
            column, row, depth = placed(m, across, down, x, y, z)
        spots[2 * i], spots[2 * i + 1] = np.int32(column - dx), np.int32(row - dy)
        depths[i] = depth


@kernel
def crossing(forest, picture, found):
    """List (standing, row) of the faces that near plane or guard band cut in view; how many there are."""
    stack = np.empty(DEEP, np.int64)
    spots, depths = np.empty(9 * LEAF, np.int32), np.empty(3 * LEAF, np.float32)
    count = 0
    for k in range(forest.roots.shape[0]):
        m = matrix_of(forest.matrices, k)
        stack[0], waiting = forest.roots[k], 1
        while waiting > 0:
            waiting -= 1
            node = stack[waiting]
            if outlook(forest.on_grid, m, box_of(forest.boxes, node), 0, picture)[0] != NEAREST:
                continue
            children = forest.nodes[node * WIDTH + CHILDREN]
            for child in range(children):
                stack[waiting] = forest.nodes[node * WIDTH + CHILD] + child
                waiting += 1
            if children > 0:
                continue
            place_leaf(forest, node, m, picture, spots, depths)
            for slot in range(forest.nodes[node * WIDTH + BEGIN], forest.nodes[node * WIDTH + END]):
                z0, z1, z2 = (
                    depths[forest.corners[3 * slot]],
                    depths[forest.corners[3 * slot + 1]],
                    depths[forest.corners[3 * slot + 2]],
                )
                low, high = min(z0, z1, z2), max(z0, z1, z2)
                side = forest.sides[forest.sides_at[k, 0] + forest.sides_at[k, 1] * slot]
                if side == 0 or low == np.inf or (low > -np.inf and high < np.inf):
                    continue
                if count < found.shape[0]:
                    found[count, 0], found[count, 1] = k, forest.numbers[slot]
                count += 1
    return count
