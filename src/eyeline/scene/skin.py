"""A skin: which joints move a mesh, and where they were when the mesh was bound to them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from eyeline.errors import GeometryError
from eyeline.geometry.arrays import FloatArray

Blending = Literal["linear", "dual_quaternion"]


@dataclass(frozen=True, eq=False)
class Skin:
    """Joints, as indices into the scene's nodes, and the matrices that undo the bind pose."""

    joints: tuple[int, ...]  # (J,)
    joint_from_mesh: FloatArray  # (J, 4, 4) inverse bind matrices
    blending: Blending = "linear"
    name: str = ""

    def __post_init__(self) -> None:
        """Refuse a skin whose joints and matrices do not pair."""
        shape = np.shape(self.joint_from_mesh)
        if shape != (len(self.joints), 4, 4):
            raise GeometryError(
                f"skin {self.name!r} has {len(self.joints)} joints and matrices of shape {shape}"
            )
        if self.blending not in get_args(Blending):
            raise GeometryError(
                f"skin {self.name!r} blends {self.blending!r}; linear or dual_quaternion is needed"
            )
