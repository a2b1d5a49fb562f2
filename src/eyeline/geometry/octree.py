"""Octrees over faces: nodes as tight as what they hold, leaves whose vertices stand together. [Greene93]

A face belongs to the octant that holds its middle, and a node's box reaches around all of its faces, so that
none is cut and none stands twice. Faces are sorted along Morton's curve, where every node is a range of them.
[Morton66]
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from eyeline.geometry.arrays import ByteArray, FloatArray, IntArray, read_only
from eyeline.jit import helper, kernel

LEAF = 64  # faces in a leaf at most: their vertices, 192 at most, are numbered by bytes
LEVELS = 10  # of octants; faces that share one of the last are dealt out in their order
DIGIT = 10  # bits of a code that are sorted at once; three times that is a code
# The columns of a node
CHILD, CHILDREN, BEGIN, END, LEAST, POINT, POINTS, WIDTH = range(8)


class Octree(NamedTuple):
    """N nodes over F faces; parents come before their children, and node 0 is the root."""

    boxes: FloatArray  # (N, 6) float32: low x y z, high x y z of the vertices below
    nodes: IntArray  # (N, WIDTH) int32: first child and how many; its faces; their least number; its vertices
    points: FloatArray  # (P, 3) float32: the vertices of every leaf, leaf after leaf
    corners: ByteArray  # (F, 3) which of its leaf's vertices a face's are
    rows: IntArray  # (F,) int32: which of the faces given stands here
    numbers: IntArray  # (F,) int32: its number


def octree_of(
    points: FloatArray, faces: IntArray, numbers: IntArray | None = None, cubic: bool = True
) -> Octree:
    """The octree over faces (F, 3) of points (V, 3) float32, all of them finite.

    numbers: (F,) what the faces are called; their rows if left out. cubic: octants are cubes; otherwise they
    have the proportions of the whole, for points whose axes measure different things.
    """
    count = len(faces)
    if count == 0:
        return Octree(
            np.empty((0, 6), np.float32), np.empty((0, WIDTH), np.int32), np.empty((0, 3), np.float32),
            np.empty((0, 3), np.uint8), np.empty(0, np.int32), np.empty(0, np.int32),
        )  # fmt: skip
    flat, corners = read_only(points).reshape(-1), read_only(faces).reshape(-1)
    unsorted, unsorted_rows, codes, rows = (np.empty(count, np.int32) for _ in range(4))
    _encode(flat, corners, cubic, unsorted)
    _sort(unsorted, unsorted_rows, codes, rows, np.zeros((3, 1 << DIGIT), np.int64))
    named = rows if numbers is None else numbers[rows].astype(np.int32)
    # What is never touched of so much room takes no memory
    nodes = np.empty((2 * count, WIDTH), np.int32)
    nodes = nodes[: _divide(codes, nodes)].copy()
    boxes, local = np.empty((len(nodes), 6), np.float32), np.empty((count, 3), np.uint8)
    packed = np.empty((3 * count, 3), np.float32)
    seen, place = np.full(len(points), -1, np.int32), np.empty(len(points), np.uint8)
    used = _pack(flat, corners, rows, named, nodes, boxes, local, packed, seen, place)
    return Octree(boxes, nodes, packed[:used].copy(), local, rows, named)


def joined(trees: list[Octree]) -> tuple[Octree, IntArray]:
    """All trees in one, and the root of each, -1 for an empty one."""
    sizes = np.array([(len(tree.nodes), len(tree.rows), len(tree.points)) for tree in trees]).reshape(-1, 3)
    first = np.cumsum(sizes, axis=0) - sizes
    roots = np.where(sizes[:, 0] > 0, first[:, 0], -1).astype(np.int32)
    if len(trees) == 1:
        return trees[0], roots
    moved = []
    for tree, (node, face, point) in zip(trees, first, strict=True):
        columns = np.zeros(WIDTH, np.int32)
        columns[[CHILD, BEGIN, END, POINT, POINTS]] = node, face, face, point, point
        moved.append(tree._replace(nodes=tree.nodes + columns))
    return Octree(*(np.concatenate(parts) for parts in zip(*moved, strict=True))), roots


@helper
def spread(number):
    """The lowest ten bits, two zeros between each."""
    number = (number | (number << 16)) & 0x030000FF
    number = (number | (number << 8)) & 0x0300F00F
    number = (number | (number << 4)) & 0x030C30C3
    return (number | (number << 2)) & 0x09249249


@kernel
def _encode(points, faces, cubic, codes):
    """Morton's code of the middle of every face."""
    lx = ly = lz = np.float32(np.inf)
    hx = hy = hz = np.float32(-np.inf)
    for corner in faces:
        at = 3 * np.int64(corner)
        x, y, z = points[at], points[at + 1], points[at + 2]
        lx, ly, lz, hx, hy, hz = min(lx, x), min(ly, y), min(lz, z), max(hx, x), max(hy, y), max(hz, z)
    across = np.float64(hx) - np.float64(lx)
    down, deep = np.float64(hy) - np.float64(ly), np.float64(hz) - np.float64(lz)
    if cubic:
        across = down = deep = max(across, down, deep)
    cells = np.float64(1 << LEVELS)
    sx = cells / across if across > 0 else 0.0
    sy = cells / down if down > 0 else 0.0
    sz = cells / deep if deep > 0 else 0.0
    for face in range(codes.shape[0]):
        a, b, c = (
            3 * np.int64(faces[3 * face]),
            3 * np.int64(faces[3 * face + 1]),
            3 * np.int64(faces[3 * face + 2]),
        )
        x = np.float64(points[a]) + np.float64(points[b]) + np.float64(points[c])
        y = np.float64(points[a + 1]) + np.float64(points[b + 1]) + np.float64(points[c + 1])
        z = np.float64(points[a + 2]) + np.float64(points[b + 2]) + np.float64(points[c + 2])
        column = np.int64(min(max((x / 3.0 - lx) * sx, 0.0), cells - 1.0))
        row = np.int64(min(max((y / 3.0 - ly) * sy, 0.0), cells - 1.0))
        layer = np.int64(min(max((z / 3.0 - lz) * sz, 0.0), cells - 1.0))
        codes[face] = (spread(layer) << 2) | (spread(row) << 1) | spread(column)


