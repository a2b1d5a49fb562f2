"""Directions on a surface: of its faces, of its vertices, split at creases, and tangents along a texture."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import BoolArray, FloatArray, IntArray

SOMEWHERE = (0.0, 0.0, 1.0)  # the normal where the faces tell none


@dataclass(frozen=True, eq=False)
class Creased:
    """Faces over vertices that are split wherever the surface has an edge; only used vertices are kept."""

    faces: IntArray  # (F, 3) int32, the same faces in the same order, into the new vertices
    source: IntArray  # (V,) the vertex each new one is split from, ascending
    normals: FloatArray  # (V, 3) float32 unit


def face_normals(points: FloatArray, faces: IntArray) -> FloatArray:
    """(F, 3) float64 unit, towards the side that turns counter-clockwise; zero for a face without area."""
    a, b, c = (points[faces[:, k]].astype(np.float64) for k in range(3))
    return unit(np.cross(b - a, c - a))


def vertex_normals(points: FloatArray, faces: IntArray) -> FloatArray:
    """(V, 3) float32 unit: the mean of the faces around a vertex, weighted by their angles there.

    So it does not matter how a flat polygon is cut into triangles. [Thuermer98]
    """
    sums = corner_sums(faces, corner_angles(points, faces), face_normals(points, faces), len(points))
    return unit(sums, SOMEWHERE).astype(np.float32)


def creased(points: FloatArray, faces: IntArray, angle: float) -> Creased:
    """Split vertices where faces meet at more than `angle` radians: edges are crisp and the rest is smooth.

    Faces around a vertex stay together while one follows another over edges that turn less. A face without
    area keeps to itself. Faces meet where they share vertices: merge those that only lie at one place first.
    """
    flat = face_normals(points, faces)
    one, other = smooth_edges(faces, flat, math.cos(angle))
    fan = together(3 * len(faces), one, other)
    # New vertices stand in the order of the old ones
    leader = np.flatnonzero(fan == np.arange(len(fan)))
    old = faces.reshape(-1)[leader]
    order = np.argsort(old, kind="stable")
    count = len(leader)
    rank = np.empty(3 * len(faces), dtype=np.int32)
    rank[leader[order]] = np.arange(count, dtype=np.int32)
    split = rank[fan].reshape(-1, 3)
    normals = unit(corner_sums(split, corner_angles(points, faces), flat, count), SOMEWHERE)
    return Creased(split, old[order], normals.astype(np.float32))


def tangents(points: FloatArray, faces: IntArray, normals: FloatArray, uv: FloatArray) -> FloatArray:
    """(V, 4) float32: xyz unit and perpendicular to the normal, along growing u; w the bitangent's side.

    bitangent = w * cross(normal, tangent) runs along falling v, up the image. [Mikkelsen08]
    Weighted by the angles of the faces, as MikkTSpace does; no vertex is split, so where a mirrored texture
    meets itself in one vertex the wider side decides.
    """
    a, b, c = (points[faces[:, k]].astype(np.float64) for k in range(3))
    s, t, r = (uv[faces[:, k]].astype(np.float64) * (1, -1) for k in range(3))
    edge, other = b - a, c - a
    (du, dv), (du_other, dv_other) = (t - s).T[:, :, None], (r - s).T[:, :, None]
    side = np.sign(du * dv_other - du_other * dv)
    along_u = unit(side * (edge * dv_other - other * dv))
    along_v = unit(side * (other * du - edge * du_other))
    weights = corner_angles(points, faces) * (side != 0)
    n = normals.astype(np.float64)
    tangent = corner_sums(faces, weights, along_u, len(points))
    bitangent = corner_sums(faces, weights, along_v, len(points))
    tangent = unit(tangent - n * (n * tangent).sum(axis=1, keepdims=True))
    lost = ~tangent.any(axis=1)
    tangent[lost] = perpendicular(n[lost])
    right_handed = (np.cross(n, tangent) * bitangent).sum(axis=1) >= 0
    return np.column_stack([tangent, np.where(right_handed, 1, -1)]).astype(np.float32)


# --- the parts --------------------------------------------------------------------------------------------


def unit(vectors: FloatArray, otherwise: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> FloatArray:
    """Vectors (N, 3) of length one; `otherwise` where there is no direction."""
    largest = np.abs(vectors).max(axis=1, keepdims=True, initial=0)
    scaled = vectors / np.where(largest > 0, largest, 1)
    length = np.sqrt((scaled * scaled).sum(axis=1, keepdims=True))
    return np.where(largest > 0, scaled / np.where(largest > 0, length, 1), otherwise)


def perpendicular(vectors: FloatArray) -> FloatArray:
    """(N, 3) some unit vector at a right angle to each of the unit vectors (N, 3)."""
    x_least = np.abs(vectors[:, :1]) < 0.5
    return unit(np.cross(vectors, np.where(x_least, (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))))


def corner_angles(points: FloatArray, faces: IntArray) -> FloatArray:
    """(F, 3) the angle of a face at each of its corners, radians; zero where two corners are one."""
    corners = [points[faces[:, k]].astype(np.float64) for k in range(3)]
    edges = [unit(corners[(k + 1) % 3] - corners[k]) for k in range(3)]
    missing = [~edge.any(axis=1) for edge in edges]
    angles = np.empty(faces.shape)
    for k in range(3):
        before = (k + 2) % 3
        cosine = -(edges[k] * edges[before]).sum(axis=1)
        angles[:, k] = np.where(missing[k] | missing[before], 0, np.arccos(np.clip(cosine, -1, 1)))
    return angles


def corner_sums(faces: IntArray, weights: FloatArray, vectors: FloatArray, count: int) -> FloatArray:
    """(count, 3) for each vertex, the face vectors (F, 3) around it times their weights (F, 3) there."""
    corners = faces.reshape(-1)
    columns = [
        np.bincount(corners, weights=(weights * vectors[:, k, None]).reshape(-1), minlength=count)
        for k in range(3)
    ]
    return np.stack(columns, axis=1)


def smooth_edges(faces: IntArray, normals: FloatArray, least_cosine: float) -> tuple[IntArray, IntArray]:
    """Pairs of corners that are one vertex of a smooth surface: two for every edge that two faces share.

    A corner is numbered 3 * face + place. An edge of more than two faces joins them as they follow in number.
    """
    begin = np.concatenate([faces[:, k] for k in range(3)]).astype(np.int64)
    end = np.concatenate([faces[:, (k + 1) % 3] for k in range(3)]).astype(np.int64)
    place = np.arange(3 * len(faces))
    face, k = place % max(len(faces), 1), place // max(len(faces), 1)
    low, high = np.minimum(begin, end), np.maximum(begin, end)
    order = np.argsort(low * (1 + high.max(initial=0)) + high, kind="stable")
    one, other = order[:-1], order[1:]
    shared: BoolArray = (low[one] == low[other]) & (high[one] == high[other])
    one, other = one[shared], other[shared]
    cosine = (normals[face[one]] * normals[face[other]]).sum(axis=1)
    flat = cosine >= least_cosine
    one, other = one[flat], other[flat]
    here, there = 3 * face[one] + k[one], 3 * face[other] + k[other]
    here_next, there_next = 3 * face[one] + (k[one] + 1) % 3, 3 * face[other] + (k[other] + 1) % 3
    same_way = begin[one] == begin[other]
    return (
        np.concatenate([here, here_next]),
        np.concatenate([np.where(same_way, there, there_next), np.where(same_way, there_next, there)]),
    )


def together(count: int, one: IntArray, other: IntArray) -> IntArray:
    """(count,) for each thing the lowest of all that pairs one, other (N,) join it to. [Shiloach82]"""
    lowest = np.arange(count)
    while len(one):
        a, b = lowest[one], lowest[other]
        apart = a != b
        one, other = one[apart], other[apart]
        np.minimum.at(lowest, np.maximum(a, b)[apart], np.minimum(a, b)[apart])
        while (lowest != (higher := lowest[lowest])).any():
            lowest = higher
    return lowest
