"""Which faces must be cut before they can be drawn, and the picture with their pieces in it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from eyeline.geometry.arrays import ByteArray, FloatArray, IntArray, read_only
from eyeline.geometry.fixedpoint import UNITS
from eyeline.jit import kernel
from eyeline.projection.clipping import Pieces, clip_space, clipped, joined, snapped
from eyeline.projection.projected import Projected
from eyeline.projection.vertices import place

BATCH = 1 << 15  # faces cut at once: what that takes stays small, however many there are


def with_pieces(projected: Projected, unplaced: list[int]) -> Projected:
    """`projected` with every face that has an unplaced vertex withdrawn, and its pieces at the end.

    unplaced: how many vertices of each surface could not be placed.
    """
    sides = np.array(np.broadcast_to(projected.sides, projected.face_count))
    found, first_vertex = [], 0
    for number, (surface, missing) in enumerate(zip(projected.surfaces, unplaced, strict=True)):
        if missing:
            first, end = int(projected.first_faces[number]), int(projected.first_faces[number + 1])
            crossing = withdraw(projected, first, end, sides)
            matrix = projected.clip_from_meshes[number]
            for at in range(0, len(crossing), BATCH):
                faces = crossing[at : at + BATCH]
                points = surface.mesh.points[projected.faces[faces] - first_vertex]
                found.append(pieces_of(projected, faces, clip_space(matrix, points)))
        first_vertex += len(surface.mesh.points)
    return appended(projected, sides, joined(found)) if found else replace(projected, sides=sides)


def withdraw(projected: Projected, first: int, end: int, sides: ByteArray) -> IntArray:
    """Set to 0 the sides of faces first..end with an unplaced vertex; which of them can be seen in part."""
    found = np.empty(end - first, dtype=np.int32)
    faces = read_only(projected.faces[first:end]).reshape(-1)
    right, bottom = projected.width * UNITS, projected.height * UNITS
    xy, depth = read_only(projected.xy).reshape(-1), read_only(projected.depth)
    count = _withdraw(faces, xy, depth, (right, bottom), sides[first:end], found)
    return found[:count] + np.int32(first)


def pieces_of(projected: Projected, faces: IntArray, corners: FloatArray) -> Pieces:
    """What is left of some faces, given their corners (N, 3, 4) in clip space."""
    vertex = projected.faces[faces]
    placed = np.where(np.isfinite(projected.depth[vertex]), vertex, np.int32(-1))
    return clipped(Pieces(corners, placed, faces), (projected.width, projected.height))


def cut_faces(projected: Projected, surface: int, rows: IntArray) -> tuple[IntArray, FloatArray, IntArray]:
    """What is left of some faces of one surface: xy (N, 3, 2), depth (N, 3), and the row each is cut from.

    The same pieces as `with_pieces` makes, without any other face, and not shifted.
    """
    size, matrix = (projected.width, projected.height), projected.clip_from_meshes[surface]
    mesh = projected.surfaces[surface].mesh
    points = mesh.points[mesh.faces[rows]]
    xy, depth = np.empty((3 * len(rows), 2), np.int32), np.empty(3 * len(rows), np.float32)
    place(points.reshape(-1, 3), matrix, size, xy, depth)
    placed = np.where(np.isfinite(depth), np.arange(len(depth)), -1).reshape(-1, 3)
    pieces = clipped(Pieces(clip_space(matrix, points), placed, rows), size)
    xy, depth, new = xy[pieces.vertex], depth[pieces.vertex], pieces.vertex < 0
    xy[new], depth[new] = snapped(pieces.corners[new], size)
    return xy, depth, pieces.source


def appended(projected: Projected, sides: ByteArray, pieces: Pieces) -> Projected:
    """`projected` with pieces behind its faces, and behind its vertices those that only pieces have."""
    new = pieces.vertex < 0
    xy, depth = snapped(pieces.corners[new], (projected.width, projected.height))
    faces = pieces.vertex.astype(np.int32)
    faces[new] = len(projected.depth) + np.arange(len(depth), dtype=np.int32)
    of_source = np.broadcast_to(projected.sides, projected.face_count)[pieces.source]
    return replace(
        projected,
        xy=np.concatenate([projected.xy, xy]),
        depth=np.concatenate([projected.depth, depth]),
        faces=np.concatenate([projected.faces, faces]),
        sides=np.concatenate([sides, of_source]),
        piece_source=pieces.source,
    )


@kernel
def _withdraw(faces, xy, depth, size, sides, found):
    count = 0
    for face in range(sides.shape[0]):
        i, j, k = faces[3 * face], faces[3 * face + 1], faces[3 * face + 2]
        low, high = min(depth[i], depth[j], depth[k]), max(depth[i], depth[j], depth[k])
        if low > -np.inf and high < np.inf:
            continue
        shown = sides[face] != 0
        sides[face] = 0
        if low == np.inf or not shown:
            continue
        if high < np.inf:
            # All corners are before the near plane: beside the picture they need no cutting
            xs, ys = (xy[2 * i], xy[2 * j], xy[2 * k]), (xy[2 * i + 1], xy[2 * j + 1], xy[2 * k + 1])
            if max(xs) < 0 or max(ys) < 0 or min(xs) > size[0] or min(ys) > size[1]:
                continue
        found[count] = face
        count += 1
    return count
