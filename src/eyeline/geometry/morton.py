"""Faces in the order of a curve through space, and its cells that hold few: a tree's leaves. [Lauterbach09]

A face's key is the Morton code of the middle of its box, above its number: no two are equal, so every sort
gives the same order.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from eyeline.geometry.arrays import BoolArray, FloatArray, IntArray
from eyeline.geometry.bounds import Bounds
from eyeline.jit import helper, in_parts, kernel, share

AXIS_BITS = 21  # of a code for each of three axes, where the face's number leaves so many
PLACE_BITS = 8  # of a place's code for each axis: finer order is not worth its sorting
DIGIT_BITS = 11  # the counters of one digit stay in the first cache
DIGITS = 1 << DIGIT_BITS
FULL = 8  # faces a leaf may hold


def sorted_keys(points: FloatArray, faces: IntArray, parts: int) -> tuple[IntArray, int]:
    """The keys (F,) uint64 of faces, sorted, and how many of their lower bits are the face's number.

    points: (3 V,) and faces: (3 F,), flat.
    """
    count = len(faces) // 3
    bits = max(1, (count - 1).bit_length())
    bounds = Bounds.of(points.reshape(-1, 3))
    cells = 2.0 ** min(AXIS_BITS, (64 - bits) // 3) - 1
    longest = float((bounds.high - bounds.low).max())
    scale = cells / longest if longest > 0 else 0.0
    keys = np.empty(count, np.uint64)
    in_parts(parts, fill_keys, points, faces, tuple(bounds.low.tolist()), scale, bits, keys)
    return sorted_by_parts(keys, bits, parts), bits


def keys_of_places(places: FloatArray, parts: int) -> tuple[IntArray, int]:
    """The same of places (K, 3): neighbours in space become neighbours in the row."""
    count = len(places)
    bits, bounds = max(1, (count - 1).bit_length()), Bounds.of(places)
    longest = float((bounds.high - bounds.low).max())
    scale = (2.0**PLACE_BITS - 1) / longest if longest > 0 else 0.0
    keys = np.empty(count, np.uint64)
    in_parts(parts, fill_place_keys, places.reshape(-1), tuple(bounds.low.tolist()), scale, bits, keys)
    return sorted_by_parts(keys, bits, parts), bits


def sorted_by_parts(keys: IntArray, lowest: int, parts: int) -> IntArray:
    """Keys in order, which their bits below `lowest` follow already.

    Each thread sorts some of them, and then they are merged two by two, by all threads.
    """
    cuts = [len(keys) * part // parts for part in range(parts + 1)]
    other = np.empty_like(keys)
    pieces = [slice(begin, end) for begin, end in pairwise(cuts)]
    share(lambda part: sort_keys(keys[pieces[part]], other[pieces[part]], lowest), parts)
    while len(cuts) > 2:
        for first, middle, end in zip(cuts[0:-1:2], cuts[1::2], [*cuts[2::2], cuts[-1]], strict=False):
            in_parts(parts, merge_keys, keys[first:middle], keys[middle:end], other[first:end])
        keys, other = other, keys
        cuts = [*cuts[:-1:2], cuts[-1]]
    return keys


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


@kernel
def fill_place_keys(part, parts, places, low, scale, bits, keys):
    """Fill the keys of one part of the places."""
    count = keys.shape[0]
    for i in range(count * part // parts, count * (part + 1) // parts):
        code = np.uint64(0)
        for axis in range(3):
            cell = (np.float64(places[3 * i + axis]) - low[axis]) * scale
            code |= spread(np.uint64(cell)) << np.uint64(2 - axis)
        keys[i] = (code << np.uint64(bits)) | np.uint64(i)


@kernel
def sort_keys(keys, other, lowest):
    """Sort keys by their bits from `lowest` on, digit by digit from the right; other: room for as many."""
    count, moves = keys.shape[0], 0
    starts = np.empty(DIGITS, np.int64)
    now, then = keys, other
    for shift in range(lowest, 64, DIGIT_BITS):
        starts[:] = 0
        for i in range(count):
            starts[(now[i] >> np.uint64(shift)) & np.uint64(DIGITS - 1)] += 1
        begin, alike = 0, False
        for digit in range(DIGITS):
            size = starts[digit]
            starts[digit], begin, alike = begin, begin + size, alike or size == count
        if alike:
            continue
        for i in range(count):
            digit = np.int64((now[i] >> np.uint64(shift)) & np.uint64(DIGITS - 1))
            then[starts[digit]] = now[i]
            starts[digit] += 1
        now, then, moves = then, now, moves + 1
    if moves & 1:
        for i in range(count):
            keys[i] = other[i]


@kernel
def merge_keys(part, parts, left, right, merged):
    """Fill one part of `merged` from two sorted rows whose keys are all different."""
    begin, end = merged.shape[0] * part // parts, merged.shape[0] * (part + 1) // parts
    # How many of the first `begin` keys stand in the left row
    low, high = max(0, begin - right.shape[0]), min(begin, left.shape[0])
    while low < high:
        middle = (low + high) >> 1
        if left[middle] < right[begin - middle - 1]:
            low = middle + 1
        else:
            high = middle
    i, j = low, begin - low
    for at in range(begin, end):
        if j >= right.shape[0] or (i < left.shape[0] and left[i] < right[j]):
            merged[at] = left[i]
            i += 1
        else:
            merged[at] = right[j]
            j += 1


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
