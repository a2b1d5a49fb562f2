"""Shearing: cross-sections slide over each other and keep their shape.

Point       x' = x + a y,   y' = y,   z' = z + b y
Determinant 1: a shear keeps every volume.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from eyeline.deform.affine import Affine
from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Shear(Affine):
    """Slides cross-sections sideways, the farther from the origin the more."""

    kind: ClassVar[str] = "shear"

    x: float = 0.0  # metres along its x for every metre along its axis
    z: float = 0.0  # metres along its z for every metre along its axis

    @property
    def own(self) -> FloatArray:
        """(4, 4) in its own frame."""
        matrix = transform.identity()
        matrix[0, 1], matrix[2, 1] = self.x, self.z
        return matrix