@kernel
def _sort(codes, rows, other_codes, other_rows, starts):
    """Sort the codes into the other arrays, with where each stood; equal ones stay in order.

    starts: (3, 1 << DIGIT) int64 zeros, to count in.
    """
    for i in range(codes.shape[0]):
        rows[i] = i
        for turn in range(3):
            starts[turn, (codes[i] >> (DIGIT * turn)) & ((1 << DIGIT) - 1)] += 1
    for turn in range(3):
        total = 0
        for k in range(1 << DIGIT):
            own = starts[turn, k]
            starts[turn, k] = total
            total += own
    deal(codes, rows, other_codes, other_rows, 0, starts[0])
    deal(other_codes, other_rows, codes, rows, DIGIT, starts[1])
    deal(codes, rows, other_codes, other_rows, 2 * DIGIT, starts[2])


@helper
def deal(codes, rows, sorted_codes, sorted_rows, shift, starts):
    """Move every code to the next place of its digit."""
    for i in range(codes.shape[0]):
        digit = (codes[i] >> shift) & ((1 << DIGIT) - 1)
        at = starts[digit]
        sorted_codes[at], sorted_rows[at] = codes[i], rows[i]
        starts[digit] = at + 1


@kernel
def _divide(codes, nodes):
    """Divide ranges of sorted codes until none is longer than a leaf; how many nodes that makes."""
    levels = np.empty(nodes.shape[0], np.int8)
    nodes[0, BEGIN], nodes[0, END], levels[0] = 0, codes.shape[0], 0
    made, node = 1, 0
    while node < made:
        begin, end, level = nodes[node, BEGIN], nodes[node, END], levels[node]
        nodes[node, CHILD], nodes[node, CHILDREN] = made, 0
        if end - begin > LEAF:
            # Down to the level where the codes differ
            shift = 3 * (LEVELS - 1 - level)
            while shift >= 0 and (codes[begin] >> shift) == (codes[end - 1] >> shift):
                shift -= 3
                level += 1
            part = max(LEAF, (end - begin + 7) >> 3)
            at = begin
            while at < end:
                if shift < 0:
                    stop = min(at + part, end)
                else:
                    # One octant, and those after it that fit into the same leaf
                    stop = octant_end(codes, at, end, shift)
                    while stop < end:
                        after = octant_end(codes, stop, end, shift)
                        if after - at > LEAF:
                            break
                        stop = after
                nodes[made, BEGIN], nodes[made, END], levels[made] = at, stop, min(level + 1, LEVELS)
                made += 1
                at = stop
            nodes[node, CHILDREN] = made - nodes[node, CHILD]
        node += 1
    return made


@helper
def octant_end(codes, begin, end, shift):
    """Where the codes begin that have other digits than the first, down to this one."""
    digits = codes[begin] >> shift
    low, high = begin, end
    while high - low > 1:
        middle = (low + high) >> 1
        if (codes[middle] >> shift) == digits:
            low = middle
        else:
            high = middle
    return high


@kernel
def _pack(points, faces, rows, numbers, nodes, boxes, local, packed, seen, place):
    """Gather the vertices of every leaf, then the boxes and least numbers from the leaves up."""
    used = 0
    for node in range(nodes.shape[0]):
        nodes[node, POINT] = nodes[node, POINTS] = 0
        if nodes[node, CHILDREN] > 0:
            continue
        first = used
        for slot in range(nodes[node, BEGIN], nodes[node, END]):
            for k in range(3):
                vertex = faces[3 * np.int64(rows[slot]) + k]
                if seen[vertex] != node:
                    seen[vertex], place[vertex] = node, used - first
                    for axis in range(3):
                        packed[used, axis] = points[3 * np.int64(vertex) + axis]
                    used += 1
                local[slot, k] = place[vertex]
        nodes[node, POINT], nodes[node, POINTS] = first, used
    for node in range(nodes.shape[0] - 1, -1, -1):
        least = np.int32(0x7FFFFFFF)
        for axis in range(3):
            low, high = np.float32(np.inf), np.float32(-np.inf)
            for point in range(nodes[node, POINT], nodes[node, POINTS]):
                low, high = min(low, packed[point, axis]), max(high, packed[point, axis])
            for k in range(nodes[node, CHILDREN]):
                child = nodes[node, CHILD] + k
                low, high = min(low, boxes[child, axis]), max(high, boxes[child, 3 + axis])
            boxes[node, axis], boxes[node, 3 + axis] = low, high
        if nodes[node, CHILDREN] == 0:
            for slot in range(nodes[node, BEGIN], nodes[node, END]):
                least = min(least, numbers[slot])
        for k in range(nodes[node, CHILDREN]):
            least = min(least, nodes[nodes[node, CHILD] + k, LEAST])
        nodes[node, LEAST] = least
    return used
