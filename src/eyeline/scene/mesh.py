"""A surface of triangles, with what its vertices and faces carry."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
import numpy.typing as npt

from eyeline.cached import cached_property
from eyeline.errors import GeometryError
from eyeline.geometry.arrays import FloatArray, IntArray, float_rows, index_rows
from eyeline.geometry.bounds import Bounds
from eyeline.scene.material import DEFAULT, Material


@dataclass(frozen=True, eq=False)
class MorphTarget:
    """A shape to blend to, as differences from the mesh's own. [glTF 2.0, 3.7.2.2]"""

    points: FloatArray | None = None  # (V, 3) metres
    normals: FloatArray | None = None  # (V, 3)
    tangents: FloatArray | None = None  # (V, 3)
    uv: tuple[FloatArray, ...] = ()  # (V, 2) each
    colors: FloatArray | None = None  # (V, 4)
    name: str = ""


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles over shared vertices; a front face turns counter-clockwise.

    points: (V, 3) metres, kept as float32. faces: (F, 3) vertex indices, kept as int32.
    normals: (V, 3) unit; without them a face is flat. tangents: (V, 4) xyz unit, w = 1 or -1 is the
    bitangent's side. uv: up to two (V, 2). colors: (V, 4) linear, multiply the base colour.
    materials and face_material: (F,) which of them a face has; all the first if left out.
    joints, influences: (V, K) the skin's joints that move a vertex, and how much; rows add up to 1.
    Arrays are taken as they are where they fit: change them no more.
    """

    points: FloatArray
    faces: IntArray
    normals: FloatArray | None = None
    tangents: FloatArray | None = None
    uv: tuple[FloatArray, ...] = ()
    colors: FloatArray | None = None
    materials: tuple[Material, ...] = (DEFAULT,)
    face_material: IntArray | None = None
    targets: tuple[MorphTarget, ...] = ()
    weights: tuple[float, ...] = ()  # of the targets, where the node says nothing
    joints: IntArray | None = None
    influences: FloatArray | None = None
    name: str = ""

    def __init__(
        self,
        points: npt.ArrayLike,
        faces: npt.ArrayLike,
        normals: npt.ArrayLike | None = None,
        tangents: npt.ArrayLike | None = None,
        uv: Sequence[npt.ArrayLike] = (),
        colors: npt.ArrayLike | None = None,
        *,
        material: Material | None = None,
        materials: Sequence[Material] = (),
        face_material: npt.ArrayLike | None = None,
        targets: Sequence[MorphTarget] = (),
        weights: Sequence[float] = (),
        joints: npt.ArrayLike | None = None,
        influences: npt.ArrayLike | None = None,
        name: str = "",
    ) -> None:
        """Check every array; refuse in a sentence that names the row."""
        if material is not None and materials:
            raise GeometryError("give material or materials, not both")
        points = float_rows(points, 3, "point")
        count = len(points)
        faces = index_rows(faces, 3, count, "face")
        materials = tuple(materials) or (material or DEFAULT,)
        if face_material is not None:
            face_material = index_rows(
                np.reshape(face_material, (-1, 1)), 1, len(materials), "face_material"
            )[:, 0]
            _same_length("face_material", face_material, "face", len(faces))
        optional = {
            "normals": None if normals is None else float_rows(normals, 3, "normal"),
            "tangents": None if tangents is None else float_rows(tangents, 4, "tangent"),
            "colors": None if colors is None else float_rows(colors, 4, "color"),
        }
        pairs = tuple(float_rows(pair, 2, "uv") for pair in uv)
        for name_of, array in [*optional.items(), *(("uv", pair) for pair in pairs)]:
            _same_length(name_of, array, "point", count)
        if (joints is None) != (influences is None):
            raise GeometryError("joints and influences come together")
        if joints is not None and influences is not None:
            joints = np.ascontiguousarray(joints, dtype=np.int32)
            influences = np.ascontiguousarray(influences, dtype=np.float32)
            if joints.shape != influences.shape or joints.ndim != 2 or len(joints) != count:
                raise GeometryError(
                    f"joints {joints.shape} and influences {influences.shape} must both be ({count}, K)"
                )
        values: dict[str, Any] = {
            "points": points, "faces": faces, **optional, "uv": pairs, "materials": materials,
            "face_material": face_material, "targets": tuple(targets),
            "weights": tuple(weights) or (0.0,) * len(targets),
            "joints": joints, "influences": influences, "name": name,
        }  # fmt: skip
        for key, value in values.items():
            object.__setattr__(self, key, value)

    @cached_property
    def bounds(self) -> Bounds:
        """The box around all points, object space."""
        return Bounds.of(self.points)

    def changed(self, **values: Any) -> Mesh:
        """This mesh with other values, unchecked: for code that keeps shapes and meaning."""
        mesh = object.__new__(Mesh)
        for field in fields(self):
            object.__setattr__(mesh, field.name, values.get(field.name, getattr(self, field.name)))
        return mesh

    def with_material(self, material: Material) -> Mesh:
        """This mesh, all of one material."""
        return self.changed(materials=(material,), face_material=None)


def _same_length(name: str, array: npt.NDArray[Any] | None, unit: str, count: int) -> None:
    if array is not None and len(array) != count:
        raise GeometryError(f"there are {len(array)} {name} rows for {count} {unit}s; one for each is needed")
