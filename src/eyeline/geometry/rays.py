"""Single rays through a tree: the first face that each meets, or whether it meets any.

For rays that come from everywhere and go everywhere: shadows, occlusion, reflection. An answer is the least
(length, face number) of all faces that a ray goes through, whatever the tree.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from eyeline.geometry.arrays import BoolArray, FloatArray, IntArray, read_only
from eyeline.geometry.bvh import CHILD, EXTENT, MIDDLE, NO_CHILD, NUMBER, STACK, Bvh, fetch_child
from eyeline.geometry.clustering import SLOTS
from eyeline.geometry.crossing import crosses, exact_crosses, side_shown
from eyeline.geometry.morton import keys_of_places
from eyeline.jit import fetch, in_parts, kernel, on_stack, threads, trailing_zeros

CHUNK = 1024  # rays that a thread takes at a time
AHEAD, RAY_BYTES = 8, 12  # rays asked for before their turn; of an origin, or a direction
ROUNDING = np.float32(2.0**-21)  # eight roundings of float32, as a part of what is added
STEEPEST = np.float32(1e18)  # lengths per metre: as good as never

ZERO, ONE, INFINITE = np.float32(0), np.float32(1), np.float32(np.inf)


class Hits(NamedTuple):
    """What rays met first."""

    face: IntArray  # (K,) int32; -1 is nothing
    length: FloatArray  # (K,) float32, in lengths of the ray's direction; inf is nothing


def first_hits(tree: Bvh, origins: FloatArray, directions: FloatArray, parts: int = 0) -> Hits:
    """The first face that each ray meets; origins and directions (K, 3), of any length but 0.

    parts: how many threads cast; 0 are all of them. Whoever is one of many takes 1.
    """
    return cast(tree, (origins, directions), np.full(len(origins), INFINITE), False, parts)


def blocked(
    tree: Bvh, origins: FloatArray, directions: FloatArray, reach: FloatArray, parts: int = 0
) -> BoolArray:
    """(K,) whether rays meet any face within `reach` (K,) lengths of their directions; below 0 none is."""
    return cast(tree, (origins, directions), reach, True, parts).face >= 0


def cast(
    tree: Bvh, rays: tuple[FloatArray, FloatArray], reach: FloatArray, any_hit: bool, parts: int
) -> Hits:
    """What rays meet within their reach: the first face, or, where any will do, whichever was found."""
    count = len(reach)
    face, length = np.full(count, -1, np.int32), np.array(reach, np.float32)
    given = [read_only(np.ascontiguousarray(one, np.float32)) for one in rays]
    if len(tree.nodes) and count:
        # Rays that begin near each other, cast one after the other, find what they need in the cache
        many = parts == 0 and count > CHUNK
        parts = threads() if many else 1
        order = keys_of_places(given[0], parts) if many else (np.arange(count, dtype=np.uint64), 63)
        in_parts(parts, cast_rays, tree, *given, *order, any_hit, face, length)
    length[face < 0] = INFINITE
    return Hits(face, length)


@kernel
def cast_rays(part, parts, tree, origins, directions, keys_of_rays, bits, any_hit, face, length):
    """Cast every `parts`-th chunk of rays; length holds how far each reaches, and then how far it came.

    The lower bits of the keys are the rays' numbers, in the order they are cast in.
    """
    lower = (np.uint64(1) << np.uint64(bits)) - np.uint64(1)
    nodes, children, leaves, numbers = tree.nodes, tree.children, tree.leaves, tree.numbers
    keys, items = on_stack(np.float32, STACK), on_stack(np.int32, STACK)
    near, over, under = on_stack(np.float32, SLOTS), on_stack(np.float64, SLOTS), on_stack(np.float64, SLOTS)
    for number in range(part * CHUNK, origins.shape[0]):
        if (number // CHUNK) % parts != part:
            continue
        # Rays stand in no order in memory: those to come are asked for in time
        later = np.int64(keys_of_rays[min(number + AHEAD, origins.shape[0] - 1)] & lower)
        fetch(origins.ctypes.data + RAY_BYTES * later)
        fetch(directions.ctypes.data + RAY_BYTES * later)
        fetch(length.ctypes.data + length.itemsize * later)
        fetch(face.ctypes.data + face.itemsize * later)
        ray = np.int64(keys_of_rays[number] & lower)
        ox, oy, oz = origins[ray, 0], origins[ray, 1], origins[ray, 2]
        dx, dy, dz = directions[ray, 0], directions[ray, 1], directions[ray, 2]
        # Lengths per metre along each axis, and by how many rounding may move a box
        ix = ONE / dx if abs(dx) * STEEPEST > ONE else STEEPEST
        iy = ONE / dy if abs(dy) * STEEPEST > ONE else STEEPEST
        iz = ONE / dz if abs(dz) * STEEPEST > ONE else STEEPEST
        sx, sy, sz = abs(ix), abs(iy), abs(iz)
        px = np.float32(max(abs(tree.low[0] - ox), abs(tree.high[0] - ox))) * ROUNDING * sx
        py = np.float32(max(abs(tree.low[1] - oy), abs(tree.high[1] - oy))) * ROUNDING * sy
        pz = np.float32(max(abs(tree.low[2] - oz), abs(tree.high[2] - oz))) * ROUNDING * sz
        # Along its longest axis the ray becomes the third one: the others are sheared
        kz = 0 if abs(dx) >= abs(dy) and abs(dx) >= abs(dz) else (1 if abs(dy) >= abs(dz) else 2)
        kx, ky = (kz + 1) % 3, (kz + 2) % 3
        along = np.float64(directions[ray, kz])
        shear_x, shear_y = np.float64(directions[ray, kx]) / along, np.float64(directions[ray, ky]) / along
        from_x, from_y, from_z = (
            np.float64(origins[ray, kx]),
            np.float64(origins[ray, ky]),
            np.float64(origins[ray, kz]),
        )
        best, hit, waiting = length[ray], np.int32(-1), 1
        keys[0], items[0] = ZERO, 0
        while waiting > 0 and not (any_hit and hit >= 0):
            waiting -= 1
            item, live = items[waiting], keys[waiting] <= best
            while live and item >= 0:
                mask = np.int32(0)
                for j in range(SLOTS):
                    a, b = (nodes[item, MIDDLE, j] - ox) * ix, nodes[item, EXTENT, j] * sx + px
                    t0, t1 = max(ZERO, a - b), min(best, a + b)
                    a, b = (nodes[item, MIDDLE + 1, j] - oy) * iy, nodes[item, EXTENT + 1, j] * sy + py
                    t0, t1 = max(t0, a - b), min(t1, a + b)
                    a, b = (nodes[item, MIDDLE + 2, j] - oz) * iz, nodes[item, EXTENT + 2, j] * sz + pz
                    t0, t1 = max(t0, a - b), min(t1, a + b)
                    met_box = (t0 <= t1) & (children[item, CHILD, j] != NO_CHILD)
                    mask = np.int32(mask | (np.int32(1) << j if met_box else np.int32(0)))
                    near[j] = t0
                live = mask != 0
                if live:
                    # Into the nearest child; the others wait, the nearest of them on top
                    j, base, node = trailing_zeros(mask), waiting, item
                    mask = np.int32(mask & (mask - 1))
                    item, nearest = children[node, CHILD, j], near[j]
                    while mask != 0:
                        j = trailing_zeros(mask)
                        mask = np.int32(mask & (mask - 1))
                        other, key = children[node, CHILD, j], near[j]
                        if key < nearest:
                            item, other, nearest, key = other, item, key, nearest
                        at = waiting
                        while at > base and keys[at - 1] < key:
                            keys[at], items[at] = keys[at - 1], items[at - 1]
                            at -= 1
                        keys[at], items[at] = key, other
                        fetch_child(nodes.ctypes.data, leaves.ctypes.data, other)
                        waiting += 1
            if not live:
                continue
            leaf, mask, doubt = ~item, np.int32(0), np.int32(0)
            for j in range(SLOTS):
                az, bz = leaves[leaf, kz, j] - from_z, leaves[leaf, 3 + kz, j] - from_z
                cz = leaves[leaf, 6 + kz, j] - from_z
                ax, ay = (
                    leaves[leaf, kx, j] - from_x - shear_x * az,
                    leaves[leaf, ky, j] - from_y - shear_y * az,
                )
                bx, by = (
                    leaves[leaf, 3 + kx, j] - from_x - shear_x * bz,
                    leaves[leaf, 3 + ky, j] - from_y - shear_y * bz,
                )
                cx, cy = (
                    leaves[leaf, 6 + kx, j] - from_x - shear_x * cz,
                    leaves[leaf, 6 + ky, j] - from_y - shear_y * cz,
                )
                u, v, w, unsure = crosses(ax, ay, bx, by, cx, cy)
                doubt = np.int32(doubt | (np.int32(1) << j if unsure else np.int32(0)))
                through = side_shown(u, v, w) != 0
                mask = np.int32(mask | (np.int32(1) << j if through else np.int32(0)))
                over[j], under[j] = u * az + v * bz + w * cz, (u + v + w) * along
            while doubt != 0:
                j = trailing_zeros(doubt)
                doubt = np.int32(doubt & (doubt - 1))
                az, bz = leaves[leaf, kz, j] - from_z, leaves[leaf, 3 + kz, j] - from_z
                cz = leaves[leaf, 6 + kz, j] - from_z
                ax, ay = (
                    leaves[leaf, kx, j] - from_x - shear_x * az,
                    leaves[leaf, ky, j] - from_y - shear_y * az,
                )
                bx, by = (
                    leaves[leaf, 3 + kx, j] - from_x - shear_x * bz,
                    leaves[leaf, 3 + ky, j] - from_y - shear_y * bz,
                )
                cx, cy = (
                    leaves[leaf, 6 + kx, j] - from_x - shear_x * cz,
                    leaves[leaf, 6 + ky, j] - from_y - shear_y * cz,
                )
                u, v, w = exact_crosses(ax, ay, bx, by, cx, cy)
                bit = np.int32(1 << j)
                mask = np.int32(mask | bit if side_shown(u, v, w) != 0 else mask & ~bit)
                over[j], under[j] = u * az + v * bz + w * cz, (u + v + w) * along
            while mask != 0:
                j = trailing_zeros(mask)
                mask = np.int32(mask & (mask - 1))
                here, own = np.float32(over[j] / under[j]), numbers[leaf, NUMBER, j]
                nearer = (here < best) | ((here == best) & ((own < hit) | (hit < 0)))
                if (here > ZERO) & (own >= 0) & nearer:
                    best, hit = here, own
        length[ray], face[ray] = best, hit
