"""From what a file lists to a Mesh: a vertex for each kind of corner, normals where the file has none."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence, Sized
from dataclasses import dataclass

import numpy as np

from eyeline.errors import FileError
from eyeline.files.limits import LARGEST
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.geometry.normals import creased, unit
from eyeline.geometry.weld import welded
from eyeline.scene.material import DEFAULT, Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

CREASE = math.radians(40)  # an edge sharper than this stays an edge, where the file has no normals


@dataclass(frozen=True, eq=False)
class Corners:
    """Triangles F over points V, and what else the file has for points or corners."""

    points: FloatArray  # (V, 3) float32
    faces: IntArray  # (F, 3)
    colors: FloatArray | None = None  # (V, 4) linear
    uv: FloatArray | None = None  # (U, 2) v runs down the image
    face_uv: IntArray | None = None  # (F, 3) into uv
    normals: FloatArray | None = None  # (N, 3)
    face_normals: IntArray | None = None  # (F, 3) into normals

    def mesh(
        self, name: str, materials: Sequence[Material] = (DEFAULT,), face_material: IntArray | None = None
    ) -> Mesh:
        """The mesh: same faces, same order; points that no face uses are left out."""
        shading, normals = self._shading()
        used = [self.faces, shading] if self.face_uv is None else [self.faces, shading, self.face_uv]
        first, index = welded(np.stack(used, axis=-1).reshape(-1, len(used)).astype(np.int32))
        point, facing = self.faces.reshape(-1)[first], shading.reshape(-1)[first]
        place = None if self.face_uv is None or self.uv is None else self.uv[self.face_uv.reshape(-1)[first]]
        return Mesh(
            self.points[point],
            index.reshape(-1, 3),
            normals[facing],
            uv=[] if place is None else [place],
            colors=None if self.colors is None else self.colors[point],
            materials=tuple(materials),
            face_material=face_material,
            name=name,
        )

    def _shading(self) -> tuple[IntArray, FloatArray]:
        """Which normal each corner (F, 3) has, and the normals: the file's, or creased ones."""
        if self.normals is not None and self.face_normals is not None:
            lengths = unit(self.normals.astype(np.float64)).astype(np.float32)
            if lengths[self.face_normals].any(axis=2).all():
                return self.face_normals, lengths
        first, index = welded(self.points)
        split = creased(self.points[first], index[self.faces], CREASE)
        return split.faces, split.normals


def scene_of(name: str, meshes: Iterable[Mesh], notes: Iterable[str] = ()) -> Scene:
    """The scene of a file: its meshes, a node each, and what there is to say."""
    return Scene(tuple(Node(mesh.name, mesh=mesh) for mesh in meshes), notes=tuple(notes), name=name)


def finite_points(values: FloatArray, what: str = "point") -> FloatArray:
    """Points (V, 3) as float32; refuses the first that is not finite or beyond any scene, naming its row."""
    with np.errstate(over="ignore", invalid="ignore"):
        points = np.ascontiguousarray(values, dtype=np.float32)
    bad = ~(np.abs(points) <= LARGEST).all(axis=1)
    if bad.any():
        row = int(np.flatnonzero(bad)[0])
        numbers = " ".join(f"{value:g}" for value in values[row].tolist())
        raise FileError(f"{what} {row} is {numbers}; numbers of at most {LARGEST:g} are needed")
    return points


def indices_below(indices: IntArray, count: int, face_of: IntArray | None = None) -> IntArray:
    """Point numbers of faces, checked against the count of points; face_of: (N,) the face of each."""
    bad = (indices < 0) | (indices >= count)
    if bad.any():
        at = int(np.flatnonzero(bad)[0])
        face = at if face_of is None else int(face_of[at])
        raise FileError(
            f"face {face} names point {int(indices[at])}; there are {count} points, numbered from 0"
        )
    return indices


def refuse_empty(faces: Sized) -> None:
    """Refuse a file without faces."""
    if len(faces) == 0:
        raise FileError("has no faces, so there is nothing to see; export it with its faces")


def linear_from_bytes(colors: FloatArray) -> FloatArray:
    """sRGB colours 0..1 as linear float32. [IEC 61966-2-1]"""
    values = np.clip(colors, 0, 1)
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4).astype(np.float32)
