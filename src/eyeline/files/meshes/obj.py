"""OBJ, with the materials and textures of its MTL files; objects or groups become nodes. [Wavefront95]

Read here and not by a library, because face order, numbers that count back, corners with places of their own
in a texture, and polygons that are not convex all matter to a picture.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from eyeline.files.meshes.assembly import Corners, finite_points, linear_from_bytes, refuse_empty, scene_of
from eyeline.files.meshes.mtl import materials_of
from eyeline.files.meshes.obj_corners import chosen, columns, corner_table
from eyeline.files.meshes.obj_statements import Run, Statements, statements
from eyeline.files.meshes.polygons import triangulated
from eyeline.files.meshes.text import numbers, text_of
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.scene.material import DEFAULT, Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene

MOST_NODES = 4096  # a file with more groups becomes one mesh


def read(path: Path) -> Scene:
    """The scene of an OBJ file. Lengths are taken for metres, colours for sRGB."""
    said = statements(text_of(path))
    if not said.faces:
        refuse_empty(said.faces)
    corners, polygon = corners_of(said)
    library, notes = materials_of(path.parent, said.libraries)
    missing = sorted({run.material for run in said.runs} - set(library) - {""})
    if missing and said.libraries:
        notes.append(f"material {missing[0]!r} is not in {said.libraries[0]!r}; what has it is grey")
    if said.undrawn:
        notes.append(f"{said.undrawn} points, lines and curved surfaces are not drawn")
    meshes = parts(said, corners, polygon, library)
    return scene_of(path.stem, meshes, notes)


def corners_of(said: Statements) -> tuple[Corners, IntArray]:
    """All triangles of a file, and (F,) the polygon each is cut from."""
    table, counts = corner_table(said.faces)
    face_of = np.repeat(np.arange(len(counts)), counts)
    points, colors = points_of(said)
    point = chosen(table[:, 0], len(points), "point", face_of)
    triangles, polygon = triangulated(points, point, counts)
    uv = normals = face_uv = face_normals = None
    if table[:, 1].any() and said.uv:
        uv, face_uv = places_of(said, table[:, 1], face_of)
        face_uv = face_uv[triangles]
    if table[:, 2].all() and said.normals:
        normals = finite_points(
            columns(numbers(said.normals, "normal"), said.normals, 3, "normal")[:, :3], "normal"
        )
        face_normals = chosen(table[:, 2], len(normals), "normal", face_of)[triangles]
    return Corners(points, point[triangles], colors, uv, face_uv, normals, face_normals), polygon


def points_of(said: Statements) -> tuple[FloatArray, FloatArray | None]:
    """(V, 3) points, and (V, 4) their linear colours where the lines have six numbers or more."""
    table = columns(numbers(said.points, "point"), said.points, 3, "point")
    points = finite_points(table[:, :3])
    if table.shape[1] < 6:
        return points, None
    colors = finite_points(table[:, 3:6], "color of point")
    return points, np.column_stack([linear_from_bytes(colors), np.ones(len(colors), np.float32)])


def places_of(said: Statements, numbers_from_1: IntArray, face_of: IntArray) -> tuple[FloatArray, IntArray]:
    """(U, 2) places in the texture, v down the image, and (C,) which one a corner has; none means 0, 0."""
    table = columns(numbers(said.uv, "texture place"), said.uv, 1, "texture place")
    across = table[:, 0]
    up = table[:, 1] if table.shape[1] > 1 else np.zeros(len(table))
    uv = finite_points(np.stack([across, 1 - up], axis=1), "texture place")
    uv = np.concatenate([uv, np.array([[0, 1]], dtype=np.float32)])
    none = numbers_from_1 == 0
    return uv, chosen(np.where(none, len(uv), numbers_from_1), len(uv), "texture place", face_of)


def parts(
    said: Statements, corners: Corners, polygon: IntArray, library: Mapping[str, Material]
) -> list[Mesh]:
    """A mesh for each object or group, in the file's order."""
    first = np.searchsorted(polygon, np.array([*(run.first for run in said.runs), len(said.faces)]))
    pieces: list[list[int]] = []  # the runs of each mesh
    for index, run in enumerate(said.runs):
        if first[index] == first[index + 1]:
            continue
        if pieces and said.runs[pieces[-1][0]].part == run.part:
            pieces[-1].append(index)
        else:
            pieces.append([index])
    if len(pieces) > MOST_NODES:
        pieces = [[index for piece in pieces for index in piece]]
    return [part(said.runs, piece, first, corners, library) for piece in pieces]


def part(
    runs: list[Run], piece: list[int], first: IntArray, corners: Corners, library: Mapping[str, Material]
) -> Mesh:
    """The mesh of some runs that follow each other."""
    names = list(dict.fromkeys(runs[index].material for index in piece))
    which = [names.index(runs[index].material) for index in piece]
    counts = [first[index + 1] - first[index] for index in piece]
    faces = slice(first[piece[0]], first[piece[-1] + 1])
    own = Corners(
        corners.points,
        corners.faces[faces],
        corners.colors,
        corners.uv,
        None if corners.face_uv is None else corners.face_uv[faces],
        corners.normals,
        None if corners.face_normals is None else corners.face_normals[faces],
    )
    return own.mesh(
        runs[piece[0]].part or "mesh",
        [library.get(name, DEFAULT) for name in names],
        np.repeat(which, counts) if len(names) > 1 else None,
    )
