"""The surface where a function on a grid is zero: one vertex in each cell it passes through. [Gibson98]

A cell's vertex begins at the mean of the places where the surface crosses its edges, and is then moved onto
the surface along the gradient, within the cell. Around every grid edge that the surface crosses the four
cells' vertices make two faces, so the surface is closed.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray, read_only
from eyeline.jit import in_parts, kernel, on_stack, threads
from eyeline.shapes.grid import Grid

MOVES = 3  # Newton steps: the function is nearly linear within a cell
CORNERS, EDGES = 8, 12  # of a cell


class Net(NamedTuple):
    """A closed surface; outside is where the function is above 0."""

    points: FloatArray  # (V, 3) float32 metres
    faces: IntArray  # (F, 3) int32
    normals: FloatArray  # (V, 3) float32 unit: the function's gradient


def surface_net(grid: Grid, values: FloatArray) -> Net:
    """Where values (K,) float32 are zero; they must be above 0 all along the grid's border."""
    flat, slabs, parts = read_only(values), grid.counts[0], threads()
    vertices, quads = np.zeros(slabs + 1, np.int64), np.zeros(slabs + 1, np.int64)
    in_parts(parts, count_slabs, flat, grid.counts, vertices, quads)
    # Slab after slab, whichever thread fills them
    vertices, quads = np.cumsum(vertices), np.cumsum(quads)
    index = np.empty(grid.size, np.int32)
    places, normals = np.empty((vertices[-1], 3), np.float32), np.empty((vertices[-1], 3), np.float32)
    faces = np.empty((2 * quads[-1], 3), np.int32)
    in_parts(parts, fill_vertices, flat, grid.counts, read_only(vertices), index, places, normals)
    in_parts(parts, fill_faces, flat, grid.counts, read_only(quads), index, places, faces)
    points = (grid.low + grid.step * places.astype(np.float64)).astype(np.float32)
    return Net(points, faces, normals)


