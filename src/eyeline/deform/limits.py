"""Deformers that act along their axis between two limits; beyond them the shape is carried along stiffly."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

from eyeline.deform.deformer import Deformer
from eyeline.errors import GeometryError
from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray


@dataclass(frozen=True, eq=False, kw_only=True)
class Limited(Deformer):
    """Acts between lower and upper, in metres along its axis from its origin, which stays where it is."""

    lower: float = 0.0
    upper: float = 1.0

    def __post_init__(self) -> None:
        """Refuse limits that leave no room."""
        super().__post_init__()
        if not self.lower < self.upper:
            raise GeometryError(
                f"{self.label}: lower is {self.lower:g}; it must be below upper, {self.upper:g}"
            )

    def fitted(self, points: FloatArray) -> Self:
        """This deformer from the lowest to the highest of points (V, 3) along its axis."""
        if not len(points):
            raise GeometryError(f"{self.label} cannot be fitted to no points")
        heights = transform.apply(self.deformer_from_mesh, points)[:, 1]
        return replace(self, lower=float(heights.min()), upper=float(heights.max()))

    def rate(self, change: float) -> float:
        """A change from limit to limit, as change by the metre."""
        return float(change) / (float(self.upper) - float(self.lower))

    def bounds(self) -> tuple[float, float]:
        """Both limits, as kernels take them."""
        return float(self.lower), float(self.upper)
