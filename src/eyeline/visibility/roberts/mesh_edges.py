"""The edges of all meshes before the camera: each once, with the faces that meet at it.

An edge that leaves the space before the camera is cut where its faces are: at the same points.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.projection.clipping import clip_space, crossing, planes, snapped
from eyeline.projection.projected import Projected
from eyeline.visibility.roberts.structure import structure_of


@dataclass(frozen=True, eq=False)
class MeshEdges:
    """Edges of all meshes, and the groups of faces that may be one convex body, in the picture's numbers."""

    edges: IntArray  # (E, 4) int32: vertex, vertex, uncut face, uncut face or -1
    beyond: IntArray  # (F, 3) int32: the face beyond each side of an uncut face; -1 is none
    start: IntArray  # (G + 1,) int64: where each group's faces begin
    member: IntArray  # (K,) int32 uncut faces
    front: IntArray  # (G,) int8: how a closed group's fronts turn on the screen, 1 clockwise; 0 for a pair


def edges_of(projected: Projected) -> MeshEdges:
    """Every edge that is not flat, of every surface that is shown."""
    beyond = np.full((projected.face_count, 3), -1, np.int32)
    edges, front = list[IntArray]([np.empty((0, 4), np.int32)]), list[IntArray]([np.empty(0, np.int8)])
    start, member = list[IntArray]([np.zeros(1, np.int64)]), list[IntArray]([np.empty(0, np.int32)])
    vertex, members = 0, 0
    for number, surface in enumerate(projected.surfaces):
        face, count = int(projected.first_faces[number]), len(surface.mesh.faces)
        if surface.visible and count:
            shape = structure_of(surface.mesh)
            edges.append(shape.edges + np.array([vertex, vertex, face, face], np.int32))
            edges[-1][shape.edges[:, 3] < 0, 3] = -1
            beyond[face : face + count] = np.where(shape.beyond < 0, -1, shape.beyond + face)
            start.append(shape.start[1:] + members)
            member.append(shape.member + np.int32(face))
            members += len(shape.member)
            front.append(np.where(shape.closed, 1 if surface.mirrored else -1, 0).astype(np.int8))
        vertex += len(surface.mesh.points)
    return MeshEdges(
        np.concatenate(edges), beyond, np.concatenate(start), np.concatenate(member), np.concatenate(front)
    )


def cut_ends(projected: Projected, edges: IntArray, ends: FloatArray) -> FloatArray:
    """Ends (N, 2, 3) of edges (N, 4), those not placed moved to where the edge is cut.

    An edge of which nothing is left becomes a point.
    """
    found = np.zeros_like(ends)
    surface = np.searchsorted(projected.first_faces, edges[:, 2], side="right") - 1
    first = np.cumsum([0, *(len(one.mesh.points) for one in projected.surfaces)])
    for number in np.unique(surface):
        one, rows = projected.surfaces[number], np.flatnonzero(surface == number)
        matrix = transform.product(projected.clip_from_world, one.world_from_mesh)
        corners = clip_space(matrix, one.mesh.points[edges[rows, :2] - first[number]])
        found[rows] = cut(corners, ends[rows], projected)
    return found


def cut(corners: FloatArray, ends: FloatArray, projected: Projected) -> FloatArray:
    """Ends (N, 2, 3) of edges (N, 2, 4) in clip space, cut."""
    placed, alive = np.isfinite(ends[..., 2]), np.ones(len(ends), bool)
    moved = corners.copy()
    size = projected.width, projected.height
    for a, b, c, d in planes(size):
        reach = a * moved[..., 0] + b * moved[..., 1] + c * moved[..., 2] + d * moved[..., 3]
        reach = np.where(placed, np.maximum(reach, 0), reach)
        alive &= (reach >= 0).any(axis=1)
        rows = (reach < 0).any(axis=1) & alive
        middle = crossing(moved[rows, 0], moved[rows, 1], reach[rows, 0], reach[rows, 1])
        moved[rows] = np.where((reach[rows] < 0)[..., None], middle[:, None], moved[rows])
    found = np.where(alive[:, None, None], ends, 0.0)
    new = ~placed & alive[:, None]
    xy, depth = snapped(moved[new], size)
    found[new] = np.concatenate([xy - np.array(projected.shift), depth[:, None]], axis=1)
    return found
