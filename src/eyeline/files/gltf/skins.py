"""Skins: joints, and the matrices that undo the bind pose. [glTF 2.0, 3.7.3]"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from eyeline.errors import FileError
from eyeline.files.gltf.accessors import Accessors
from eyeline.files.gltf.part import Part, spoken
from eyeline.geometry.arrays import FloatArray
from eyeline.scene.mesh import Mesh
from eyeline.scene.skin import Skin

ROUNDING = 1e-4  # of the last row of an inverse bind matrix, which some exporters compute


def skin_of(accessors: Accessors, part: Part, node_of: Mapping[int, int]) -> Skin:
    """A skin; node_of: the scene's node for each of the file's."""
    joints = part.wholes("joints")
    if not joints:
        raise part.refuse("joints", "one joint or more is needed")
    return Skin(
        tuple(node_of[joint] for joint in joints), _bind(accessors, part, len(joints)), name=part.name()
    )


def _bind(accessors: Accessors, part: Part, count: int) -> FloatArray:
    """(J, 4, 4) joint_from_mesh; identities where the file gives none."""
    if not part.has("inverseBindMatrices"):
        return np.tile(np.eye(4), (count, 1, 1))
    place = part.at("inverseBindMatrices")
    columns = accessors.floats(part.whole("inverseBindMatrices"), ("MAT4",), place)
    if len(columns) < count:
        raise FileError(f"{place} has {len(columns)} matrices for {count} joints; one for each is needed")
    matrices = columns[:count].reshape(-1, 4, 4).transpose(0, 2, 1).astype(np.float64)
    if (np.abs(matrices[:, 3] - (0, 0, 0, 1)) > ROUNDING).any():
        raise FileError(f"{place} has a matrix whose last row is not 0 0 0 1; export the model again")
    matrices[:, 3] = (0, 0, 0, 1)
    return np.ascontiguousarray(matrices)


def check_fit(mesh: Mesh, skin: Skin, place: str) -> None:
    """Refuse a mesh that names more joints than its skin has."""
    if mesh.joints is None or not mesh.joints.size or mesh.joints.max() < len(skin.joints):
        return
    vertex = int(mesh.joints.max(axis=1).argmax())
    raise FileError(
        f"{place}: vertex {vertex} of mesh {spoken(mesh.name)} names joint {mesh.joints.max()},"
        f" and its skin has {len(skin.joints)}; the file is damaged"
    )
