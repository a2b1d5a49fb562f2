"""Morph targets: the same differences for every primitive of a mesh. [glTF 2.0, 3.7.2.2]"""

from __future__ import annotations

import numpy as np

from eyeline.files.gltf.targets import WIDTHS
from eyeline.files.gltf.writing.store import VERTICES, Store
from eyeline.geometry.arrays import FloatArray
from eyeline.scene.mesh import Mesh, MorphTarget


def targets_of(store: Store, mesh: Mesh) -> list[dict[str, int]]:
    """The accessors of every target; what one moves, all name, for players that take it for granted."""
    parts = [differences(target, mesh) for target in mesh.targets]
    moved = [name for name in WIDTHS if any(name in part for part in parts)] or ["POSITION"]
    made = []
    for part in parts:
        arrays = {
            name: part[name] if name in part else np.zeros((len(mesh.points), WIDTHS[name]), np.float32)
            for name in moved
        }
        made.append(
            {
                name: store.accessor(values, VERTICES, bounded=name == "POSITION")
                for name, values in arrays.items()
            }
        )
    return made


def differences(target: MorphTarget, mesh: Mesh) -> dict[str, FloatArray]:
    """(V, width) float32 what a target moves, of what the mesh has."""
    pairs = dict(zip(("TEXCOORD_0", "TEXCOORD_1"), target.uv[: len(mesh.uv)], strict=False))
    given = {
        "POSITION": target.points,
        "NORMAL": None if mesh.normals is None else target.normals,
        "TANGENT": None if mesh.normals is None or mesh.tangents is None else target.tangents,
        **pairs,
        "COLOR_0": None if mesh.colors is None else target.colors,
    }
    return {name: np.asarray(one, dtype=np.float32) for name, one in given.items() if one is not None}
