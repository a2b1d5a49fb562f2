"""A scene with fewer faces: small enough to follow a method face by face."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene
from eyeline.scene.surface import Surface

FINEST, COARSEST = 256, 2  # cells along the scene's diagonal


@dataclass(frozen=True, eq=False)
class Reduced:
    """A scene to explain, and what was done to it."""

    scene: Scene
    notice: str  # a sentence; empty where nothing was done


def reduced(scene: Scene, most_faces: int) -> Reduced:
    """A posed scene with at most about so many faces, by clustering its vertices. [Rossignac93]

    A smaller scene comes back as it is. In a larger one the vertices in one cell of a grid become one, the
    grid as fine as the limit allows; the faces are numbered anew.
    """
    count = scene.face_count
    if count <= most_faces:
        return Reduced(scene, "")
    surfaces = [surface for surface in scene.surfaces if surface.visible]
    cells = FINEST
    while True:
        size = scene.bounds.diagonal / cells
        meshes = [clustered(surface, size) for surface in surfaces]
        kept = sum(len(mesh.faces) for mesh in meshes)
        if kept <= most_faces or cells <= COARSEST:
            break
        # Faces grow with the square of the cells along a side
        cells = max(COARSEST, min(cells - 1, int(cells * np.sqrt(most_faces / kept))))
    nodes = [
        Node(scene.paths[surface.node], mesh=mesh)
        for surface, mesh in zip(surfaces, meshes, strict=True)
        if len(mesh.faces)
    ]
    notice = f"the scene has {count:,} faces; what is shown has {kept:,}, its vertices merged"
    return Reduced(Scene.of(*nodes, name=scene.name), notice)


def clustered(surface: Surface, size: float) -> Mesh:
    """A surface in world space, the vertices in each cell of a grid moved to their middle and made one."""
    mesh = surface.mesh
    points = transform.apply(surface.world_from_mesh, mesh.points.astype(np.float64))
    cell = np.floor(points / size).astype(np.int64)
    _, owner = distinct(cell - cell.min(axis=0, initial=0))
    faces, kept = whole_faces(owner[mesh.faces])
    weight = np.bincount(owner).astype(np.float64)
    middle: FloatArray = np.stack([np.bincount(owner, points[:, k]) / weight for k in range(3)], axis=1)
    if surface.mirrored:
        faces = faces[:, ::-1]
    return Mesh(
        middle,
        faces,
        materials=mesh.materials,
        face_material=None if mesh.face_material is None else mesh.face_material[kept],
        name=mesh.name,
    )


def whole_faces(faces: IntArray) -> tuple[IntArray, IntArray]:
    """Faces (F, 3) with three corners, each once, and which of all they are."""
    whole = np.flatnonzero((faces != np.roll(faces, 1, axis=1)).all(axis=1))
    first, _ = distinct(np.sort(faces[whole], axis=1))
    kept = whole[np.sort(first)]
    return faces[kept], kept


def distinct(rows: IntArray) -> tuple[IntArray, IntArray]:
    """The first of each kind of row (N, K), in rising order, and the kind of each (N,). No number is below 0.

    As np.unique by rows, which compares whole rows and takes five times as long for a million of them.
    """
    key = rows[:, 0]
    for column in rows.T[1:]:
        _, key = np.unique(key, return_inverse=True)
        key = key * (column.max(initial=0) + 1) + column
    _, first, kind = np.unique(key, return_index=True, return_inverse=True)
    return first, kind
