"""A skin: which joints move a mesh, and where they were when the mesh was bound to them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from eyeline.geometry.arrays import FloatArray

Blending = Literal["linear", "dual_quaternion"]


@dataclass(frozen=True, eq=False)
class Skin:
    """Joints, as indices into the scene's nodes, and the matrices that undo the bind pose."""

    joints: tuple[int, ...]  # (J,)
    joint_from_mesh: FloatArray  # (J, 4, 4) inverse bind matrices
    blending: Blending = "linear"
    name: str = ""
