"""The signed distance from every point of a grid to a surface: below 0 inside."""

from __future__ import annotations

import numpy as np

from eyeline.errors import GeometryError
from eyeline.geometry.arrays import BoolArray, FloatArray, IntArray, read_only
from eyeline.geometry.nearest import place_on_triangle
from eyeline.geometry.normals import face_normals
from eyeline.jit import kernel
from eyeline.shapes.grid import Grid
from eyeline.shapes.winding import inside

BAND = 1.75  # cells: a little over the diagonal of one, so that around every crossing all is exact
BURIED = 1.5  # cells: how far from a face the grid is asked whether it is inside
FAR = np.float32(3e38)


def signed_distance(grid: Grid, points: FloatArray, faces: IntArray) -> FloatArray:
    """(K,) float32 metres, below 0 inside; points (V, 3) within the grid, faces (F, 3).

    Exact near the surface. Farther out each point measures to the nearest place that its neighbours know of,
    swept through the grid in all eight directions [Tsai02]: at most about a tenth of a cell too far. Faces
    buried inside the body bound nothing and are left out. Refused: a surface that encloses no grid point.
    """
    within = inside(grid, points, faces)
    if not within.any():
        raise GeometryError(
            f"the mesh encloses nothing on a grid of {max(grid.counts)} points a side;"
            " close it, or use more cells"
        )
    bounding = faces[~buried(grid, within, points, faces)]
    places = read_only(np.ascontiguousarray(grid.places(points).astype(np.float32)).reshape(-1))
    corners = read_only(np.ascontiguousarray(bounding, np.int32).reshape(-1))
    square, near = np.full(grid.size, FAR, np.float32), np.empty(3 * grid.size, np.float32)
    fill_band(places, corners, grid.counts, square, near)
    for way in range(8):
        sweep(way, grid.counts, square, near)
    distance: FloatArray = np.sqrt(square) * np.float32(grid.step)
    np.negative(distance, out=distance, where=within)
    return distance


def buried(grid: Grid, within: BoolArray, points: FloatArray, faces: IntArray) -> BoolArray:
    """(F,) whether a face has the body on both sides."""
    middles = points[faces].astype(np.float64).mean(axis=1)
    reach = BURIED * grid.step * face_normals(points, faces)
    both: BoolArray = within[grid.numbers(middles + reach)] & within[grid.numbers(middles - reach)]
    return both & reach.any(axis=1)


@kernel
def fill_band(places, faces, counts, square, near):
    """Fill square and near of all points closer than BAND to a face, of equals the first."""
    for number in range(faces.shape[0] // 3):
        a, b, c = 3 * faces[3 * number], 3 * faces[3 * number + 1], 3 * faces[3 * number + 2]
        ax, ay, az = float(places[a]), float(places[a + 1]), float(places[a + 2])
        bx, by, bz = float(places[b]), float(places[b + 1]), float(places[b + 2])
        cx, cy, cz = float(places[c]), float(places[c + 1]), float(places[c + 2])
        nx = (by - ay) * (cz - az) - (bz - az) * (cy - ay)
        ny = (bz - az) * (cx - ax) - (bx - ax) * (cz - az)
        nz = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        reach = BAND * np.sqrt(nx * nx + ny * ny + nz * nz)
        x0, x1 = np.int64(np.ceil(min(ax, bx, cx) - BAND)), np.int64(np.floor(max(ax, bx, cx) + BAND))
        y0, y1 = np.int64(np.ceil(min(ay, by, cy) - BAND)), np.int64(np.floor(max(ay, by, cy) + BAND))
        z0, z1 = np.int64(np.ceil(min(az, bz, cz) - BAND)), np.int64(np.floor(max(az, bz, cz) + BAND))
        for i in range(max(x0, 0), min(x1, counts[0] - 1) + 1):
            for j in range(max(y0, 0), min(y1, counts[1] - 1) + 1):
                # Only the piece of the row that is close to the face's plane
                first, last = float(max(z0, 0)), float(min(z1, counts[2] - 1))
                level = nx * (i - ax) + ny * (j - ay) - nz * az
                if nz != 0.0:
                    s, t = (-reach - level) / nz, (reach - level) / nz
                    first, last = (
                        max(first, np.ceil(min(s, t) - BAND / 8)),
                        min(last, np.floor(max(s, t) + BAND / 8)),
                    )
                elif abs(level) > reach:
                    continue
                for k in range(np.int64(first), np.int64(last) + 1):
                    px, py, pz = float(i), float(j), float(k)
                    q, r = place_on_triangle(px, py, pz, ax, ay, az, bx, by, bz, cx, cy, cz)
                    x = ax + q * (bx - ax) + r * (cx - ax)
                    y = ay + q * (by - ay) + r * (cy - ay)
                    z = az + q * (bz - az) + r * (cz - az)
                    away = (px - x) * (px - x) + (py - y) * (py - y) + (pz - z) * (pz - z)
                    point = (i * counts[1] + j) * counts[2] + k
                    if away <= BAND * BAND and np.float32(away) < square[point]:
                        square[point] = away
                        near[3 * point], near[3 * point + 1], near[3 * point + 2] = x, y, z


@kernel
def sweep(way, counts, square, near):
    """Pass the nearest place on from point to point, once through the grid; the bits of `way` turn it."""
    nx, ny, nz = counts
    turn_x, turn_y, turn_z = way & 1, (way >> 1) & 1, (way >> 2) & 1
    back_x, back_y, back_z = (ny * nz if turn_x else -ny * nz), (nz if turn_y else -nz), (1 if turn_z else -1)
    for row in range(nx):
        i = nx - 1 - row if turn_x else row
        for column in range(ny):
            j = ny - 1 - column if turn_y else column
            for depth in range(nz):
                k = nz - 1 - depth if turn_z else depth
                point = (i * ny + j) * nz + k
                best, source = float(square[point]), -1
                # The seven neighbours that were passed before this point; bits: along which axes they are
                for behind in range(1, 8):
                    if (
                        (row == 0 and behind & 1)
                        or (column == 0 and behind & 2)
                        or (depth == 0 and behind & 4)
                    ):
                        continue
                    other = point
                    other += back_x if behind & 1 else 0
                    other += back_y if behind & 2 else 0
                    other += back_z if behind & 4 else 0
                    if square[other] < FAR:
                        x = float(i) - float(near[3 * other])
                        y = float(j) - float(near[3 * other + 1])
                        z = float(k) - float(near[3 * other + 2])
                        away = x * x + y * y + z * z
                        if away < best:
                            best, source = away, other
                if source >= 0:
                    square[point] = best
                    for n in range(3):
                        near[3 * point + n] = near[3 * source + n]
