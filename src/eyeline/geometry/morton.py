"""Faces in the order of a curve through space, and its cells that hold few: a tree's leaves. [Lauterbach09]

A face's key is the Morton code of the middle of its box, above its number: no two are equal, so every sort
gives the same order.
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.arrays import BoolArray, FloatArray, IntArray
from eyeline.jit import helper, in_parts, kernel

AXIS_BITS = 21  # of a code for each of three axes, where the face's number leaves so many
FULL = 8  # faces a leaf may hold


def sorted_keys(points: FloatArray, faces: IntArray, parts: int) -> tuple[IntArray, int]:
    """The keys (F,) uint64 of faces, sorted, and how many of their lower bits are the face's number.

    points: (3 V,) and faces: (3 F,), flat.
    """
    count = len(faces) // 3
    bits = max(1, (count - 1).bit_length())
    columns = points.reshape(-1, 3)
    low, high = columns.min(axis=0).astype(np.float64), columns.max(axis=0).astype(np.float64)
    cells = 2.0 ** min(AXIS_BITS, (64 - bits) // 3) - 1
    longest = float((high - low).max())
    scale = cells / longest if longest > 0 else 0.0
    keys = np.empty(count, np.uint64)
    in_parts(parts, fill_keys, points, faces, tuple(low.tolist()), scale, bits, keys)
    keys.sort()
    return keys, bits


def leaf_starts(keys: IntArray, parts: int) -> IntArray:
    """(L + 1,) int64: where among sorted keys the leaves begin, and the end of the last."""
    starts: BoolArray = np.ones(len(keys), np.bool_)
    in_parts(parts, mark_leaves, keys, starts)
    return np.append(np.flatnonzero(starts), len(keys))


@kernel
def fill_keys(part, parts, points, faces, low, scale, bits, keys):
    """Fill the keys of one part of the faces."""
    count = keys.shape[0]
    for i in range(count * part // parts, count * (part + 1) // parts):
        a, b, c = 3 * faces[3 * i], 3 * faces[3 * i + 1], 3 * faces[3 * i + 2]
        code = np.uint64(0)
        for axis in range(3):
            x, y, z = points[a + axis], points[b + axis], points[c + axis]
            twice = np.float64(min(x, min(y, z))) + np.float64(max(x, max(y, z)))
            code |= spread(np.uint64((twice * 0.5 - low[axis]) * scale)) << np.uint64(2 - axis)
        keys[i] = (code << np.uint64(bits)) | np.uint64(i)


@helper
def spread(x):
    """The lower 21 bits of a number, with two bits of 0 between each."""
    x = (x | (x << np.uint64(32))) & np.uint64(0x1F00000000FFFF)
    x = (x | (x << np.uint64(16))) & np.uint64(0x1F0000FF0000FF)
    x = (x | (x << np.uint64(8))) & np.uint64(0x100F00F00F00F00F)
    x = (x | (x << np.uint64(4))) & np.uint64(0x10C30C30C30C30C3)
    return (x | (x << np.uint64(2))) & np.uint64(0x1249249249249249)


@kernel
def mark_leaves(part, parts, keys, starts):
    """Whether a leaf starts at each key: leaves are the largest cells of the curve that hold at most FULL.

    One starts at a key where the smallest cell around it and the key before it holds more.
    """
    count = keys.shape[0]
    for i in range(max(1, count * part // parts), count * (part + 1) // parts):
        cell = keys[i] ^ keys[i - 1]
        for shift in (1, 2, 4, 8, 16, 32):
            cell |= cell >> np.uint64(shift)
        first, last = i - 1, i
        while first > 0 and last - first < FULL and (keys[first - 1] ^ keys[i]) <= cell:
            first -= 1
        while last + 1 < count and last - first < FULL and (keys[last + 1] ^ keys[i]) <= cell:
            last += 1
        starts[i] = last - first >= FULL
