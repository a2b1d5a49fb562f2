"""Polygons of any number of corners, cut into triangles, in order."""

from __future__ import annotations

import numpy as np

from eyeline.errors import FileError
from eyeline.geometry.arrays import BoolArray, FloatArray, IntArray

CLIPPED = 1024  # corners of a polygon that is not convex and still cut by its ears; larger ones become fans


def triangulated(points: FloatArray, corners: IntArray, counts: IntArray) -> tuple[IntArray, IntArray]:
    """(triangles, polygon): (T, 3) places in `corners`, and (T,) the polygon each is cut from, ascending.

    corners: (C,) point numbers, polygon after polygon; counts: (P,) how many each has, at least 3.
    Convex polygons become fans about their first corner; others lose their ears one by one. [Meisters75]
    """
    few = np.flatnonzero(counts < 3)
    if len(few):
        raise FileError(f"face {few[0]} has {counts[few[0]]} corners; at least 3 are needed")
    first = np.cumsum(counts) - counts
    pieces = counts - 2
    polygon = np.repeat(np.arange(len(counts)), pieces)
    step = np.arange(pieces.sum()) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    start = first[polygon]
    triangles = np.stack([start, start + step + 1, start + step + 2], axis=1)
    firsts = np.cumsum(pieces) - pieces
    for size in np.flatnonzero(np.bincount(counts[counts > 3])):
        alike = np.flatnonzero(counts == size)
        shapes = points[corners[first[alike, None] + np.arange(size)]].astype(np.float64)
        for k in np.flatnonzero(~convex(shapes)):
            if size <= CLIPPED:
                rows = firsts[alike[k]] + np.arange(size - 2)
                triangles[rows] = first[alike[k]] + ears(flattened(shapes[k]))
    return triangles, polygon


def outward(shapes: FloatArray) -> FloatArray:
    """(P, 3) twice the area of polygons (P, N, 3), along their normals. [Newell]"""
    from_first = shapes - shapes[:, :1]
    areas: FloatArray = np.cross(from_first[:, 1:-1], from_first[:, 2:]).sum(axis=1)
    return areas


def convex(shapes: FloatArray) -> BoolArray:
    """(P,) whether polygons (P, N, 3) turn one way at every corner."""
    edges = np.roll(shapes, -1, axis=1) - shapes
    turns = np.cross(np.roll(edges, 1, axis=1), edges)
    found: BoolArray = ((turns * outward(shapes)[:, None]).sum(axis=2) >= 0).all(axis=1)
    return found


def flattened(shape: FloatArray) -> FloatArray:
    """(N, 2) a polygon (N, 3) seen along the axis it faces most, counter-clockwise."""
    normal = outward(shape[None])[0]
    axis = int(np.abs(normal).argmax())
    plane = [(axis + 1) % 3, (axis + 2) % 3]
    flat: FloatArray = shape[:, plane if normal[axis] >= 0 else plane[::-1]]
    return flat


def ears(flat: FloatArray) -> IntArray:
    """(N - 2, 3) corners of a polygon (N, 2): cut where a corner is convex and no other lies in its ear.

    One that crosses itself has no such corner at some time; then the next is cut, whatever it holds.
    """
    left = list(range(len(flat)))
    cut = []
    here, tried = 0, 0
    while len(left) > 3:
        a, b, c = (left[(here + k) % len(left)] for k in (-1, 0, 1))
        others = flat[[corner for corner in left if corner not in (a, b, c)]]
        if tried < len(left) and not is_ear(flat[[a, b, c]], others):
            here, tried = (here + 1) % len(left), tried + 1
            continue
        cut.append((a, b, c))
        left.pop(here)
        here, tried = here % len(left), 0
    return np.array([*cut, tuple(left)], dtype=np.int64)


def is_ear(ear: FloatArray, others: FloatArray) -> bool:
    """Whether a triangle (3, 2) turns counter-clockwise with none of the others (N, 2) in it."""
    a, b, c = ear
    if cross(b - a, c - b) <= 0:
        return False
    inside = np.ones(len(others), dtype=bool)
    for one, two in ((a, b), (b, c), (c, a)):
        inside &= cross(two - one, others - one) >= 0
    same = (others[:, None] == ear).all(axis=2).any(axis=1)
    return not (inside & ~same).any()


def cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """The z of the cross product of plane vectors (..., 2)."""
    product: FloatArray = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return product
