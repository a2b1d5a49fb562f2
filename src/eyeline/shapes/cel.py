"""A drawing as painted outlines, on a clear sheet: what an animator calls a cel."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from eyeline.cached import cached_property
from eyeline.errors import OptionError
from eyeline.scene.colour import linear_from_srgb, mix, srgb_from_linear
from eyeline.shapes.arc_length import ArcLength, pairs
from eyeline.shapes.outline import Outline
from eyeline.shapes.parts import parts_of

Paint = tuple[float, float, float, float]  # sRGB and alpha, 0..1


@dataclass(frozen=True, eq=False)
class Patch:
    """Outlines that are filled and drawn together: the inner ones are holes."""

    outlines: tuple[Outline, ...]
    fill: Paint | None = (0.0, 0.0, 0.0, 1.0)
    stroke: Paint | None = None
    width: float = 1.0  # of the stroke
    even_odd: bool = False  # how holes are told: by counting outlines, not by which way they turn
    name: str = ""

    @cached_property
    def whole(self) -> Outline:
        """The outline that stands for all: the longest."""
        return max(self.outlines, key=lambda one: one.length)

    def nothing(self) -> Patch:
        """All of it at its centre."""
        at = self.whole.centre[None]
        return replace(self, outlines=tuple(Outline(at, one.closed) for one in self.outlines))


@dataclass(frozen=True, eq=False)
class Cel:
    """Patches from back to front, on a sheet of width and height."""

    patches: tuple[Patch, ...]
    size: tuple[float, float]

    def inbetween(self, end: Cel, first: int | None = None) -> CelInbetween:
        """All drawings from this one to another. first: as for `ArcLength`, if each has one outline."""
        return CelInbetween(self, end, first)


@dataclass(frozen=True, eq=False)
class CelInbetween:
    """Patches of one name become each other; the rest by place and size. Colours mix in even steps.

    A patch of one drawing only grows out of its centre, or shrinks into it; so do outlines of a patch.
    """

    start: Cel
    end: Cel
    first: int | None = None

    def __post_init__(self) -> None:
        """Refuse a start among several outlines."""
        counts = [sum(len(one.outlines) for one in cel.patches) for cel in (self.start, self.end)]
        if self.first is not None and counts != [1, 1]:
            raise OptionError(
                f"first is {self.first}, but the drawings have {counts[0]} and {counts[1]} outlines;"
                " it is for one in each"
            )

    def at(self, part: float) -> Cel:
        """The drawing at a part of the way."""
        part = float(parts_of(part)[0])
        patches = tuple(one.at(part) for one in self._patches)
        (width, height), (wide, high) = self.start.size, self.end.size
        return Cel(patches, (width + part * (wide - width), height + part * (high - height)))

    @cached_property
    def _patches(self) -> list[PatchInbetween]:
        """From back to front, by the mean of their places in the two orders."""
        one, other = self.start.patches, self.end.patches
        found = []
        for i, j in self._pairs:
            begin = one[i] if i is not None else other[j or 0].nothing()
            finish = other[j] if j is not None else one[i or 0].nothing()
            places = [place for place in (_rank(i, len(one)), _rank(j, len(other))) if place is not None]
            found.append((sum(places) / len(places), PatchInbetween(begin, finish, self.first)))
        return [patch for _, patch in sorted(found, key=lambda row: row[0])]

    @cached_property
    def _pairs(self) -> list[tuple[int | None, int | None]]:
        one, other = self.start.patches, self.end.patches
        names = {patch.name: j for j, patch in enumerate(other) if patch.name}
        named = [(i, names[patch.name]) for i, patch in enumerate(one) if patch.name in names]
        taken = {i for i, _ in named}, {j for _, j in named}
        left = [i for i in range(len(one)) if i not in taken[0]]
        right = [j for j in range(len(other)) if j not in taken[1]]
        rest = pairs([one[i].whole for i in left], [other[j].whole for j in right])
        return [*named, *((_of(left, i), _of(right, j)) for i, j in rest)]


@dataclass(frozen=True, eq=False)
class PatchInbetween:
    """All patches between two."""

    start: Patch
    end: Patch
    first: int | None = None

    def at(self, part: float) -> Patch:
        """The patch at a part of the way."""
        if part in (0, 1):
            return self.end if part else self.start
        return Patch(
            tuple(one.at(part) for one in self._outlines),
            between(self.start.fill, self.end.fill, part),
            between(self.start.stroke, self.end.stroke, part),
            (1 - part) * self.start.width + part * self.end.width,
            self.start.even_odd,
            self.start.name,
        )

    @cached_property
    def _outlines(self) -> list[ArcLength]:
        one, other = self.start.outlines, self.end.outlines
        return [
            ArcLength(
                one[i] if i is not None else other[j or 0].shrunk(),
                other[j] if j is not None else one[i or 0].shrunk(),
                self.first,
            )
            for i, j in pairs(one, other)
        ]


def between(start: Paint | None, end: Paint | None, part: float) -> Paint | None:
    """The paint at a part of the way; no paint is the other one, clear."""
    if start is None and end is None:
        return None
    begin = start or (*end[:3], 0.0) if end else start
    finish = end or (*start[:3], 0.0) if start else end
    assert begin is not None and finish is not None
    light = mix(linear_from_srgb(np.array(begin[:3])), linear_from_srgb(np.array(finish[:3])), part)
    red, green, blue = np.clip(srgb_from_linear(light), 0, 1).tolist()
    alpha = min(1.0, max(0.0, begin[3] + part * (finish[3] - begin[3])))
    return red, green, blue, alpha


def _rank(place: int | None, count: int) -> float | None:
    return None if place is None else (place + 0.5) / count


def _of(numbers: list[int], place: int | None) -> int | None:
    return None if place is None else numbers[place]