@kernel
def count_slabs(part, parts, values, counts, vertices, quads):
    """Fill vertices and quads: how many begin in slab i, at i + 1."""
    nx, ny, nz = counts
    for i in range((nx - 1) * part // parts, (nx - 1) * (part + 1) // parts):
        cells, edges = 0, 0
        for j in range(ny - 1):
            for k in range(nz - 1):
                p = (i * ny + j) * nz + k
                here = values[p] < 0
                x, y, z = values[p + ny * nz] < 0, values[p + nz] < 0, values[p + 1] < 0
                yz, xz = values[p + nz + 1] < 0, values[p + ny * nz + 1] < 0
                xy, xyz = values[p + ny * nz + nz] < 0, values[p + ny * nz + nz + 1] < 0
                edges += np.int64(here != x) + np.int64(here != y) + np.int64(here != z)
                low = here & x & y & z & yz & xz & xy & xyz
                cells += np.int64((here | x | y | z | yz | xz | xy | xyz) & (not low))
        vertices[i + 1], quads[i + 1] = cells, edges


@kernel
def fill_vertices(part, parts, values, counts, starts, index, places, normals):
    """Fill the vertex of each cell, in steps of the grid, its normal, and index: the cell's vertex."""
    nx, ny, nz = counts
    v = on_stack(np.float64, CORNERS)
    for i in range((nx - 1) * part // parts, (nx - 1) * (part + 1) // parts):
        vertex = starts[i]
        for j in range(ny - 1):
            for k in range(nz - 1):
                p, below = (i * ny + j) * nz + k, 0
                for corner in range(CORNERS):
                    v[corner] = values[p + (corner & 1) * ny * nz + ((corner >> 1) & 1) * nz + (corner >> 2)]
                    below += np.int64(v[corner] < 0)
                if below in (0, CORNERS):
                    continue
                x, y, z, crossed = 0.0, 0.0, 0.0, 0
                for edge in range(EDGES):
                    axis, side = edge // 4, edge % 4
                    # The edge's first corner: `side` spread over the two other axes
                    a = (side << 1) if axis == 0 else ((side & 1) | ((side & 2) << 1) if axis == 1 else side)
                    b = a | (1 << axis)
                    if (v[a] < 0) != (v[b] < 0):
                        along = v[a] / (v[a] - v[b])
                        x += (a & 1) + (along if axis == 0 else 0.0)
                        y += ((a >> 1) & 1) + (along if axis == 1 else 0.0)
                        z += (a >> 2) + (along if axis == 2 else 0.0)
                        crossed += 1
                x, y, z = x / crossed, y / crossed, z / crossed
                gx, gy, gz = 0.0, 0.0, 0.0
                for move in range(MOVES + 1):
                    # Values on the cell's four edges along x, then on two lines along y
                    e0, e1, e2, e3 = (
                        v[0] + x * (v[1] - v[0]),
                        v[2] + x * (v[3] - v[2]),
                        v[4] + x * (v[5] - v[4]),
                        v[6] + x * (v[7] - v[6]),
                    )
                    f0, f1 = e0 + y * (e1 - e0), e2 + y * (e3 - e2)
                    d0, d1, d2, d3 = v[1] - v[0], v[3] - v[2], v[5] - v[4], v[7] - v[6]
                    gx = (d0 + y * (d1 - d0)) * (1 - z) + (d2 + y * (d3 - d2)) * z
                    gy, gz = (e1 - e0) * (1 - z) + (e3 - e2) * z, f1 - f0
                    square = gx * gx + gy * gy + gz * gz
                    if move < MOVES and square > 0.0:
                        back = (f0 + z * (f1 - f0)) / square
                        x = min(1.0, max(0.0, x - back * gx))
                        y = min(1.0, max(0.0, y - back * gy))
                        z = min(1.0, max(0.0, z - back * gz))
                length = np.sqrt(gx * gx + gy * gy + gz * gz)
                if length > 0.0:
                    normals[vertex, 0], normals[vertex, 1], normals[vertex, 2] = (
                        gx / length,
                        gy / length,
                        gz / length,
                    )
                else:
                    normals[vertex, 0], normals[vertex, 1], normals[vertex, 2] = 0.0, 0.0, 1.0
                places[vertex, 0], places[vertex, 1], places[vertex, 2] = i + x, j + y, k + z
                index[p] = vertex
                vertex += 1


@kernel
def fill_faces(part, parts, values, counts, starts, index, places, faces):
    """Fill two faces for each crossed edge of the grid, cut along the shorter diagonal."""
    nx, ny, nz = counts
    for i in range((nx - 1) * part // parts, (nx - 1) * (part + 1) // parts):
        face = 2 * starts[i]
        for j in range(ny - 1):
            for k in range(nz - 1):
                p = (i * ny + j) * nz + k
                here = values[p] < 0
                for axis in range(3):
                    ahead = ny * nz if axis == 0 else (nz if axis == 1 else 1)
                    if (values[p + ahead] < 0) == here:
                        continue
                    u = nz if axis == 0 else (1 if axis == 1 else ny * nz)
                    w = 1 if axis == 0 else (ny * nz if axis == 1 else nz)
                    a, b, c, d = index[p - u - w], index[p - w], index[p], index[p - u]
                    if not here:
                        b, d = d, b
                    ac, bd = 0.0, 0.0
                    for n in range(3):
                        ac += (float(places[a, n]) - float(places[c, n])) * (
                            float(places[a, n]) - float(places[c, n])
                        )
                        bd += (float(places[b, n]) - float(places[d, n])) * (
                            float(places[b, n]) - float(places[d, n])
                        )
                    if ac <= bd:
                        faces[face, 0], faces[face, 1], faces[face, 2] = a, b, c
                        faces[face + 1, 0], faces[face + 1, 1], faces[face + 1, 2] = a, c, d
                    else:
                        faces[face, 0], faces[face, 1], faces[face, 2] = a, b, d
                        faces[face + 1, 0], faces[face + 1, 1], faces[face + 1, 2] = b, c, d
                    face += 2
