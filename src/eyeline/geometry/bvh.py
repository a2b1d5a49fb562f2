"""A bounding volume hierarchy: boxes around boxes around faces, eight to a node. [Rubin80]

Faces are sorted along a curve through space, a few next to each other make a leaf, leaves are joined two by
two, and the binary tree is folded into wide nodes at the least expected cost. Every step has one defined
result, so the tree is the same for every number of threads.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray, read_only
from eyeline.geometry.clustering import ROUNDS, SLOTS, clustered
from eyeline.geometry.morton import FULL, leaf_starts, sorted_keys
from eyeline.jit import fetch, helper, in_parts, kernel, on_stack, threads

# Rows of a node: middles and half extents of its children's boxes, and the children
MIDDLE, EXTENT, CHILD, NODE_ROWS = 0, 3, 6, 8
# Rows of a leaf: the faces' corners x y z x y z x y z, and their numbers
CORNERS, NUMBER, LEAF_ROWS = 0, 9, 10
NO_FACE, NO_CHILD = -1, 0  # the root is nobody's child
GROWTH = np.float32(1 + 2**-22)  # a box grows by its roundings
STACK = (ROUNDS + 31) * (SLOTS - 1) + 1  # waiting children of all levels: rounds that choose, then pairs
LINE = 16  # float32 in a line of the cache
LINE_BYTES, NODE_BYTES, LEAF_BYTES = 64, 4 * NODE_ROWS * SLOTS, 4 * LEAF_ROWS * SLOTS
FEW = 4096  # faces: fewer are not worth a second thread

ZERO, HALF, INFINITE = np.float32(0), np.float32(0.5), np.float32(np.inf)


class Bvh(NamedTuple):
    """The tree over F faces, for kernels; made by `bvh_of`, not to be written.

    `children` and `numbers` are the memory of `nodes` and `leaves` read as int32; only rows CHILD and NUMBER
    are whole numbers: a child is a node, or ~leaf, or NO_CHILD; a face that is not there is NO_FACE.
    """

    nodes: FloatArray  # (N, 8, 8) float32, N = 0 without faces; the root first, a parent before its children
    children: IntArray  # (N, 8, 8) int32
    leaves: FloatArray  # (L, 10, 8) float32
    numbers: IntArray  # (L, 10, 8) int32
    faces: IntArray  # (3 F,) int32
    low: FloatArray  # (3,) float64, of all
    high: FloatArray  # (3,) float64

    def refit(self, points: FloatArray) -> Bvh:
        """The same tree over moved points (V, 3): what an animated mesh needs from frame to frame.

        Its answers are those of a new tree; it is walked as quickly while neighbours stay neighbours.
        """
        if len(self.nodes) == 0:
            return self
        nodes, leaves = aligned(len(self.nodes), NODE_ROWS), aligned(len(self.leaves), LEAF_ROWS)
        children, numbers = nodes.view(np.int32), leaves.view(np.int32)
        children[:, CHILD], numbers[:, NUMBER] = self.children[:, CHILD], self.numbers[:, NUMBER]
        fitted = fill_leaf_boxes(points, self.faces, leaves, numbers)
        return finished(nodes, leaves, self.faces, fitted)


def bvh_of(points: FloatArray, faces: IntArray) -> Bvh:
    """The tree over faces (F, 3) of finite points (V, 3) float32."""
    flat, corners = read_only(points).reshape(-1), read_only(faces).reshape(-1)
    parts = parts_for(len(faces))
    if len(faces) == 0:
        return finished(aligned(0, NODE_ROWS), aligned(0, LEAF_ROWS), corners, np.zeros((6, 1), np.float32))
    keys, bits = sorted_keys(flat, corners, parts)
    starts = leaf_starts(keys, parts)
    leaves = aligned(len(starts) - 1, LEAF_ROWS)
    numbers = leaves.view(np.int32)
    in_parts(parts, number_leaves, keys, bits, starts, numbers)
    boxes = fill_leaf_boxes(points, corners, leaves, numbers)
    child, cost = clustered(in_unit_cube(boxes), parts)
    return finished(widened(child, cost, parts), leaves, corners, boxes)


def parts_for(count: int) -> int:
    """How many threads so many faces are worth."""
    return threads() if count > FEW else 1


def aligned(count: int, rows: int) -> FloatArray:
    """(count, rows, 8) float32, from the start of a line of the cache."""
    memory: FloatArray = np.empty(count * rows * SLOTS + LINE, np.float32)
    skip = -memory.ctypes.data // memory.itemsize % LINE
    return memory[skip : skip + count * rows * SLOTS].reshape(count, rows, SLOTS)


def fill_leaf_boxes(points: FloatArray, faces: IntArray, leaves: FloatArray, numbers: IntArray) -> FloatArray:
    """Copy the corners of numbered faces into their leaves; (6, L) float32, the box of each."""
    boxes = np.empty((6, len(leaves)), np.float32)
    flat, parts = read_only(points).reshape(-1), parts_for(len(faces) // 3)
    in_parts(parts, fill_leaves, flat, faces, numbers, leaves, boxes)
    return boxes


def in_unit_cube(boxes: FloatArray) -> FloatArray:
    """Boxes (6, L) moved and scaled to lie in 0..1, so that no area is too large or too small for float32."""
    low = boxes[:3].min(axis=1).astype(np.float64)
    longest = float((boxes[3:].max(axis=1) - low).max())
    scale = 1 / longest if longest > 0 else 0.0
    unit: FloatArray = ((boxes - np.tile(low, 2)[:, None]) * scale).astype(np.float32)
    return unit


def widened(child: IntArray, cost: FloatArray, parts: int) -> FloatArray:
    """Wide nodes with their children and no boxes yet, breadth first, from a binary tree and its costs."""
    leaves = len(child)
    nodes = aligned(max(1, leaves - 1), NODE_ROWS)
    children = nodes.view(np.int32)
    source, begin = np.array([2 * leaves - 2], np.int32), 0
    while len(source):
        end = begin + len(source)
        level, shared = children[begin:end], parts if len(source) > FEW // SLOTS else 1
        in_parts(shared, widen, source, child, cost, leaves, level)
        below = level[:, CHILD]
        inner = below >= leaves
        source, begin = below[inner], end
        level[:, CHILD] = np.where(below == NO_FACE, NO_CHILD, ~below)
        level[:, CHILD][inner] = np.arange(end, end + len(source))
    return nodes[:begin]


def finished(nodes: FloatArray, leaves: FloatArray, faces: IntArray, boxes: FloatArray) -> Bvh:
    """The tree, its nodes' boxes fitted around those of its leaves."""
    room = np.empty((len(nodes), 6), np.float32)
    fit_nodes(nodes, nodes.view(np.int32), boxes, room)
    low, high = boxes[:3].min(axis=1).astype(np.float64), boxes[3:].max(axis=1).astype(np.float64)
    nodes, leaves = read_only(nodes), read_only(leaves)
    return Bvh(
        nodes, nodes.view(np.int32), leaves, leaves.view(np.int32), faces, read_only(low), read_only(high)
    )


