"""Area subdivision: an area that is too hard to decide is cut into quarters. [Warnock69]

Faces surround an area, intersect it, are contained in it, or are disjoint from it. An area is easy where none
but one is left: disjoint ones go, and so does what a surrounding face hides.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from eyeline.cached import cached_property
from eyeline.errors import OptionError
from eyeline.geometry.arrays import FloatArray, IntArray, read_only
from eyeline.geometry.memory import recycled
from eyeline.jit import share, threads
from eyeline.projection.projected import Projected
from eyeline.visibility.method import Step, Visible
from eyeline.visibility.warnock.area_lists import AREAS, CUT, Lists, lists_of, records_of
from eyeline.visibility.warnock.area_steps import steps_of
from eyeline.visibility.warnock.quartering import subdivide

WORK = (
    "faces", "faces turned away", "faces beside pixels", "faces coincident", "areas", "areas cut",
    "surrounding", "intersecting", "contained", "disjoint", "hidden", "depth comparisons",
)  # fmt: skip
MOST_WORK = 1 << 34  # relations and comparisons: about a minute
DECISIONS = ("empty", "surrounded", "one face", "sampled")  # what an area was when it was not cut


@dataclass(frozen=True)
class Warnock:
    """Area subdivision: cuts the picture into quarters until each is easy, and keeps the quarters."""

    name: str = "warnock"
    space: str = "image"
    answers: bool = True
    exact: bool = True

    def __call__(self, projected: Projected) -> Subdivided:
        """The nearest face at every pixel; refused are scenes that take more than MOST_WORK."""
        records = records_of(projected)
        lists = lists_of(projected, records)
        shape = projected.height, projected.width
        face, depth = recycled(shape, np.int32), recycled(shape, np.float32)
        decide(projected, lists, (face, depth), (np.empty((0, 6), np.int32), np.empty(0, np.int64)))
        work = work_of(projected, lists)
        return Subdivided(face, depth, projected, self, work, lists=lists)

    def steps(self, projected: Projected) -> Iterator[Step]:
        """Area by area: how faces lie to it, and what is decided; the last step holds the picture."""
        records = records_of(projected)
        yield from steps_of(projected, lists_of(projected, records), WORK)


@dataclass(frozen=True, eq=False)
class Areas:
    """The areas that were not cut: together they are the picture, and no pixel is in two."""

    rectangles: IntArray  # (N, 4) int32 left, top, right, bottom: borders in pixels
    decision: IntArray  # (N,) int32 into DECISIONS
    face: IntArray  # (N,) int32: the one face of an area; -1 where there is none or were several


@dataclass(frozen=True, eq=False)
class Subdivided(Visible):
    """What is seen, and the areas that it was decided in."""

    lists: Lists | None = None  # what the areas begin with

    @cached_property
    def areas(self) -> Areas:
        """The areas, tile after tile; the picture is cut once more when they are asked for."""
        assert self.lists is not None
        ends = np.cumsum(self.lists.counts[:, AREAS] - self.lists.counts[:, CUT])
        rows, firsts = np.empty((int(ends[-1]), 6), np.int32), np.concatenate([[0], ends])[:-1]
        again = self.lists._replace(counts=np.zeros_like(self.lists.counts))
        decide(self.projected, again, (np.empty_like(self.face), np.empty_like(self.depth)), (rows, firsts))
        return Areas(rows[:, :4], rows[:, 4], rows[:, 5])


def decide(
    projected: Projected,
    lists: Lists,
    picture: tuple[IntArray, FloatArray],
    areas: tuple[IntArray, IntArray],
) -> None:
    """Cut all tiles; fills the picture, the counters of the lists and, where there is room, the areas.

    picture: face and depth, (H, W); areas: (N, 6) int32, and where those of each tile begin.
    """
    parts, (face, depth) = threads(), picture
    spent = np.zeros(parts, np.int64)
    given = (
        projected.width, projected.height, read_only(lists.starts), read_only(lists.entries),
        read_only(lists.records.words), read_only(lists.bound), face.reshape(-1),
        depth.view(np.int32).reshape(-1), lists.counts, MOST_WORK, spent, *areas,
    )  # fmt: skip
    share(lambda part: subdivide(part, parts, *given), parts)
    if spent.sum() > MOST_WORK:
        raise OptionError(
            f"warnock would compare faces more than {MOST_WORK:,} times: too many lie before each other and "
            "none hides the rest; use method 'zbuffer', or a smaller picture"
        )


def work_of(projected: Projected, lists: Lists) -> Mapping[str, int]:
    """The counters, named."""
    records = lists.records
    numbers = (
        len(projected.faces), records.turned_away, records.beside, len(records.near) - len(lists.order),
        *lists.counts.sum(axis=0).tolist(),
    )  # fmt: skip
    return dict(zip(WORK, numbers, strict=True))
