"""Moving as a solid body moves, and its image in a mirror.

What stays as it is:

    translation    distances, angles, areas, volumes, directions, handedness; no point, or all
    rotation       distances, angles, areas, volumes, handedness, the points of the axis
    reflection     distances, angles, areas, volumes, the points of the plane; handedness turns

A weight between 0 and 1 leads straight from where a point was to where it comes, and is not rigid: to turn
half way, halve the angle.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from eyeline.deform.affine import Affine
from eyeline.deform.deformer import Vector
from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Translation(Affine):
    """Moves all points alike."""

    kind: ClassVar[str] = "translation"

    offset: Vector = (0.0, 0.0, 0.0)  # metres, along the axes of its own frame

    @property
    def own(self) -> FloatArray:
        """(4, 4) in its own frame."""
        matrix = transform.identity()
        matrix[:3, 3] = self.offset
        return matrix


@dataclass(frozen=True, eq=False)
class Rotation(Affine):
    """Turns all points about its axis through its origin, by the right hand."""

    kind: ClassVar[str] = "rotation"

    angle: float = 0.0  # radians

    @property
    def own(self) -> FloatArray:
        """(4, 4) in its own frame."""
        s, c = math.sin(self.angle), math.cos(self.angle)
        matrix = transform.identity()
        matrix[0, 0] = matrix[2, 2] = c
        matrix[0, 2], matrix[2, 0] = s, -s
        return matrix


@dataclass(frozen=True, eq=False)
class Reflection(Affine):
    """Takes all points to the other side of the plane that stands upright on its axis at its origin."""

    kind: ClassVar[str] = "reflection"

    @property
    def own(self) -> FloatArray:
        """(4, 4) in its own frame."""
        matrix = transform.identity()
        matrix[1, 1] = -1
        return matrix
