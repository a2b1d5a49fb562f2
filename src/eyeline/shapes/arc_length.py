"""From outline to outline: places answer each other that are the same part of the length from the start."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import linear_sum_assignment

from eyeline.cached import cached_property
from eyeline.errors import OptionError
from eyeline.geometry.arrays import FloatArray
from eyeline.shapes.outline import Outline

STATIONS = 128  # places along both outlines that are compared to find the start
MOST_STARTS = 512  # points of the end that are tried as its start


@dataclass(frozen=True, eq=False)
class ArcLength:
    """All outlines between two. The corners of both are kept, so the first and the last are exactly they.

    The start is the first point of `start`; `first` is the point of `end` that answers it. Left out, it is
    the one from which the outlines, about their centres, are nearest to each other all along. An end that
    turns the other way is gone through backwards; so is an open one that fits better so.
    """

    start: Outline
    end: Outline
    first: int | None = None

    def at(self, part: float) -> Outline:
        """The outline at a part of the way."""
        begin, finish = self._matched
        return Outline((1 - part) * begin + part * finish, self.start.closed and self.end.closed)

    @cached_property
    def _matched(self) -> tuple[FloatArray, FloatArray]:
        """Points (K, 2) of both that answer each other."""
        end, shift = self._aligned
        stations = np.concatenate([self.start.travelled, _round(end.travelled - shift)])
        if self.start.closed:
            stations = np.unique(_round(stations))
        else:
            stations = np.unique(stations)
        return self.start.at(stations), end.at(stations + shift)

    @cached_property
    def _aligned(self) -> tuple[Outline, float]:
        """The end, turned round if need be, and the part of its length that is before its start."""
        if self.start.closed and self.end.closed:
            turned = self.start.area * self.end.area < 0
            end = self.end.reversed() if turned else self.end
            if self.first is not None:
                count = len(end.points)
                if not 0 <= self.first < count:
                    raise OptionError(f"first is {self.first}; the outline has points 0 to {count - 1}")
                return end, float(end.travelled[-self.first % count if turned else self.first])
            return end, best_start(self.start, end)
        back = self.end.reversed()
        return min(((one, 0.0) for one in (self.end, back)), key=lambda one: difference(self.start, *one))


def best_start(start: Outline, end: Outline) -> float:
    """The part of the end's length at that of its points from which it is nearest to the start."""
    step = -(-len(end.points) // MOST_STARTS)
    candidates = end.travelled[: len(end.points) : step]
    return float(min(candidates, key=lambda shift: difference(start, end, float(shift))))


def difference(start: Outline, end: Outline, shift: float) -> float:
    """How far the outlines are apart along their lengths, each about its centre; squares, added up."""
    stations = (np.arange(STATIONS) + 0.5) / STATIONS
    one, other = start.at(stations) - start.centre, end.at(stations + shift) - end.centre
    return float(((one - other) ** 2).sum())


def _round(stations: FloatArray) -> FloatArray:
    """Parts of a length within 0 to 1."""
    return np.asarray(stations - np.floor(stations))


def pairs(start: Sequence[Outline], end: Sequence[Outline]) -> list[tuple[int | None, int | None]]:
    """Which outline becomes which: by place and by size, closed ones closed ones, in the least total change.

    One that is left over stands alone: it grows out of its centre, or shrinks into it.
    """
    if not start or not end:
        return [*((i, None) for i in range(len(start))), *((None, j) for j in range(len(end)))]
    cost = np.array([[change(one, other) for other in end] for one in start])
    rows, columns = linear_sum_assignment(cost)
    found: list[tuple[int | None, int | None]] = [
        (i, j)
        for i, j in zip(rows.tolist(), columns.tolist(), strict=True)
        if start[i].closed == end[j].closed
    ]
    taken = {i for i, _ in found}, {j for _, j in found}
    found += [(i, None) for i in range(len(start)) if i not in taken[0]]
    return found + [(None, j) for j in range(len(end)) if j not in taken[1]]


def change(start: Outline, end: Outline) -> float:
    """How far the centre goes, and how much the length changes; squares, added up."""
    apart = float(((start.centre - end.centre) ** 2).sum()) + (start.length - end.length) ** 2 / 4
    return apart if start.closed == end.closed else apart + 1e6 * (1 + start.length + end.length) ** 2
