"""Faces that may hide something, all of them on the grid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.drawing.grid import Grid, turn
from eyeline.drawing.model import Model
from eyeline.geometry.arrays import FloatArray, IntArray, read_only
from eyeline.geometry.cells import Cells
from eyeline.jit import kernel, share, threads
from eyeline.projection.clipping import Pieces, cut

SMALL = 1 << 14  # faces: fewer are not worth a second thread
STEPS = 65535  # of depth, to sort by: enough to meet early what hides most, and to sort fast


@dataclass(frozen=True, eq=False)
class Corners:
    """Triangles over points of the grid, cut where they must be."""

    screen: FloatArray  # (P, 3) grid x, grid y, depth
    faces: IntArray  # (H, 3) int32
    source: IntArray  # (H,) int32: the face of the model each is cut from


@dataclass(frozen=True, eq=False)
class Hiders:
    """Faces that may hide something, nearest first as far as that is cheap."""

    source: IntArray  # (H,) int32: the face of the model each is cut from
    corners: FloatArray  # (H, 9) x, y, depth of three corners that turn clockwise
    nearest: FloatArray  # (H,) least depth
    cells: Cells
    reach: IntArray  # (H, 4) int32: first column, first row, last column, last row of cells
    farthest: FloatArray  # (rows * columns,) the greatest depth of strokes in each cell; -inf is none


def corners_of(model: Model, facing: IntArray, grid: Grid) -> Corners:
    """Every face that is seen from one of its sides, cut to near, far and the guard band."""
    shown = facing != 0
    away = shown & model.outside[model.faces].any(axis=1) if model.outside.any() else np.zeros_like(shown)
    whole = np.flatnonzero(shown & ~away).astype(np.int32)
    rows = np.flatnonzero(away).astype(np.int32)
    if len(rows) == 0:
        return Corners(model.screen, model.faces[whole], whole)
    vertex = model.faces[rows]
    corners = np.ones((*vertex.shape, 4))
    corners[..., :3] = model.points[vertex]
    pieces = Pieces(corners, np.where(model.outside[vertex], -1, vertex), rows)
    for plane in grid.planes:
        pieces = cut(pieces, plane)
    new = pieces.vertex < 0
    added, _ = grid.place(pieces.corners[new][:, :3])
    faces = pieces.vertex.astype(np.int32)
    faces[new] = len(model.screen) + np.arange(len(added), dtype=np.int32)
    return Corners(
        np.concatenate([model.screen, added]),
        np.concatenate([model.faces[whole], faces]),
        np.concatenate([whole, pieces.source]).astype(np.int32),
    )


def hiders_of(corners: Corners, cells: Cells, farthest: FloatArray) -> Hiders:
    """The faces that come before a stroke in one of the cells they touch.

    farthest: (rows * columns,) the greatest depth of strokes in each cell, -inf where there is none.
    """
    count = len(corners.faces)
    depth = np.empty(count)
    parts = threads() if count > SMALL else 1
    given = (read_only(corners.screen), read_only(corners.faces), cells.shift, cells.columns, cells.rows)
    share(lambda part: _depths(part, parts, *given, read_only(farthest), depth), parts)
    order = nearest_first(depth)
    size = len(order)
    places, reach = np.empty((size, 9)), np.empty((size, 4), np.int32)
    share(lambda part: _gather(part, parts, *given, order, places, reach), parts)
    return Hiders(corners.source[order], places, depth[order], cells, reach, farthest)


def nearest_first(depth: FloatArray) -> IntArray:
    """Rows by depth, roughly; those of infinite depth are left out."""
    rows = np.flatnonzero(depth < np.inf)
    depth = depth[rows] - depth.min(initial=np.inf)
    step = depth.max(initial=0) / STEPS
    return rows[np.argsort((depth / (step or 1)).astype(np.uint16), kind="stable")]


@kernel
def _depths(part, parts, screen, faces, shift, columns, rows, farthest, depth):
    """The nearest depth of each face; infinite if it is edge-on, or all strokes in its cells are nearer."""
    count = faces.shape[0]
    for face in range(count * part // parts, count * (part + 1) // parts):
        a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
        nearest, before = min(screen[a, 2], screen[b, 2], screen[c, 2]), False
        first = max(int(min(screen[a, 0], screen[b, 0], screen[c, 0]) - 1.0), 0) >> shift
        last = int(max(screen[a, 0], screen[b, 0], screen[c, 0], -2.0) + 1.0) >> shift
        row = max(int(min(screen[a, 1], screen[b, 1], screen[c, 1]) - 1.0), 0) >> shift
        end = int(max(screen[a, 1], screen[b, 1], screen[c, 1], -2.0) + 1.0) >> shift
        last, end = min(last, columns - 1), min(end, rows - 1)
        if turn(screen[a, 0], screen[a, 1], screen[b, 0], screen[b, 1], screen[c, 0], screen[c, 1]) == 0.0:
            end = row - 1
        while row <= end and not before:
            for column in range(first, last + 1):
                before |= nearest < farthest[row * columns + column]
            row += 1
        depth[face] = nearest if before else np.inf


@kernel
def _gather(part, parts, screen, faces, shift, columns, rows, order, corners, reach):
    count = order.shape[0]
    for i in range(count * part // parts, count * (part + 1) // parts):
        a, b, c = faces[order[i], 0], faces[order[i], 1], faces[order[i], 2]
        if turn(screen[a, 0], screen[a, 1], screen[b, 0], screen[b, 1], screen[c, 0], screen[c, 1]) < 0.0:
            b, c = c, b
        for k in range(3):
            corners[i, k], corners[i, 3 + k], corners[i, 6 + k] = screen[a, k], screen[b, k], screen[c, k]
        for k in range(2):
            low = min(screen[a, k], screen[b, k], screen[c, k]) - 1.0
            high = max(screen[a, k], screen[b, k], screen[c, k]) + 1.0
            reach[i, k] = max(int(low), 0) >> shift
            reach[i, 2 + k] = min(int(max(high, -1.0)) >> shift, (columns if k == 0 else rows) - 1)
