"""Weights by how far bones are through the body, in small cubes: for any mesh, closed or not. [Dionne13]"""

from __future__ import annotations

from itertools import product

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import dijkstra

from eyeline.geometry.arrays import BoolArray, FloatArray, IntArray
from eyeline.geometry.bounds import Bounds
from eyeline.rigging.bones import Bones
from eyeline.shapes.grid import Grid
from eyeline.shapes.winding import inside

CELLS = 96  # along the body's longest side
FALL = 8  # a joint twice as far has 1/256 of the weight
ROUNDS = 6  # of evening out
FEW = 1e-6  # of a vertex's surroundings
NONE = -1
NEAR = 1e-6  # of a step: an edge of no length is none


def voxel_weights(points: FloatArray, faces: IntArray, bones: Bones, cells: int = CELLS) -> FloatArray:
    """How much each joint moves a vertex (V, J): at least 0, rows add up to 1.

    points: (V, 3) float64, faces: (F, 3); open, crossing or in parts. A weight falls with the length of
    the shortest way from the bone through what is solid: never through the air between two legs.
    """
    grid = Grid.around(Bounds.of(points.astype(np.float32)), cells)
    within = inside(grid, points, faces)
    solid = np.flatnonzero(within | _touched(grid, points, faces))
    ways = _ways(grid, solid, within[solid])
    distance = _lengths(grid, solid, ways, bones)
    nearest = distance.min(axis=1, keepdims=True)
    # Where no bone comes through the solid, straight ones are better than none
    lost = ~np.isfinite(nearest[:, 0])
    places = _places(grid, solid[lost])
    away = places[:, None] - bones.nearest(places)
    distance[lost] = bones.of_joints(np.sqrt((away * away).sum(axis=2)))
    nearest[lost, 0] = distance[lost].min(axis=1)
    weights = ((nearest + grid.step / 2) / (distance + grid.step / 2)) ** FALL
    weights = _smoothed(weights / weights.sum(axis=1, keepdims=True), ways)
    # Of the grid points around a vertex those within the body count, if there are any
    numbers, shares = _cell_corners(grid, points)
    kept = shares * within[numbers]
    shares = np.where(kept.sum(axis=1, keepdims=True) > FEW, kept, shares)
    shares /= shares.sum(axis=1, keepdims=True)
    found: FloatArray = (weights[np.searchsorted(solid, numbers)] * shares[:, :, None]).sum(axis=1)
    return found


def _touched(grid: Grid, points: FloatArray, faces: IntArray) -> BoolArray:
    """(K,) the grid points next to the surface: of its cells, those at all eight corners."""
    corners = points[faces]
    longest = np.sqrt(((np.roll(corners, -1, axis=1) - corners) ** 2).sum(axis=2)).max(axis=1)
    touched = np.zeros(grid.size, dtype=bool)
    touched[_cell_corners(grid, points)[0].reshape(-1)] = True
    pieces = np.maximum(np.ceil(2 * longest / grid.step).astype(int), 1)
    for count in np.unique(pieces):
        u, v = (one.reshape(-1) / count for one in np.mgrid[0 : count + 1, 0 : count + 1])
        within = u + v <= 1
        parts = np.stack([1 - u - v, u, v], axis=1)[within]
        some = np.einsum("pk,fkn->fpn", parts, corners[pieces == count]).reshape(-1, 3)
        touched[_cell_corners(grid, some)[0].reshape(-1)] = True
    return touched


def _cell_corners(grid: Grid, points: FloatArray) -> tuple[IntArray, FloatArray]:
    """Numbers (N, 8) of the grid points around each place, and how much each counts (N, 8)."""
    place = grid.places(points)
    low = np.clip(np.floor(place).astype(np.int64), 0, np.array(grid.counts) - 2)
    part = place - low
    numbers, shares = [], []
    for corner in product((0, 1), repeat=3):
        at = low + corner
        numbers.append((at[:, 0] * grid.counts[1] + at[:, 1]) * grid.counts[2] + at[:, 2])
        shares.append(np.where(corner, part, 1 - part).prod(axis=1))
    return np.stack(numbers, axis=1), np.stack(shares, axis=1)


def _ways(grid: Grid, solid: IntArray, within: BoolArray) -> sparse.csr_array:
    """(S, S) metres from solid grid points to the solid ones of the 26 around each; none is on the border.

    A point beside the body is the end of a way out of it, so that none leads over to a part nearby; only
    sheets too thin to hold a point are gone through on their sides.
    """
    index = np.full(grid.size, NONE, dtype=np.int64)
    index[solid] = np.arange(len(solid))
    strides = grid.counts[1] * grid.counts[2], grid.counts[2], 1
    rows, columns, lengths = [], [], []
    for way in product((-1, 0, 1), repeat=3):
        if way == (0, 0, 0):
            continue
        other = index[solid + int(np.dot(way, strides))]
        there = np.flatnonzero(other != NONE)
        rows.append(there)
        columns.append(other[there])
        lengths.append(np.full(len(there), grid.step * float(np.sqrt(np.dot(way, way)))))
    row, column, length = (np.concatenate(part) for part in (rows, columns, lengths))
    beside = ~within & (np.bincount(row, within[column], len(solid)) > 0)
    open_way = ~beside[row] | (~within[column] & ~beside[column])
    place = row[open_way], column[open_way]
    return sparse.csr_array((length[open_way], place), shape=(len(solid), len(solid)))


def _lengths(grid: Grid, solid: IntArray, ways: sparse.csr_array, bones: Bones) -> FloatArray:
    """(S, J) metres from each joint's bones to each solid grid point through others; inf where none leads."""
    far = np.full((len(solid), len(bones.names)), np.inf)
    for joint in np.unique(bones.joint):
        own = bones._replace(start=bones.start[bones.joint == joint], end=bones.end[bones.joint == joint])
        near, away = _beside(grid, solid, own)
        # One point more, from which all that lie along the joint's bones are reached
        row = (
            np.append(ways.data, away),
            np.append(ways.indices, near),
            np.append(ways.indptr, ways.nnz + len(near)),
        )
        graph = sparse.csr_array(row, shape=(len(solid) + 1, len(solid) + 1))
        far[:, joint] = dijkstra(graph, indices=[len(solid)])[0, :-1]
    return far


def _beside(grid: Grid, solid: IntArray, own: Bones) -> tuple[IntArray, FloatArray]:
    """Which solid grid points are around one joint's bones, and how far off; at least the nearest one."""
    places = _places(grid, solid)
    away = places[:, None] - own.nearest(places)
    distance = np.maximum(np.sqrt((away * away).sum(axis=2)).min(axis=1), NEAR * grid.step)
    near = np.flatnonzero(distance <= grid.step)
    if len(near) == 0:
        near = np.array([int(distance.argmin())])
    return near, distance[near]


def _smoothed(weights: FloatArray, ways: sparse.csr_array) -> FloatArray:
    """Weights (S, J) evened out along ways: those along a grid are longer where they are slanted."""
    alike = sparse.csr_array((np.ones(ways.nnz), ways.indices, ways.indptr), shape=ways.shape)
    joined = sparse.csr_array(alike.T + sparse.eye_array(len(weights)))
    count: FloatArray = np.asarray(joined.sum(axis=1)).reshape(-1, 1)
    for _ in range(ROUNDS):
        weights = (joined @ weights) / count
    return weights


def _places(grid: Grid, numbers: IntArray) -> FloatArray:
    """(N, 3) metres of grid points by their flat numbers."""
    counted = np.stack(np.unravel_index(numbers, grid.counts), axis=1)
    places: FloatArray = grid.low + grid.step * counted
    return places
