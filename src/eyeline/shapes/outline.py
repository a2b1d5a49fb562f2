"""Outlines: lines in the plane, closed or open, and where on them one is after a part of their length."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.cached import cached_property
from eyeline.errors import GeometryError
from eyeline.geometry.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Outline:
    """A line through points; a closed one goes back from the last to the first."""

    points: FloatArray  # (K, 2) x to the right, y down; none twice in a row
    closed: bool = True

    def __post_init__(self) -> None:
        """Keep each place once."""
        points = np.asarray(self.points, np.float64)
        if points.ndim != 2 or points.shape[1] != 2 or len(points) == 0 or not np.isfinite(points).all():
            raise GeometryError(
                f"an outline's points have shape {points.shape}; finite (K, 2) with K > 0 are needed"
            )
        if len(points) > 1:
            step = (points != np.roll(points, 1, axis=0)).any(axis=1)
            step[0] |= not self.closed
            points = points[step] if step.any() else points[:1]
        object.__setattr__(self, "points", points)

    @cached_property
    def ring(self) -> FloatArray:
        """(K, 2) or (K + 1, 2): the points, and of a closed outline the first once more."""
        return np.vstack([self.points, self.points[:1]]) if self.closed else self.points

    @cached_property
    def travelled(self) -> FloatArray:
        """The part of the whole length at each point of the ring, 0 to 1."""
        steps = np.sqrt((np.diff(self.ring, axis=0) ** 2).sum(axis=1))
        along = np.concatenate([[0], np.cumsum(steps)])
        parts: FloatArray = along / along[-1] if along[-1] > 0 else along
        return parts

    @property
    def length(self) -> float:
        """All the way round, or from end to end."""
        return float(np.sqrt((np.diff(self.ring, axis=0) ** 2).sum(axis=1)).sum())

    @property
    def area(self) -> float:
        """Inside a closed outline, above 0 if it is seen to turn clockwise; 0 of an open one."""
        if not self.closed:
            return 0.0
        (x, y), (u, v) = self.points.T, np.roll(self.points, -1, axis=0).T
        return float((x * v - u * y).sum()) / 2

    @cached_property
    def centre(self) -> FloatArray:
        """(2,) the mean place along the line."""
        if len(self.ring) < 2 or self.length == 0:
            return np.asarray(self.points.mean(axis=0))
        steps = np.sqrt((np.diff(self.ring, axis=0) ** 2).sum(axis=1))
        centre: FloatArray = np.average((self.ring[1:] + self.ring[:-1]) / 2, axis=0, weights=steps)
        return centre

    def at(self, travelled: FloatArray) -> FloatArray:
        """(N, 2) the places after parts (N,) of the length; a closed outline goes round and round."""
        part = travelled - np.floor(travelled) if self.closed else np.clip(travelled, 0, 1)
        if len(self.ring) == 1:
            return np.repeat(self.ring, len(part), axis=0)
        return np.stack([np.interp(part, self.travelled, self.ring[:, k]) for k in range(2)], axis=1)

    def reversed(self) -> Outline:
        """The other way round, from the same first point if it is closed."""
        back = self.points[::-1]
        return Outline(np.roll(back, 1, axis=0) if self.closed else back, self.closed)

    def shrunk(self) -> Outline:
        """All of it at its centre: what grows out of nothing."""
        return Outline(self.centre[None], self.closed)
