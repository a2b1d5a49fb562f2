"""Every surface at every pixel, sorted: the lists that exact transparency is made of.

A list holds what lies in front of an opaque answer, far to near, so that whoever composites it needs no
order of the faces. Coverage and depth are the depth buffer's own, bit for bit. [Carpenter84, Yang10]
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from eyeline.errors import OptionError
from eyeline.geometry.arrays import BoolArray, FloatArray, IntArray
from eyeline.geometry.fixedpoint import (
    BEFORE_CENTRE,
    CENTRE,
    UNITS,
    depth_at,
    depth_plane,
    edge_bias,
    signed_area,
)
from eyeline.jit import helper, kernel, share, threads
from eyeline.projection.projected import CLOCKWISE, COUNTER_CLOCKWISE, Projected

LIMIT = 1 << 27  # fragments in one picture: with their sorting, 2 GB
BAND_BITS = 4  # threads take turns in bands of 16 rows
SHORT = 24  # lists up to this long are sorted by insertion, longer ones by heap


@dataclass(frozen=True, eq=False)
class Fragments:
    """The faces at each pixel, far to near; of equal depths the higher face number is the farther."""

    first: IntArray  # (H*W + 1,) int64: pixel p has the fragments first[p] to first[p + 1]
    face: IntArray  # (K,) int32 scene face
    depth: FloatArray  # (K,) float32, reversed
    width: int
    height: int

    def __len__(self) -> int:
        return len(self.face)

    @property
    def pixel(self) -> IntArray:
        """(K,) int64: the pixel of every fragment, row after row."""
        return np.repeat(np.arange(len(self.first) - 1), np.diff(self.first))

    def only(self, wanted: BoolArray) -> Fragments:
        """The fragments (K,) that are wanted, in the same order."""
        before = np.concatenate([[0], np.cumsum(wanted, dtype=np.int64)])
        return replace(self, first=before[self.first], face=self.face[wanted], depth=self.depth[wanted])

    def nearest(self) -> tuple[IntArray, FloatArray]:
        """Face (H, W) int32 and depth (H, W) float32 of the last fragment of each list; -1 and 0 without."""
        face = np.full(len(self.first) - 1, -1, dtype=np.int32)
        depth = np.zeros(len(self.first) - 1, dtype=np.float32)
        some = np.flatnonzero(self.first[1:] > self.first[:-1])
        last = self.first[1:][some] - 1
        face[some] = self.face[last]
        depth[some] = self.depth[last]
        return face.reshape(self.height, self.width), depth.reshape(self.height, self.width)


def fragments(projected: Projected, behind: FloatArray) -> Fragments:
    """All samples of `projected`'s faces that are nearer than `behind` (H, W) float32 and than the back.

    Refused: more than LIMIT of them.
    """
    width, height = projected.width, projected.height
    first = np.zeros(width * height + 1, dtype=np.int64)
    live = np.flatnonzero(np.broadcast_to(projected.sides, len(projected.faces))).astype(np.int32)
    if not len(live):
        return Fragments(first, np.empty(0, np.int32), np.empty(0, np.float32), width, height)
    parts = threads()
    corners, depths, winding, source = _columns(projected, live)
    ground = np.ascontiguousarray(behind, dtype=np.float32).reshape(-1)
    one = np.zeros(1, dtype=np.int64)

    # Count, so that every list has its exact place before anything is written
    counts = first[1:]
    share(
        lambda k: visit(k, parts, 0, corners, depths, winding, source, ground, width, height, counts, one),
        parts,
    )
    np.cumsum(counts, out=counts)
    count = int(first[-1])
    if count > LIMIT:
        raise OptionError(
            f"{count} transparent samples lie over each other in one picture; at most {LIMIT} are composited:"
            " make the picture smaller or fewer faces transparent"
        )

    # Fill and sort
    keys = np.empty(count, dtype=np.int64)
    free = first[:-1].copy()
    share(
        lambda k: visit(k, parts, 1, corners, depths, winding, source, ground, width, height, free, keys),
        parts,
    )
    face, depth = np.empty(count, np.int32), np.empty(count, np.float32)
    share(lambda k: settle(k, parts, first, keys, face, depth), parts)
    return Fragments(first, face, depth, width, height)


def _columns(projected: Projected, live: IntArray) -> tuple[IntArray, FloatArray, IntArray, IntArray]:
    """The live faces' corners (6 K,) int32, depths (3 K,) float32, sides and numbers (K,), each flat."""
    faces = projected.faces[live]
    corners = projected.xy[faces].reshape(-1)
    depths = projected.depth[faces].reshape(-1)
    sides = np.broadcast_to(projected.sides, len(projected.faces))[live].astype(np.int32)
    source = live.copy()
    pieces = live >= projected.face_count
    source[pieces] = projected.piece_source[live[pieces] - projected.face_count]
    return corners, depths, sides, source


