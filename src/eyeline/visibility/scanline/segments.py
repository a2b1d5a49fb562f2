"""Edges and segments of a scan line, in whole numbers of any length, to be read."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.geometry.fixedpoint import BEFORE_CENTRE, CENTRE, UNITS, depth_at, depth_plane
from eyeline.projection.projected import CLOCKWISE, COUNTER_CLOCKWISE, Projected

Corner = tuple[int, int]  # x and y in 1/256 pixel


@dataclass(frozen=True)
class Edge:
    """An edge that leads clockwise around its face, and the rows whose centres it crosses."""

    face: int  # of the picture's faces, pieces too
    source: int  # the scene face
    start: Corner
    stop: Corner
    top: int  # the first row
    end: int  # the row behind the last

    @property
    def is_left(self) -> bool:
        """Whether the face is to the right of it: it leads upwards."""
        return self.stop[1] < self.start[1]

    @property
    def ends(self) -> list[tuple[float, float]]:
        """From where to where, in pixels."""
        return [(x / UNITS, y / UNITS) for x, y in (self.start, self.stop)]

    def column(self, y: int) -> int:
        """The first pixel of a row inside a left edge, the last one inside a right edge.

        Inside is where a (256 x + 128 - x0) + b (256 y + 128 - y0) >= 0, and > 0 for a right edge.
        """
        (x0, y0), (x1, y1) = self.start, self.stop
        a, b = y0 - y1, x1 - x0
        at_column_0 = a * (CENTRE - x0) + b * (UNITS * y + CENTRE - y0)
        if self.is_left:
            return -(at_column_0 // (UNITS * a))
        return (at_column_0 - 1) // (UNITS * -a)

    def place(self, y: int) -> tuple[int, int, bool]:
        """What active edges are sorted by: column, then face, of one face the left edge first."""
        return self.column(y), self.face, not self.is_left


@dataclass(frozen=True)
class Segment:
    """What a face covers of a row, and its depth there: a line k + slope x."""

    face: int
    source: int
    first: int  # the columns
    last: int
    slope: float
    k: float
    near: float  # its greatest depth, at one of its ends

    @property
    def number(self) -> tuple[int, int]:
        """Of equal depths the lower is seen."""
        return self.source, self.face

    def depth(self, x: int) -> np.float32:
        """The depth at a column, by the house's formula."""
        return np.float32(depth_at(self.slope, 0.0, self.k, x, 0))


def edges_of(projected: Projected, number: int) -> list[Edge] | None:
    """A face's edges that cross rows of the picture; None if it shows no side that counts."""
    corners = clockwise(projected, number)
    if not corners:
        return None
    xs, ys = ([int(projected.xy[corner, k]) for corner in corners] for k in range(2))
    if not pixels(min(xs), max(xs), projected.width):
        return []
    source, found = int(projected.source[number]), []
    for i, j in ((0, 1), (1, 2), (2, 0)):
        rows = pixels(min(ys[i], ys[j]), max(ys[i], ys[j]), projected.height)
        if rows:
            found.append(Edge(number, source, (xs[i], ys[i]), (xs[j], ys[j]), rows.start, rows.stop))
    return found


def pixels(low: int, high: int, count: int) -> range:
    """The pixels of `count` whose centres are at `low` or after it, and before `high`."""
    return range(max((low + BEFORE_CENTRE) >> 8, 0), min((high + BEFORE_CENTRE) >> 8, count))


def clockwise(projected: Projected, number: int) -> list[int]:
    """The vertices of a face, clockwise; none if it shows no side that counts."""
    i, j, k = (int(vertex) for vertex in projected.faces[number])
    (x0, y0), (x1, y1), (x2, y2) = (projected.xy[vertex].tolist() for vertex in (i, j, k))
    area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    sides = int(projected.sides[number if len(projected.sides) > 1 else 0])
    if area == 0 or not sides & (CLOCKWISE if area > 0 else COUNTER_CLOCKWISE):
        return []
    return [i, j, k] if area > 0 else [i, k, j]


def segments_of(active: list[Edge], projected: Projected, y: int) -> list[Segment]:
    """The segments of a row: a face that is there has two active edges, a left and a right one."""
    left = {edge.face: edge for edge in active if edge.is_left}
    found = []
    for right in active:
        if right.is_left:
            continue
        first = max(left[right.face].column(y), 0)
        last = min(right.column(y), projected.width - 1)
        if first <= last:
            a, k = line_of(projected, right.face, y)
            near = max(depth_at(a, 0.0, k, first, 0), depth_at(a, 0.0, k, last, 0))
            found.append(Segment(right.face, right.source, first, last, a, k, near))
    return found


def line_of(projected: Projected, number: int, y: int) -> tuple[float, float]:
    """(slope, k) of the depth k + slope x of a face along a row."""
    corners = [
        (int(projected.xy[vertex, 0]), int(projected.xy[vertex, 1]), projected.depth[vertex])
        for vertex in clockwise(projected, number)
    ]
    a, b, c = depth_plane(*corners[0], *corners[1], *corners[2])
    return a, c + b * float(y)
