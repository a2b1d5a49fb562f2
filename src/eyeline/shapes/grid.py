"""A grid of points at even steps, where the distance to a surface is known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.errors import GeometryError, OptionError
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.geometry.bounds import Bounds

MARGIN = 3  # cells around what the grid must hold, so that no surface reaches its border
FEWEST, MOST = 8, 384  # cells along the longest side


@dataclass(frozen=True, eq=False)
class Grid:
    """Points low + step * (i, j, k), i < counts[0] ...; flat arrays run through k first."""

    low: FloatArray  # (3,) float64 metres
    step: float  # metres, the edge of a cell
    counts: tuple[int, int, int]

    @classmethod
    def around(cls, bounds: Bounds, cells: int) -> Grid:
        """So many points along the longest side, with room for a box. Refused: a mere point."""
        if not FEWEST <= cells <= MOST:
            raise OptionError(f"cells is {cells}; {FEWEST} to {MOST} along the longest side are needed")
        extent = bounds.high - bounds.low
        if not extent.max() > 0:
            raise GeometryError("the shapes are but a point; a body is needed")
        step = float(extent.max()) / (cells - 1 - 2 * MARGIN)
        counts = np.ceil(extent / step).astype(int) + 1 + 2 * MARGIN
        low = bounds.centre - step * (counts - 1) / 2
        return cls(low, step, (int(counts[0]), int(counts[1]), int(counts[2])))

    @property
    def size(self) -> int:
        """How many points there are."""
        return self.counts[0] * self.counts[1] * self.counts[2]

    def places(self, points: FloatArray) -> FloatArray:
        """(N, 3) float64: points in metres, counted in steps from the grid's first point."""
        counted: FloatArray = (np.asarray(points, np.float64) - self.low) / self.step
        return counted

    def numbers(self, points: FloatArray) -> IntArray:
        """(N,) the flat number of the grid point nearest to each of points (N, 3)."""
        nearest = np.clip(np.rint(self.places(points)).astype(np.int64), 0, np.array(self.counts) - 1)
        numbers: IntArray = (nearest[:, 0] * self.counts[1] + nearest[:, 1]) * self.counts[2] + nearest[:, 2]
        return numbers