@kernel
def visit(part, parts, fill, corners, depths, sides, source, behind, width, height, free, keys):
    """Adds one to `free` of each pixel a face is seen at; with `fill`, writes its key there."""
    for j in range(source.shape[0]):
        x0, y0 = np.int64(corners[6 * j]), np.int64(corners[6 * j + 1])
        x1, y1 = np.int64(corners[6 * j + 2]), np.int64(corners[6 * j + 3])
        x2, y2 = np.int64(corners[6 * j + 4]), np.int64(corners[6 * j + 5])
        z0, z1, z2 = depths[3 * j], depths[3 * j + 1], depths[3 * j + 2]
        area = signed_area(x0, y0, x1, y1, x2, y2)
        side = COUNTER_CLOCKWISE if area < 0 else CLOCKWISE
        if area == 0 or (sides[j] & side) == 0:
            continue
        # Corners 1 and 2 of a counter-clockwise face change places, so that areas are positive
        if area < 0:
            x1, y1, z1, x2, y2, z2 = x2, y2, z2, x1, y1, z1
        left = max((min(x0, x1, x2) + BEFORE_CENTRE) >> 8, 0)
        right = min((max(x0, x1, x2) - CENTRE) >> 8, width - 1)
        top = max((min(y0, y1, y2) + BEFORE_CENTRE) >> 8, 0)
        bottom = min((max(y0, y1, y2) - CENTRE) >> 8, height - 1)
        if left > right or top > bottom:
            continue
        a, b, c = depth_plane(x0, y0, z0, x1, y1, z1, x2, y2, z2)
        inverse = np.int64(source[j]) ^ 0xFFFFFFFF
        y = top
        while y <= bottom:
            if (y >> BAND_BITS) % parts != part:
                y = ((y >> BAND_BITS) + 1) << BAND_BITS
                continue
            px, py = left * UNITS + CENTRE, y * UNITS + CENTRE
            low, high = 0.0, float(right - left)
            low, high = across(x1, y1, x2, y2, px, py, low, high)
            low, high = across(x2, y2, x0, y0, px, py, low, high)
            low, high = across(x0, y0, x1, y1, px, py, low, high)
            if low <= high:
                for x in range(left + np.int64(low), left + np.int64(high) + 1):
                    depth = depth_at(a, b, c, x, y)
                    at = y * width + x
                    if depth > behind[at] and depth > np.float32(0):
                        if fill:
                            keys[free[at]] = (np.int64(np.float32(depth).view(np.int32)) << 32) | inverse
                        free[at] += 1
            y += 1


@helper
def across(ax, ay, bx, by, px, py, low, high):
    """The part of the pixels low .. high to the right of centre (px, py) on the inner side of an edge.

    Whole numbers below 2**53 in float64: ceil and floor of a rounded quotient are those of the exact one.
    """
    a, b = ay - by, bx - ax
    e = np.float64(a * (px - ax) + b * (py - ay) + edge_bias(a, b))
    step = np.float64(a * UNITS)
    if step > 0:
        low = max(low, np.ceil(-e / step))
    elif step < 0:
        high = min(high, np.floor(-e / step))
    elif e < 0:
        high = -1.0
    return low, high


@kernel
def settle(part, parts, first, keys, face, depth):
    """Sorts each pixel's keys upwards, and parts them into faces and depths."""
    pixels = first.shape[0] - 1
    for pixel in range(pixels * part // parts, pixels * (part + 1) // parts):
        begin, end = first[pixel], first[pixel + 1]
        if end - begin > SHORT:
            sort_by_heap(keys, begin, end)
        else:
            sort_by_insertion(keys, begin, end)
        for k in range(begin, end):
            face[k] = ~np.int32(keys[k])
            depth[k] = np.int32(keys[k] >> 32).view(np.float32)


@helper
def sort_by_insertion(keys, begin, end):
    """Sorts keys[begin:end] upwards; for short lists."""
    for k in range(begin + 1, end):
        key = keys[k]
        at = k
        while at > begin and keys[at - 1] > key:
            keys[at] = keys[at - 1]
            at -= 1
        keys[at] = key


@helper
def sort_by_heap(keys, begin, end):
    """Sorts keys[begin:end] upwards in n log n steps, in place. [Floyd64]"""
    size = end - begin
    root = size // 2
    while size > 1:
        # First every inner node takes its place, from the last; then the greatest leaves, one at a time
        if root > 0:
            root -= 1
            key = keys[begin + root]
        else:
            size -= 1
            key = keys[begin + size]
            keys[begin + size] = keys[begin]
        hole, child = root, 2 * root + 1
        while child < size:
            if child + 1 < size and keys[begin + child + 1] > keys[begin + child]:
                child += 1
            if keys[begin + child] <= key:
                break
            keys[begin + hole] = keys[begin + child]
            hole, child = child, 2 * child + 1
        keys[begin + hole] = key
