"""Axis-aligned boxes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Bounds:
    """The smallest box around something; low > high where there is nothing."""

    low: FloatArray  # (3,) float64
    high: FloatArray  # (3,) float64

    @classmethod
    def empty(cls) -> Bounds:
        """The box around nothing."""
        return cls(np.full(3, np.inf), np.full(3, -np.inf))

    @classmethod
    def of(cls, points: FloatArray) -> Bounds:
        """The box around points (N, 3)."""
        if len(points) == 0:
            return cls.empty()
        return cls(points.min(axis=0).astype(np.float64), points.max(axis=0).astype(np.float64))

    @property
    def is_empty(self) -> bool:
        """Whether there is nothing inside."""
        return bool((self.low > self.high).any())

    @property
    def centre(self) -> FloatArray:
        """(3,) the middle; the origin where empty."""
        return np.zeros(3) if self.is_empty else (self.low + self.high) / 2

    @property
    def diagonal(self) -> float:
        """The distance between opposite corners; 0 where empty."""
        return 0.0 if self.is_empty else float(np.sqrt(((self.high - self.low) ** 2).sum()))

    @property
    def corners(self) -> FloatArray:
        """(8, 3) the corners."""
        pick = np.array([[(i >> k) & 1 for k in range(3)] for i in range(8)], dtype=bool)
        return np.where(pick, self.high, self.low)

    def union(self, other: Bounds) -> Bounds:
        """The box around both."""
        return Bounds(np.minimum(self.low, other.low), np.maximum(self.high, other.high))

    def moved(self, matrix: FloatArray) -> Bounds:
        """The box around this box, moved by an affine matrix (4, 4)."""
        if self.is_empty:
            return self
        return Bounds.of(self.corners @ matrix[:3, :3].T + matrix[:3, 3])
