"""The octrees of a picture, where they stand, and in which order they are walked.

A mesh has one octree, kept with it, however often it stands; a standing is a matrix, the number of its first
face and the sides that count. Faces that are on the picture's grid already, pieces of cut ones among them,
have a tree of their own over their pixels and depths, which stands once.
"""

from __future__ import annotations

import weakref
from typing import NamedTuple

import numpy as np

from eyeline.geometry.arrays import ByteArray, FloatArray, IntArray, read_only
from eyeline.geometry.octree import BEGIN, Octree, joined, octree_of
from eyeline.projection.projected import Projected
from eyeline.projection.sides import sides_of
from eyeline.scene.mesh import Mesh

Sides = int | ByteArray

_trees: weakref.WeakKeyDictionary[Mesh, Octree] = weakref.WeakKeyDictionary()


class Forest(NamedTuple):
    """Octrees in flat arrays, and S standings of them; what a kernel takes."""

    boxes: FloatArray  # (6 N,)
    nodes: IntArray  # (N * WIDTH,)
    points: FloatArray  # (3 P,)
    corners: ByteArray  # (3 F,)
    numbers: IntArray  # (F,)
    on_grid: bool  # whether points are xy in 1/256 pixel and depth: no matrix applies
    matrices: FloatArray  # (S, 16) float32 clip_from_mesh
    roots: IntArray  # (S,) int32
    firsts: IntArray  # (S,) int32: added to a face's number
    sides: ByteArray  # of all faces that differ in them, and single ones
    sides_at: IntArray  # (S, 2) int64: those of slot k are at the first plus k times the second


class Standing(NamedTuple):
    """One standing of a tree, before it is packed."""

    tree: Octree
    sides: Sides  # of all its faces, or of each row
    matrix: FloatArray  # (4, 4); of a tree on the grid, whatever
    first: int  # added to the numbers


def tree_of(mesh: Mesh) -> Octree:
    """The octree of a mesh, grown when first asked for and kept as long as the mesh."""
    if mesh not in _trees:
        _trees[mesh] = octree_of(mesh.points, mesh.faces)
    return _trees[mesh]


def of_surfaces(projected: Projected, cull: str) -> Forest:
    """The surfaces of a picture as they stand: each mesh's tree once, no face copied."""
    found = []
    known: dict[tuple[int, bool], Sides] = {}
    mirrored = np.linalg.det(projected.places[:, :3, :3]) < 0
    for k, surface in enumerate(projected.surfaces):
        if not surface.visible or not len(surface.mesh.faces):
            continue
        which = id(surface.mesh), bool(mirrored[k])
        if which not in known:
            known[which] = sides_of(surface, cull)
        matrix = projected.clip_from_meshes[k]
        found.append(Standing(tree_of(surface.mesh), known[which], matrix, surface.first_face))
    return planted(found)


def of_faces(projected: Projected) -> Forest:
    """The faces of a picture as its arrays give them."""
    sides = np.broadcast_to(projected.sides, len(projected.faces))
    shown = np.flatnonzero(sides)
    points = np.concatenate([projected.xy, projected.depth[:, None]], axis=1).astype(np.float32)
    return on_grid(points, projected.faces[shown], projected.source[shown], sides[shown])


def on_grid(points: FloatArray, faces: IntArray, numbers: IntArray, sides: ByteArray) -> Forest:
    """A tree over faces whose points (V, 3) float32 are xy in 1/256 pixel, exact below 2**24, and depth."""
    tree = octree_of(points, faces, numbers, cubic=False)
    return planted([Standing(tree, sides, np.zeros((4, 4)), 0)] if len(faces) else [], on_grid=True)


def planted(standings: list[Standing], on_grid: bool = False) -> Forest:
    """Standings packed for kernels."""
    trees: dict[int, Octree] = {id(one.tree): one.tree for one in standings}
    places = {key: k for k, key in enumerate(trees)}
    whole, tops = joined(
        list(trees.values()) or [octree_of(np.empty((0, 3), np.float32), np.empty((0, 3), np.int32))]
    )
    roots = np.array([tops[places[id(one.tree)]] for one in standings], np.int32)
    flat = (read_only(part).reshape(-1) for part in (whole.boxes, whole.nodes, whole.points, whole.corners))
    boxes, nodes, points, corners = flat
    matrices = np.array([one.matrix for one in standings], np.float32).reshape(-1, 16)
    firsts = np.array([one.first for one in standings], np.int32)
    sides, sides_at = pooled(standings, whole.nodes[roots, BEGIN])
    numbers = read_only(whole.numbers)
    return Forest(boxes, nodes, points, corners, numbers, on_grid, matrices, roots, firsts, sides, sides_at)


def pooled(standings: list[Standing], begins: IntArray) -> tuple[ByteArray, IntArray]:
    """The sides of all standings, those that are the same once, and where each finds them by the slot.

    begins: (S,) the first slot of each one's tree.
    """
    pool: list[ByteArray] = [np.empty(0, np.uint8)]
    where: dict[int, tuple[int, int]] = {}
    filled, sides_at = 0, np.empty((len(standings), 2), np.int64)
    for k, one in enumerate(standings):
        # Arrays by what they are, numbers by what they say
        key = id(one.sides) if isinstance(one.sides, np.ndarray) else -one.sides
        if key not in where:
            each = isinstance(one.sides, np.ndarray)
            pool.append(np.atleast_1d(np.uint8(one.sides)))
            if each:
                pool[-1] = pool[-1][one.tree.rows]
            where[key] = (filled - int(begins[k]) * each, int(each))
            filled += len(pool[-1])
        sides_at[k] = where[key]
    return np.concatenate(pool), sides_at
