"""Warnock's subdivision to be read: area by area, how the faces lie to it, and what is decided."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from eyeline.cached import cached_property
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.geometry.fixedpoint import CENTRE, UNITS, depth_at, edge_bias
from eyeline.projection.projected import Projected
from eyeline.visibility.method import Step, counted
from eyeline.visibility.warnock.area_lists import TILE, Lists
from eyeline.visibility.warnock.quartering import SMALL
from eyeline.visibility.warnock.relations import LEAST_SINGLE, REACH, ROUNDING, SINGLE, WORDS

Pixel = tuple[int, int]


class Box(NamedTuple):
    """Pixels from the first to the last, both counted."""

    left: int
    top: int
    right: int
    bottom: int

    @property
    def corners(self) -> list[Pixel]:
        """Its four corner pixels."""
        return [(x, y) for y in (self.top, self.bottom) for x in (self.left, self.right)]

    @property
    def pixels(self) -> list[Pixel]:
        """All its pixels (x, y)."""
        rows, columns = range(self.top, self.bottom + 1), range(self.left, self.right + 1)
        return [(x, y) for y in rows for x in columns]

    def common(self, other: Box) -> Box:
        """What both hold; empty if its left is not before its right, or its top not above its bottom."""
        return Box(*map(max, self[:2], other[:2]), *map(min, self[2:], other[2:]))


@dataclass(frozen=True, eq=False)
class Polygon:
    """A face as the list holds it."""

    number: int  # the scene face
    corners: list[Pixel]  # clockwise, 1/256 pixel
    plane: list[float]  # a, b, c of `depth_plane`
    box: Box
    bound: np.float32  # no depth of it, or of one that comes after it in the list, is greater

    @cached_property
    def edges(self) -> list[tuple[int, int, int]]:
        """(a, b, c) of each edge: pixel (x, y) is inside where all a x + b y + c are 0 or more."""
        found = []
        for (x0, y0), (x1, y1) in zip(self.corners, self.corners[1:] + self.corners[:1], strict=True):
            a, b = y0 - y1, x1 - x0
            c = a * (CENTRE - x0) + b * (CENTRE - y0) + int(edge_bias(a, b))
            found.append((a * UNITS, b * UNITS, c))
        return found

    @property
    def slack(self) -> float:
        """More than rounding moves its heights."""
        a, b, c = self.plane
        return ROUNDING * (abs(c) + (abs(a) + abs(b)) * REACH)

    def heights(self, area: Box) -> list[float]:
        """Its depths at the four corners of an area, not rounded to float32 yet."""
        a, b, c = self.plane
        return [(c + b * float(y)) + a * float(x) for x, y in area.corners]

    def covered(self, area: Box) -> list[Pixel]:
        """The pixels of an area that it covers."""
        pixels = area.common(self.box).pixels
        return [(x, y) for x, y in pixels if all(a * x + b * y + c >= 0 for a, b, c in self.edges)]

    def relation(self, area: Box) -> str:
        """How it lies to an area."""
        both = area.common(self.box)
        if both.left > both.right or both.top > both.bottom:
            return "disjoint"
        if both == self.box != area:
            return "contained"
        values = [[a * x + b * y + c for x, y in area.corners] for a, b, c in self.edges]
        if min(map(min, values)) >= 0:
            return "surrounding"
        if both == self.box:
            return "contained"
        return "disjoint" if min(map(max, values)) < 0 else "intersecting"

    def surely_hides(self, other: Polygon, area: Box) -> bool:
        """Whether it, which surrounds an area, is nearer than another at all pixels, however depths round."""
        wins_ties = self.number < other.number
        if self.plane == other.plane:
            return wins_ties
        own, others = self.heights(area), other.heights(area)
        doubt = self.slack + other.slack
        if not wins_ties:
            doubt += SINGLE * max(map(abs, own + others)) + LEAST_SINGLE
        return min(one - two for one, two in zip(own, others, strict=True)) > doubt


@dataclass(eq=False)
class Canvas:
    """The picture so far, and the counters."""

    face: IntArray
    depth: FloatArray
    work: dict[str, int] = field(default_factory=dict)

    def put(self, polygon: Polygon, pixels: list[Pixel]) -> list[Pixel]:
        """Let a face fall on pixels; those where it is the nearest."""
        (a, b, c), taken = polygon.plane, []
        for x, y in pixels:
            own = depth_at(a, b, c, x, y)
            if own > self.depth[y, x] or (own == self.depth[y, x] > 0 and polygon.number < self.face[y, x]):
                self.face[y, x], self.depth[y, x] = polygon.number, own
                taken.append((x, y))
        return taken


def steps_of(projected: Projected, lists: Lists, names: tuple[str, ...]) -> Iterator[Step]:
    """A step for every area; names: of the counters."""
    width, height = projected.width, projected.height
    face = np.full((height, width), -1, dtype=np.int32)
    canvas = Canvas(face, np.zeros(face.shape, dtype=np.float32), dict.fromkeys(names, 0))
    work, records = canvas.work, lists.records
    work["faces"] = len(projected.faces)
    work["faces turned away"], work["faces beside pixels"] = records.turned_away, records.beside
    work["faces coincident"] = len(records.near) - len(lists.order)
    everything = polygons_of(lists)
    for y in range(0, height, TILE):
        for x in range(0, width, TILE):
            tile = Box(x, y, min(x + TILE, width) - 1, min(y + TILE, height) - 1)
            touching = [one for one in everything if is_reached(tile, one.box)]
            yield from cut_until_easy(tile, TILE, touching, canvas)
    data = {"face": canvas.face, "depth": canvas.depth}
    yield Step("done", "every area is decided", data, dict(work))


def is_reached(area: Box, box: Box) -> bool:
    """Whether an area and a box have a pixel in common."""
    both = area.common(box)
    return both.left <= both.right and both.top <= both.bottom


def polygons_of(lists: Lists) -> list[Polygon]:
    """All faces, nearest first."""
    found = []
    for r in lists.order.tolist():
        words = lists.records.words[WORDS * r : WORDS * (r + 1)]
        corners = [(int(one.astype(np.int32)), int(one >> 32)) for one in words[:3]]
        shifts = (int(lists.records.boxes[r]) >> bits & 65535 for bits in (0, 16, 32, 48))
        plane = words[3:6].view(np.float64).tolist()
        found.append(Polygon(int(words[6]), corners, plane, Box(*shifts), np.float32(lists.bound[r])))
    return found


def cut_until_easy(area: Box, side: int, given: list[Polygon], canvas: Canvas) -> Iterator[Step]:
    """One area, and its quarters if it is not easy. given: the faces that reach it, nearest first."""
    canvas.work["areas"] += 1
    told, kept, surrounder = looked_through(area, side, given, canvas.work)
    place = f"area {area.right - area.left + 1}x{area.bottom - area.top + 1} at ({area.left}, {area.top})"
    data: dict[str, Any] = {"rectangle": (area.left, area.top, area.right + 1, area.bottom + 1)}
    faces = [one.number for one in kept]
    if len(kept) > 1 and side > SMALL:
        canvas.work["areas cut"] += 1
        sentence = f"{place}: {told}; {len(kept)} faces are left, so it is cut into quarters"
        yield Step("cut", sentence, data | {"faces": faces, "verdict": "split"}, dict(canvas.work))
        half = side // 2
        for y in (area.top, area.top + half):
            for x in (area.left, area.left + half):
                if x <= area.right and y <= area.bottom:
                    quarter = Box(x, y, min(x + half - 1, area.right), min(y + half - 1, area.bottom))
                    touching = [one for one in kept if is_reached(quarter, one.box)]
                    canvas.work["disjoint"] += len(kept) - len(touching)
                    yield from cut_until_easy(quarter, half, touching, canvas)
        return
    data["settled"] = True
    if not kept:
        yield Step("empty", f"{place}: {told}; it is background", data, dict(canvas.work))
    elif len(kept) == 1:
        (one,) = kept
        pixels = area.pixels if one is surrounder else one.covered(area)
        alone = f"is alone in it, on {counted(len(pixels), 'pixel')}"
        how = "surrounds it and fills it" if one is surrounder else alone
        data |= {"face": one.number, "pixels": canvas.put(one, pixels), "verdict": "kept"}
        kind = "surrounded" if one is surrounder else "one face"
        yield Step(kind, f"{place}: {told}; face {one.number} {how}", data, dict(canvas.work))
    else:
        yield from sampled(area, f"{place}: {told}", kept, canvas)


def sampled(area: Box, place: str, kept: list[Polygon], canvas: Canvas) -> Iterator[Step]:
    """An area too small to cut: the nearest face at the centre of each of its pixels."""
    rectangle = (area.left, area.top, area.right + 1, area.bottom + 1)
    for one in kept:
        tested = one.covered(area)
        canvas.work["depth comparisons"] += len(tested)
        taken = canvas.put(one, tested)
        sentence = (
            f"{place}; too small to cut: face {one.number} covers {counted(len(tested), 'pixel')} of it"
            f" and is the nearest so far at {len(taken)}"
        )
        data = {
            "rectangle": rectangle, "face": one.number, "pixels": taken, "tested": tested,
            "settled": one is kept[-1], "verdict": "kept" if taken else "dropped",
        }  # fmt: skip
        yield Step("sampled", sentence, data, dict(canvas.work))


def looked_through(
    area: Box, side: int, given: list[Polygon], work: dict[str, int]
) -> tuple[str, list[Polygon], Polygon | None]:
    """What may be seen in an area: (what was found, in words; the faces kept; the nearest surrounder)."""
    before, kept = dict(work), list[Polygon]()
    surrounder, far, earlier = None, np.float32(0), 0
    for place, one in enumerate(given):
        if surrounder and one.bound < far:
            work["hidden"] += len(given) - place  # all that come later are as far away
            break
        relation = one.relation(area)
        work[relation] += 1
        if relation == "disjoint":
            continue
        if surrounder and side > SMALL:
            work["depth comparisons"] += 4
            if surrounder.surely_hides(one, area):
                work["hidden"] += 1
                continue
        if relation == "surrounding":
            reach = np.float32(min(one.heights(area)) - one.slack)
            if surrounder is None or reach > far:
                surrounder, far, earlier = one, reach, len(kept)
        kept.append(one)
    if surrounder and side > SMALL:
        work["depth comparisons"] += 4 * earlier
        first = [one for one in kept[:earlier] if not surrounder.surely_hides(one, area)]
        work["hidden"] += earlier - len(first)
        kept = first + kept[earlier:]
    relations = ("surrounding", "intersecting", "contained", "disjoint", "hidden")
    found = [f"{work[name] - before[name]} {name}" for name in relations if work[name] > before[name]]
    return ", ".join(found) or "no face", kept, surrounder
