"""The nearest place on a surface: of one triangle, and of all of a tree's."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray, read_only
from eyeline.geometry.bvh import CHILD, EXTENT, MIDDLE, NO_CHILD, NUMBER, STACK, Bvh
from eyeline.geometry.clustering import SLOTS
from eyeline.jit import helper, in_parts, kernel, on_stack, threads

CHUNK = 256  # points that one thread takes at a time
NOTHING_MET = np.inf


class Nearest(NamedTuple):
    """Where on a surface each of K points is nearest to it."""

    face: IntArray  # (K,) int32; -1 where there is no surface
    distance: FloatArray  # (K,) float64 metres; inf where there is no surface


def nearest(tree: Bvh, points: FloatArray) -> Nearest:
    """The nearest face of a tree to each of points (K, 3), and how far it is; of equals the lowest number."""
    given = read_only(np.ascontiguousarray(points, np.float64))
    face, square = np.full(len(given), -1, np.int32), np.full(len(given), NOTHING_MET)
    if len(tree.nodes) and len(given):
        in_parts(threads() if len(given) > CHUNK else 1, find_nearest, tree, given, face, square)
    return Nearest(face, np.sqrt(square))


@helper
def place_on_triangle(px, py, pz, ax, ay, az, bx, by, bz, cx, cy, cz):
    """(q, r): the nearest place on a triangle is a + q (b - a) + r (c - a). [Ericson05, 5.1.5]

    A triangle without area is its edges.
    """
    ux, uy, uz, vx, vy, vz = bx - ax, by - ay, bz - az, cx - ax, cy - ay, cz - az
    d1 = ux * (px - ax) + uy * (py - ay) + uz * (pz - az)
    d2 = vx * (px - ax) + vy * (py - ay) + vz * (pz - az)
    if d1 <= 0.0 and d2 <= 0.0:
        return 0.0, 0.0
    d3 = ux * (px - bx) + uy * (py - by) + uz * (pz - bz)
    d4 = vx * (px - bx) + vy * (py - by) + vz * (pz - bz)
    if d3 >= 0.0 and d4 <= d3:
        return 1.0, 0.0
    over_c = d1 * d4 - d3 * d2
    if over_c <= 0.0 and d1 >= 0.0 and d3 <= 0.0:
        return d1 / (d1 - d3), 0.0
    d5 = ux * (px - cx) + uy * (py - cy) + uz * (pz - cz)
    d6 = vx * (px - cx) + vy * (py - cy) + vz * (pz - cz)
    if d6 >= 0.0 and d5 <= d6:
        return 0.0, 1.0
    over_b = d5 * d2 - d1 * d6
    if over_b <= 0.0 and d2 >= 0.0 and d6 <= 0.0:
        return 0.0, d2 / (d2 - d6)
    over_a = d3 * d6 - d5 * d4
    if over_a <= 0.0 and d4 - d3 >= 0.0 and d5 - d6 >= 0.0:
        along = (d4 - d3) / ((d4 - d3) + (d5 - d6))
        return 1.0 - along, along
    whole = over_a + over_b + over_c
    return over_b / whole, over_c / whole


@kernel
def find_nearest(part, parts, tree, points, face, square):
    """Fill face and square, the distance times itself, of every `parts`-th chunk of points."""
    nodes, children, leaves, numbers = tree.nodes, tree.children, tree.leaves, tree.numbers
    keys, items = on_stack(np.float64, STACK), on_stack(np.int32, STACK)
    for k in range(part * CHUNK, points.shape[0]):
        if (k // CHUNK) % parts != part:
            continue
        px, py, pz = points[k, 0], points[k, 1], points[k, 2]
        best, found, waiting = NOTHING_MET, np.int32(-1), 1
        keys[0], items[0] = 0.0, 0
        while waiting > 0:
            waiting -= 1
            item = items[waiting]
            if keys[waiting] > best:
                continue
            if item < 0:
                leaf = ~item
                for j in range(SLOTS):
                    number = numbers[leaf, NUMBER, j]
                    if number < 0:
                        continue
                    ax, ay, az = (
                        float(leaves[leaf, 0, j]),
                        float(leaves[leaf, 1, j]),
                        float(leaves[leaf, 2, j]),
                    )
                    bx, by, bz = (
                        float(leaves[leaf, 3, j]),
                        float(leaves[leaf, 4, j]),
                        float(leaves[leaf, 5, j]),
                    )
                    cx, cy, cz = (
                        float(leaves[leaf, 6, j]),
                        float(leaves[leaf, 7, j]),
                        float(leaves[leaf, 8, j]),
                    )
                    q, r = place_on_triangle(px, py, pz, ax, ay, az, bx, by, bz, cx, cy, cz)
                    x = px - ax - q * (bx - ax) - r * (cx - ax)
                    y = py - ay - q * (by - ay) - r * (cy - ay)
                    z = pz - az - q * (bz - az) - r * (cz - az)
                    away = x * x + y * y + z * z
                    if away < best or (away == best and number < found):
                        best, found = away, number
                continue
            # The nearest child is taken first: the others wait under it
            base = waiting
            for j in range(SLOTS):
                child = children[item, CHILD, j]
                if child == NO_CHILD:
                    continue
                x = max(0.0, abs(px - nodes[item, MIDDLE, j]) - nodes[item, EXTENT, j])
                y = max(0.0, abs(py - nodes[item, MIDDLE + 1, j]) - nodes[item, EXTENT + 1, j])
                z = max(0.0, abs(pz - nodes[item, MIDDLE + 2, j]) - nodes[item, EXTENT + 2, j])
                away = x * x + y * y + z * z
                if away > best:
                    continue
                at = waiting
                while at > base and keys[at - 1] < away:
                    keys[at], items[at] = keys[at - 1], items[at - 1]
                    at -= 1
                keys[at], items[at] = away, child
                waiting += 1
        face[k], square[k] = found, best
