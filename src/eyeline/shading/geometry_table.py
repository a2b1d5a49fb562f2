"""Everything that gathering attributes needs to know about the meshes, as flat arrays for kernels."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.projection.projected import Projected
from eyeline.scene.mesh import Mesh
from eyeline.shading.joined import Array, joined

# Columns of `places`: the first row of a surface's mesh in each flat array; -1 where it has none
FACES, POINTS, NORMALS, TANGENTS, UV0, UV1, COLORS, FACE_MATERIAL = range(8)
MATERIAL, MIRRORED = 8, 9
# Columns of `matrices`, row by row: picture_from_mesh (3, 4) to x w, y w, w in pixels;
# world_from_mesh (3, 4), seen from the eye; its inverse transpose (3, 3), for normals
PICTURE, WORLD, NORMAL = 0, 12, 24


class Geometry(NamedTuple):
    """S surfaces over the meshes they share."""

    first_faces: IntArray  # (S + 1,) int64 scene face where each begins
    places: IntArray  # (S, 10) int64
    matrices: FloatArray  # (S, 33) float64
    faces: IntArray  # flat int32, into the points of their own mesh
    points: FloatArray  # flat float32, as all below
    normals: FloatArray
    tangents: FloatArray
    uv0: FloatArray
    uv1: FloatArray
    colors: FloatArray
    face_material: IntArray  # flat int32


def geometry_of(projected: Projected, first_materials: Sequence[int]) -> Geometry:
    """The table of what a camera sees; first_materials: for each of `meshes_of`, the row of its first."""
    meshes = meshes_of(projected)
    index_of = {id(mesh): index for index, mesh in enumerate(meshes)}
    starts, arrays = _joined_columns(meshes)
    places = np.zeros((len(projected.surfaces), 10), np.int64)
    for row, surface in zip(places, projected.surfaces, strict=True):
        index = index_of[id(surface.mesh)]
        row[: len(starts)] = starts[:, index]
        row[MATERIAL], row[MIRRORED] = first_materials[index], surface.mirrored
    first_faces = projected.first_faces.astype(np.int64)
    return Geometry(first_faces, places, _matrices(projected), *arrays)


def meshes_of(projected: Projected) -> list[Mesh]:
    """Every mesh once, in the order of the surfaces."""
    return list({id(surface.mesh): surface.mesh for surface in projected.surfaces}.values())


def _joined_columns(meshes: Sequence[Mesh]) -> tuple[IntArray, list[Array]]:
    """(8, meshes) first rows or -1, and the flat arrays."""

    def uv(mesh: Mesh, index: int) -> FloatArray | None:
        return mesh.uv[index] if len(mesh.uv) > index else None

    columns: list[tuple[list[Array | None], type]] = [
        ([mesh.faces for mesh in meshes], np.int32),
        ([mesh.points for mesh in meshes], np.float32),
        ([mesh.normals for mesh in meshes], np.float32),
        ([mesh.tangents for mesh in meshes], np.float32),
        ([uv(mesh, 0) for mesh in meshes], np.float32),
        ([uv(mesh, 1) for mesh in meshes], np.float32),
        ([mesh.colors for mesh in meshes], np.float32),
        ([mesh.face_material for mesh in meshes], np.int32),
    ]
    starts = np.full((len(columns), len(meshes)), -1, np.int64)
    flat = []
    for row, (arrays, dtype) in zip(starts, columns, strict=True):
        there = [array for array in arrays if array is not None]
        ends = np.cumsum([0, *(len(array) for array in there)])
        row[[array is not None for array in arrays]] = ends[:-1]
        flat.append(joined(there, dtype))
    return starts, flat


def _matrices(projected: Projected) -> FloatArray:
    """(S, 33)."""
    placed = np.array([surface.world_from_mesh for surface in projected.surfaces]).reshape(-1, 4, 4)
    width, height = projected.width, projected.height
    # Clip space x, y in -w..w, y up, to pixels, y down
    half = np.array([[width / 2, 0, 0, width / 2], [0, -height / 2, 0, height / 2], [0, 0, 0, 1]])
    picture = half @ projected.clip_from_world @ placed
    world = placed[:, :3].copy()
    world[:, :, 3] -= projected.camera.world_from_eye[:3, 3]
    turned = placed[:, :3, :3]
    # The cofactors are the inverse transpose times the determinant, and exist for flattened meshes too
    a, b, c = turned[:, :, 0], turned[:, :, 1], turned[:, :, 2]
    cofactors = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=-1)
    side = np.where(np.linalg.det(turned) < 0, -1.0, 1.0)
    size = np.sqrt((cofactors**2).sum(axis=(1, 2))).clip(min=np.finfo(np.float64).tiny)
    normal = cofactors * (side / size)[:, None, None]
    flat = [one.reshape(len(placed), one.shape[1] * one.shape[2]) for one in (picture, world, normal)]
    return np.concatenate(flat, axis=1)
