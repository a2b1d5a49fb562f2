"""How often a surface winds around each point of a grid: 1 inside, 0 outside.

A ray to either side along each axis counts the faces it leaves through, less those it enters through; around
a closed surface all six agree. Through a hole one or another of them miscounts: the mean of the six samples
the generalised winding number, the part of the view that the surface closes. [Jacobson13] Parts that overlap
are one body.
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.arrays import BoolArray, FloatArray, IntArray, read_only
from eyeline.jit import helper, kernel
from eyeline.shapes.grid import Grid

# Places are whole numbers of 1/65536 cell, so that of faces which share an edge one owns each row of the grid
PARTS = 1 << 16
HALF = 3  # of the six rays


def inside(grid: Grid, points: FloatArray, faces: IntArray) -> BoolArray:
    """(K,) whether the grid's points are within a surface; points (V, 3) metres, faces (F, 3).

    A surface that is inside out as a whole is taken as if it were not.
    """
    places = read_only(np.rint(grid.places(points) * PARTS).astype(np.int64).reshape(-1))
    corners = read_only(np.ascontiguousarray(faces, np.int32).reshape(-1))

    def rays(axis: int) -> IntArray:
        entered = np.zeros(grid.size, np.int16)
        enter_rows(places, corners, axis, grid.counts, entered)
        before = np.cumsum(entered.reshape(grid.counts), axis=axis, dtype=np.int32)
        whole = np.take(before, [-1], axis=axis)
        both: IntArray = 2 * before - whole
        return both

    winding = rays(0) + rays(1) + rays(2)
    found: BoolArray = (-winding if volume(points, faces) < 0 else winding).reshape(-1) > HALF
    return found


def volume(points: FloatArray, faces: IntArray) -> float:
    """Cubic metres within a closed surface; below 0 if it is inside out."""
    corners = np.asarray(points, np.float64)[faces]
    a, b, c = (corners[:, k] - corners[0, 0] for k in range(3)) if len(faces) else np.zeros((3, 1, 3))
    return float((a * np.cross(b, c)).sum()) / 6


@helper
def owns(du, dv):
    """Whether a face, turning counter-clockwise, owns the points on its edge of this direction."""
    return (dv < 0) | ((dv == 0) & (du < 0))


@kernel
def enter_rows(places, faces, axis, counts, entered):
    """Add 1 to the first point after each place where a row along `axis` enters the surface.

    Where it leaves, -1. places: (3 V,) whole numbers.
    """
    u, v = (axis + 1) % 3, (axis + 2) % 3
    strides = (counts[1] * counts[2], counts[2], 1)
    stride_u, stride_v, stride = strides[u], strides[v], strides[axis]
    for face in range(faces.shape[0] // 3):
        a, b, c = 3 * faces[3 * face], 3 * faces[3 * face + 1], 3 * faces[3 * face + 2]
        au, av, bu, bv, cu, cv = (
            places[a + u],
            places[a + v],
            places[b + u],
            places[b + v],
            places[c + u],
            places[c + v],
        )
        area = (bu - au) * (cv - av) - (bv - av) * (cu - au)
        if area == 0:
            continue
        # A face that looks along the axis is left through
        step = 1
        if area > 0:
            step = -1
        else:
            b, c, bu, bv, cu, cv, area = c, b, cu, cv, bu, bv, -area
        own_a, own_b, own_c = owns(cu - bu, cv - bv), owns(au - cu, av - cv), owns(bu - au, bv - av)
        first_u, last_u = -(-min(au, bu, cu) // PARTS), max(au, bu, cu) // PARTS
        first_v, last_v = -(-min(av, bv, cv) // PARTS), max(av, bv, cv) // PARTS
        for i in range(first_u, last_u + 1):
            for j in range(first_v, last_v + 1):
                pu, pv = i * PARTS, j * PARTS
                to_a = (cu - bu) * (pv - bv) - (cv - bv) * (pu - bu)
                to_b = (au - cu) * (pv - cv) - (av - cv) * (pu - cu)
                to_c = (bu - au) * (pv - av) - (bv - av) * (pu - au)
                within = ((to_a > 0) | ((to_a == 0) & own_a)) & ((to_b > 0) | ((to_b == 0) & own_b))
                if within & ((to_c > 0) | ((to_c == 0) & own_c)):
                    # In floating point: the three products may not fit into 64 bits
                    height = (
                        float(to_a) * float(places[a + axis])
                        + float(to_b) * float(places[b + axis])
                        + float(to_c) * float(places[c + axis])
                    ) / (float(area) * PARTS)
                    entered[i * stride_u + j * stride_v + np.int64(np.ceil(height)) * stride] += step