@helper
def fetch_child(nodes, leaves, child):
    """Ask for a child's memory, given where nodes and leaves begin, well before it is read."""
    row = np.int64(child)
    place = nodes + NODE_BYTES * row if row > 0 else leaves + LEAF_BYTES * ~row
    for line in range(0, LEAF_BYTES, LINE_BYTES):
        fetch(place + line)


@kernel
def number_leaves(part, parts, keys, bits, starts, numbers):
    """Write the numbers of the faces of each leaf."""
    mask = (np.uint64(1) << np.uint64(bits)) - np.uint64(1)
    count = starts.shape[0] - 1
    for leaf in range(count * part // parts, count * (part + 1) // parts):
        for slot in range(FULL):
            at = starts[leaf] + slot
            numbers[leaf, NUMBER, slot] = np.int32(keys[at] & mask) if at < starts[leaf + 1] else NO_FACE


@kernel
def fill_leaves(part, parts, points, faces, numbers, leaves, boxes):
    """Write corners; a slot without a face repeats the first, so that it needs no care in boxes."""
    count = leaves.shape[0]
    for leaf in range(count * part // parts, count * (part + 1) // parts):
        x0, y0, z0, x1, y1, z1 = INFINITE, INFINITE, INFINITE, -INFINITE, -INFINITE, -INFINITE
        for slot in range(FULL):
            number = numbers[leaf, NUMBER, slot]
            face = number if number >= 0 else numbers[leaf, NUMBER, 0]
            for corner in range(3):
                at = 3 * faces[3 * face + corner]
                x, y, z = points[at], points[at + 1], points[at + 2]
                leaves[leaf, 3 * corner, slot] = x
                leaves[leaf, 3 * corner + 1, slot] = y
                leaves[leaf, 3 * corner + 2, slot] = z
                x0, y0, z0 = min(x0, x), min(y0, y), min(z0, z)
                x1, y1, z1 = max(x1, x), max(y1, y), max(z1, z)
        boxes[0, leaf], boxes[1, leaf], boxes[2, leaf] = x0, y0, z0
        boxes[3, leaf], boxes[4, leaf], boxes[5, leaf] = x1, y1, z1


@kernel
def widen(part, parts, source, child, cost, leaves, children):
    """Write which binary nodes fill the slots of each wide node at the least cost. [Ylitie17]"""
    todo, slots = on_stack(np.int32, SLOTS), on_stack(np.int32, SLOTS)
    count = source.shape[0]
    for wide in range(count * part // parts, count * (part + 1) // parts):
        todo[0], slots[0], waiting, filled = source[wide], SLOTS, 1, 0
        while waiting > 0:
            waiting -= 1
            node, room = todo[waiting], slots[waiting]
            row = node - leaves + 1
            inner, root = node >= leaves, node == source[wide]
            while inner and not root and room > 1 and cost[row, room - 2] <= cost[row, room - 1]:
                room -= 1
            if inner and room > 1:
                a, b = child[node - leaves, 0], child[node - leaves, 1]
                row_a, row_b, best = max(a - leaves + 1, 0), max(b - leaves + 1, 0), 0
                for k in range(1, room - 1):
                    least = cost[row_a, best] + cost[row_b, room - 2 - best]
                    best = k if cost[row_a, k] + cost[row_b, room - 2 - k] < least else best
                todo[waiting], slots[waiting] = b, room - 1 - best
                todo[waiting + 1], slots[waiting + 1] = a, best + 1
                waiting += 2
            else:
                children[wide, CHILD, filled] = node
                filled += 1
        for slot in range(filled, SLOTS):
            children[wide, CHILD, slot] = NO_FACE


@kernel
def fit_nodes(nodes, children, boxes, room):
    """Write the boxes of all children, the last node first; room: (N, 6) for those of the nodes."""
    for node in range(nodes.shape[0] - 1, -1, -1):
        for k in range(3):
            room[node, k], room[node, k + 3] = INFINITE, -INFINITE
        for slot in range(SLOTS):
            child = children[node, CHILD, slot]
            nodes[node, CHILD + 1, slot] = ZERO
            for k in range(3):
                if child == NO_CHILD:
                    nodes[node, MIDDLE + k, slot], nodes[node, EXTENT + k, slot] = ZERO, ZERO
                    continue
                low = boxes[k, ~child] if child < 0 else room[child, k]
                high = boxes[k + 3, ~child] if child < 0 else room[child, k + 3]
                middle = low * HALF + high * HALF
                nodes[node, MIDDLE + k, slot] = middle
                nodes[node, EXTENT + k, slot] = max(high - middle, middle - low) * GROWTH
                room[node, k], room[node, k + 3] = min(room[node, k], low), max(room[node, k + 3], high)
