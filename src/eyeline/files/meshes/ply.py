"""PLY, text and binary, with colours, normals and texture places of its points. [Turk94]

Read here and not by a library, because polygons of different sizes and counts that lie are common.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from eyeline.errors import FileError
from eyeline.files.meshes.assembly import (
    Corners,
    finite_points,
    indices_below,
    linear_from_bytes,
    refuse_empty,
    scene_of,
)
from eyeline.files.meshes.ply_header import Header
from eyeline.files.meshes.ply_rows import Columns, Lists, elements_of
from eyeline.files.meshes.polygons import triangulated
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.scene.scene import Scene

INDICES = ("vertex_indices", "vertex_index")
PLACES = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"))
COLORS = (("red", "green", "blue"), ("r", "g", "b"), ("diffuse_red", "diffuse_green", "diffuse_blue"))
COLORS_OF_FACES_NOTE = "colours of faces are not drawn; give them to the points"


def read(path: Path) -> Scene:
    """The scene of a PLY file. Lengths are taken for metres, colours for sRGB."""
    data = path.read_bytes()
    if not data.strip():
        raise FileError("is empty; export the model again")
    header = Header.of(data)
    elements = elements_of(data, header)
    vertex, face = elements.get("vertex", {}), elements.get("face", {})
    points = table(vertex, ("x", "y", "z"))
    if points is None:
        raise FileError("has no points with x, y and z; export the model again")
    faces = faces_of(face, finite_points(points))
    normals = table(vertex, ("nx", "ny", "nz"))
    places = next((found for names in PLACES if (found := table(vertex, names)) is not None), None)
    corners = Corners(
        finite_points(points),
        faces,
        colors_of(vertex),
        None
        if places is None
        else finite_points(np.stack([places[:, 0], 1 - places[:, 1]], 1), "texture place"),
        None if places is None else faces,
        None if normals is None else finite_points(normals, "normal"),
        None if normals is None else faces,
    )
    notes = (COLORS_OF_FACES_NOTE,) if any(names[0] in face for names in COLORS) else ()
    return scene_of(path.stem, [corners.mesh(path.stem)], notes)


def faces_of(face: Columns, points: FloatArray) -> IntArray:
    """(F, 3) the polygons cut into triangles."""
    lists = next((face[name] for name in INDICES if name in face), None)
    if lists is None:
        refuse_empty(())
    if not isinstance(lists, Lists):
        raise FileError("has faces that are no lists of points; export the model again")
    refuse_empty(lists.counts)
    face_of = np.repeat(np.arange(len(lists.counts)), lists.counts)
    with np.errstate(invalid="ignore"):
        # What is no whole number becomes one that is out of range
        corners = indices_below(lists.values.astype(np.int64), len(points), face_of)
    triangles, _ = triangulated(points, corners, lists.counts)
    return corners[triangles]


def table(columns: Columns, names: tuple[str, ...]) -> FloatArray | None:
    """(N, K) the columns of these names as numbers; None unless all are there."""
    found = [columns.get(name) for name in names]
    if any(column is None or isinstance(column, Lists) for column in found):
        return None
    return np.stack([np.asarray(column, dtype=np.float64) for column in found], axis=1)


def colors_of(vertex: Columns) -> FloatArray | None:
    """(V, 4) linear; whole numbers count up to 255, others up to 1."""
    names = next((names for names in COLORS if table(vertex, names) is not None), None)
    if names is None:
        return None
    parts = [share_of_full(np.asarray(vertex[name])) for name in names]
    alpha = vertex.get("alpha")
    opaque = np.ones(len(parts[0])) if alpha is None or isinstance(alpha, Lists) else share_of_full(alpha)
    colors = finite_points(np.stack([*parts, opaque], axis=1), "color of point")
    return np.column_stack([linear_from_bytes(colors[:, :3]), np.clip(colors[:, 3], 0, 1)])


def share_of_full(column: IntArray | FloatArray) -> FloatArray:
    """Channel values as parts of the brightest."""
    values = np.asarray(column, dtype=np.float64)
    return values / 255 if column.dtype.kind in "iu" or values.max(initial=0) > 1 else values
