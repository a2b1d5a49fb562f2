"""The painter: farthest first, so that what is nearer covers it; faces that no order fits are cut. [Newell72]

The list of faces is kept for cells of 8x8 pixels, so that only those are compared that can lie over each
other. Of two, five tests ask whether the farther may be painted first, the cheapest first: their depths do
not overlap; their columns or rows do not; they share no pixel; the farther lies wholly behind the plane of
the nearer; the nearer lies wholly before the plane of the farther. Where all fail, and the tests of planes
hold the other way round, the two are swapped; where a face would wait for itself, or two pierce each other,
one is cut. All of it is asked at the centres of pixels, by the picture's one formula for depth.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from eyeline.errors import SceneError
from eyeline.geometry.arrays import FloatArray, IntArray, read_only
from eyeline.geometry.memory import recycled
from eyeline.jit import share, threads
from eyeline.projection.projected import Projected
from eyeline.visibility.method import Step, Visible
from eyeline.visibility.painter.cell_masks import CELL, count_parts, fill_parts
from eyeline.visibility.painter.painting import (
    BEFORE,
    BEHIND,
    COUNTERS,
    DEPTHS,
    EXTENTS,
    PIXELS,
    SPLITS,
    paint_cells,
)

WORK = (
    "faces",
    "faces turned away",
    "parts of faces",
    "apart in depth",
    "apart across or down",
    "sharing no pixel",
    "behind the other's plane",
    "the other before its plane",
    "swaps",
    "splits",
    "parts wholly hidden",
    "pixels painted",
)  # what is counted
COMPARISONS = [DEPTHS, EXTENTS, PIXELS, BEHIND, BEFORE]

Lists = tuple[IntArray, IntArray, tuple[IntArray, IntArray, FloatArray, FloatArray]]

GROUP = 1 << 22  # parts of faces that are held at once, if one row of cells has not more: 200 MB
MOST_PARTS = 1 << 26  # in one row of cells: 3 GB


@dataclass(frozen=True)
class Painter:
    """Painter's algorithm: faces from back to front, ordered by five tests, cut where there is no order."""

    name: str = "painter"
    space: str = "object"
    answers: bool = True
    exact: bool = True
    most_splits: int = 1 << 20  # more are refused, in a sentence
    most_comparisons: int = 1 << 32

    def __call__(self, projected: Projected) -> Visible:
        """The face painted last at every pixel. Refused: more splits or comparisons than allowed."""
        parts = threads()
        face = recycled((projected.height, projected.width), np.int32)
        depth = recycled((projected.height, projected.width), np.float32)
        counts, away = counted(projected, parts)
        work = np.zeros(COUNTERS, dtype=np.int64)
        most = self.most_comparisons, self.most_splits
        for rows in groups(counts):
            lists = filled(projected, counts, rows, parts)
            work += painted(projected, rows, lists, most, (face, depth))
            self.refuse(work)
        numbers = (len(projected.faces), away, *work.tolist())
        return Visible(face, depth, projected, self, dict(zip(WORK, numbers, strict=True)))

    def steps(self, projected: Projected) -> Iterator[Step]:
        """What comes before what in one list of all faces, and why; the last step is the picture."""
        from eyeline.visibility.painter.painter_steps import steps

        return steps(self, projected)

    def refuse(self, work: IntArray) -> None:
        """A sentence, if more was done than is allowed."""
        if work[SPLITS] > self.most_splits:
            raise SceneError(
                f"the painter has cut {self.most_splits} faces and is not done: too many pierce each other;"
                " use method 'zbuffer', a smaller picture, or Painter(most_splits=...) with more"
            )
        if work[COMPARISONS].sum() > self.most_comparisons:
            raise SceneError(
                f"the painter has compared {self.most_comparisons} pairs and is not done: too many faces lie"
                " over each other at the same depth; use method 'zbuffer', a smaller picture, or"
                " Painter(most_comparisons=...) with more"
            )


def counted(projected: Projected, parts: int) -> tuple[IntArray, int]:
    """How many faces of each part may lie in each cell, (rows, columns, parts); how many faces turn away."""
    rows, columns = -(-projected.height // CELL), -(-projected.width // CELL)
    counts = np.zeros((rows, columns, parts), dtype=np.int32)
    given = (*arrays(projected)[:2], read_only(projected.sides), (projected.width, projected.height))
    away = share(lambda part: count_parts(part, parts, *given, counts.reshape(-1)), parts)
    return counts, sum(away)


def groups(counts: IntArray) -> Iterator[tuple[int, int]]:
    """Rows of cells, first and end, that are handled at once: as many as GROUP allows.

    Refused: a row with more than MOST_PARTS.
    """
    held, first = 0, 0
    for row, count in enumerate(counts.sum(axis=(1, 2), dtype=np.int64).tolist()):
        if count > MOST_PARTS:
            raise SceneError(
                f"{count} faces lie over each other in {CELL} rows of pixels, and the painter sorts at most"
                f" {MOST_PARTS}; use method 'zbuffer' or a smaller picture"
            )
        if held and held + count > GROUP:
            yield first, row
            held, first = 0, row
        held += count
    yield first, len(counts)


def filled(projected: Projected, counts: IntArray, rows: tuple[int, int], parts: int) -> Lists:
    """The lists of the cells in some rows: where each begins and ends, and the columns of `fill_parts`."""
    own = counts[rows[0] : rows[1]].reshape(-1)
    ends = np.cumsum(own, dtype=np.int64)
    total, begins = int(ends[-1]), ends - own
    columns = (
        recycled((total,), np.int32),
        recycled((total,), np.int64),
        recycled((2 * total,), np.float32),
        recycled((3 * total,), np.float64),
    )
    free = begins.copy()
    given = *arrays(projected), read_only(projected.sides), (projected.width, projected.height)
    share(lambda part: fill_parts(part, parts, *given, rows, free, *columns), parts)
    return begins, free, columns


def painted(
    projected: Projected,
    rows: tuple[int, int],
    lists: Lists,
    most: tuple[int, int],
    picture: tuple[IntArray, FloatArray],
) -> IntArray:
    """Paint some rows of cells into face and depth (H, W); the counters, all threads together."""
    begins, ends, columns = lists
    parts, size = threads(), (projected.width, projected.height)
    face, depth = (array.reshape(-1) for array in picture)
    numbers = projected.face_count, read_only(projected.piece_source)
    work = np.zeros((parts, COUNTERS), dtype=np.int64)
    given = begins, ends, *columns, *numbers, most, face, depth
    share(lambda part: paint_cells(part, parts, rows, size, *given, work[part]), parts)
    total: IntArray = work.sum(axis=0)
    return total


def arrays(projected: Projected) -> tuple[IntArray, IntArray, FloatArray]:
    """Faces, corners and depths, flat."""
    return (
        read_only(projected.faces).reshape(-1),
        read_only(projected.xy).reshape(-1),
        read_only(projected.depth),
    )
