"""Meshes: primitives that share vertices, one for each run of faces of one material. [glTF 2.0, 3.7.2]"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from eyeline.files.gltf.directions import is_unit
from eyeline.files.gltf.writing.influences import sets_of
from eyeline.files.gltf.writing.materials import Materials
from eyeline.files.gltf.writing.store import INDICES, VERTICES, Store, Thing, named, numbers
from eyeline.files.gltf.writing.targets import targets_of
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.geometry.normals import SOMEWHERE, unit
from eyeline.scene.mesh import Mesh

MOST_RUNS = 64  # primitives of a mesh that keep the order of its faces; more would be slow to draw


@dataclass(frozen=True, eq=False)
class Meshes:
    """Writes each mesh once."""

    store: Store
    materials: Materials
    note: Callable[[str], None]
    _meshes: dict[int, int | None] = field(default_factory=dict)

    def __call__(self, mesh: Mesh) -> int | None:
        """Its number; None for a mesh without faces, which the format does not have."""
        if id(mesh) not in self._meshes:
            if not len(mesh.faces):
                self.note(f"mesh {mesh.name!r} has no faces; it is left out")
            self._meshes[id(mesh)] = self.store.add("meshes", self._made(mesh)) if len(mesh.faces) else None
        return self._meshes[id(mesh)]

    def _made(self, mesh: Mesh) -> Thing:
        vertices: Thing = {"attributes": self._attributes(mesh)}
        if mesh.targets:
            vertices["targets"] = targets_of(self.store, mesh)
        primitives = []
        for slot, faces in self._runs(mesh):
            corners = faces.reshape(-1).astype(np.uint16 if len(mesh.points) <= 0xFFFF else np.uint32)
            primitive = {**vertices, "indices": self.store.accessor(corners, INDICES)}
            material = self.materials(mesh.materials[slot])
            primitives.append(primitive if material is None else {**primitive, "material": material})
        thing: Thing = {"primitives": primitives}
        if mesh.targets:
            thing["weights"] = numbers(mesh.weights)
            thing["extras"] = {"targetNames": [target.name for target in mesh.targets]}
        return named(mesh.name, thing)

    def _runs(self, mesh: Mesh) -> list[tuple[int, IntArray]]:
        """Faces of one material each, in their order; by material where they would be too many parts."""
        if mesh.face_material is None:
            return [(0, mesh.faces)]
        slots, faces = mesh.face_material, mesh.faces
        cuts = np.flatnonzero(np.diff(slots)) + 1
        if len(cuts) >= MOST_RUNS:
            order = np.argsort(slots, kind="stable")
            slots, faces = slots[order], faces[order]
            cuts = np.flatnonzero(np.diff(slots)) + 1
            self.note(f"the faces of mesh {mesh.name!r} are put in the order of their materials")
        runs = np.split(faces, cuts)
        return [(int(slots[first]), run) for first, run in zip([0, *cuts], runs, strict=True)]

    def _attributes(self, mesh: Mesh) -> Thing:
        """The accessors of everything that the vertices carry."""
        arrays: dict[str, npt.NDArray[Any]] = {}
        if mesh.normals is not None:
            arrays["NORMAL"] = straight(mesh.normals)
            if mesh.tangents is not None:
                side = np.where(mesh.tangents[:, 3:] < 0, np.float32(-1), np.float32(1))
                arrays["TANGENT"] = np.concatenate([straight(mesh.tangents[:, :3]), side], axis=1)
        for number, pairs in enumerate(mesh.uv):
            arrays[f"TEXCOORD_{number}"] = pairs
        if mesh.colors is not None:
            arrays["COLOR_0"] = np.clip(mesh.colors, 0, 1)
            if (arrays["COLOR_0"] != mesh.colors).any():
                self.note(f"mesh {mesh.name!r} has colours outside 0 to 1; they are cut")
        if mesh.joints is not None and mesh.influences is not None:
            arrays |= sets_of(mesh.joints, mesh.influences)
        made = {"POSITION": self.store.accessor(mesh.points, VERTICES, bounded=True)}
        return made | {name: self.store.accessor(values, VERTICES) for name, values in arrays.items()}


def straight(vectors: FloatArray) -> FloatArray:
    """(V, 3) float32 of length one; as they are where they have it."""
    if is_unit(vectors):
        return vectors
    return unit(vectors.astype(np.float64), (SOMEWHERE[0], SOMEWHERE[1], SOMEWHERE[2])).astype(np.float32)
