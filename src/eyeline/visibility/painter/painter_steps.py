"""The painter's decisions, one by one, to be read: Newell, Newell and Sancha as in their paper. [Newell72]

One list of whole faces for the whole picture: sorted, compared by the five tests, swapped, cut, painted. The
kernel keeps such a list for every cell of the picture; what is painted is the same at every pixel, and where
the picture is one cell the counters are the same too.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np

from eyeline.cached import cached_property
from eyeline.geometry.fixedpoint import CENTRE, UNITS, depth_at, depth_plane
from eyeline.projection.projected import CLOCKWISE, COUNTER_CLOCKWISE, Projected
from eyeline.visibility.method import Step

if TYPE_CHECKING:
    from eyeline.visibility.painter.painter import Painter

Pixel = tuple[int, int]
Plane = tuple[float, float, float]
Event = tuple[Step, "Part | None"]  # a step, and the part that falls on the picture in it
NAMED = 8  # faces of a list that a sentence names


@dataclass(frozen=True, eq=False)
class Part:
    """What is left to paint of a face."""

    face: int  # scene face
    plane: Plane
    low: np.float32  # nowhere is it farther
    high: np.float32  # nowhere is it nearer
    pixels: frozenset[Pixel]
    whole: bool = True  # whether it was never cut

    @property
    def name(self) -> str:
        """What sentences call it."""
        return f"face {self.face}" if self.whole else f"a piece of face {self.face}"

    @cached_property
    def depths(self) -> dict[Pixel, np.float32]:
        """Its depth at each of its pixels."""
        return {pixel: depth_at(*self.plane, *pixel) for pixel in self.pixels}

    @cached_property
    def spread(self) -> tuple[set[int], set[int]]:
        """The columns and the rows in which it has pixels."""
        return {x for x, _ in self.pixels}, {y for _, y in self.pixels}

    def before(self, other: Part) -> frozenset[Pixel]:
        """Those of its pixels that lie before the other's plane; of equal depths the lower face is before."""
        return frozenset(pixel for pixel in self.pixels if self.is_before(other, pixel))

    def is_before(self, other: Part, pixel: Pixel) -> bool:
        """Whether it is nearer at one of its pixels than another's plane; a tie goes to the lower face."""
        own, theirs = self.depths[pixel], depth_at(*other.plane, *pixel)
        return bool(own > theirs or (own == theirs and self.face < other.face))

    def cut(self, border: frozenset[Pixel]) -> tuple[Part, Part]:
        """The part outside a border, and the part within."""
        return tuple(  # type: ignore[return-value]
            Part(self.face, self.plane, self.low, self.high, pixels, whole=False)
            for pixels in (self.pixels - border, self.pixels & border)
        )


@dataclass(frozen=True, eq=False)
class Waiting:
    """A part that waits, and those that it was compared with."""

    part: Part
    met: set[Part] = field(default_factory=set)


def steps(painter: Painter, projected: Projected) -> Iterator[Step]:
    """Faces turned away; the list, farthest first; comparisons, swaps, cuts; each part as it is painted."""
    from eyeline.visibility.painter.painter import WORK

    work = dict.fromkeys(WORK, 0)
    parts: list[Part] = []
    for number, source in enumerate(projected.source.tolist()):
        work["faces"] += 1
        corners = clockwise(projected, number)
        if not corners:
            work["faces turned away"] += 1
            yield Step("dropped", f"face {source} turns away", {"face": source}, dict(work))
            continue
        parts += part_of(source, corners, projected.width, projected.height)
    # Farthest first; of equal depths the later face first
    parts.reverse()
    parts.sort(key=lambda part: part.low)
    work["parts of faces"] = len(parts)
    names = [part.face for part in parts]
    if parts:
        yield Step("sorted", f"farthest first: {listed(names)}", {"faces": names}, dict(work))
    face = np.full((projected.height, projected.width), -1, dtype=np.int32)
    depth = np.zeros(face.shape, dtype=np.float32)
    for step, part in told_together(put_in_order(painter, parts, work)):
        for (x, y), own in part.depths.items() if part else ():
            face[y, x], depth[y, x] = step.data["face"], own
        yield step
    yield Step("done", "the nearest face was painted last", {"face": face, "depth": depth}, dict(work))


def put_in_order(painter: Painter, parts: list[Part], work: dict[str, int]) -> Iterator[Event]:
    """Take parts from the list, farthest first: what was done, and the part that is now to be painted.

    A part goes when all that are left were compared with it and none has to come before it; while one has to,
    the part waits.
    """
    waiting: list[Waiting] = []
    while parts:
        waiting = waiting or [Waiting(parts[0])]
        part, met = waiting[-1].part, waiting[-1].met
        other = next((one for one in parts if one is not part and one not in met), None)
        found, sentence = compared(part, other) if other else ("", "")
        pair: dict[str, Any] = {"face": part.face, "faces": [other.face] if other else []}
        if found:
            work[found] += 1
            yield Step("compared", sentence, pair | {"test": found}, dict(work)), None
        hidden = found == "behind the other's plane" and other and part.pixels <= other.pixels
        if hidden:
            work["parts wholly hidden"] += 1
            yield Step("dropped", f"{part.name} is wholly hidden", pair, dict(work)), None
        if other is None or found == "apart in depth" or hidden:
            parts.remove(part)
            waiting.pop()
            if not hidden:
                yield painted(part, work), part
        elif found:
            met.add(other)
        elif comes_first(other, part) and all(other is not one.part for one in waiting):
            work["swaps"] += 1
            met.add(other)
            waiting.append(Waiting(other))
            swap = f"all five tests fail, but {other.name} is behind {part.name}, and comes before it"
            yield Step("swapped", swap, pair, dict(work)), None
        else:
            work["splits"] += 1
            yield split(parts, [one.part for one in waiting], other, work), None
            waiting = []
        painter.refuse(np.array(list(work.values())[2:]))


def told_together(events: Iterator[Event]) -> Iterator[Event]:
    """The same, but what is apart from one part across or down, one after the other, in one step."""
    for (test, _), group in groupby(events, lambda event: (event[0].data.get("test"), event[0].data["face"])):
        if test != "apart across or down":
            yield from group
            continue
        told = [step for step, _ in group]
        faces = [face for step in told for face in step.data["faces"]]
        if len(told) == 1:
            yield told[0], None
            continue
        last = told[-1]
        sentence = f"test 2: face {last.data['face']} shares no column or no row with {listed(faces)}"
        yield Step(last.kind, sentence, dict(last.data) | {"faces": faces}, last.work), None


def listed(faces: list[int]) -> str:
    """The first of some faces by their numbers, and how many more there are."""
    more = f" and {len(faces) - NAMED} more" if len(faces) > NAMED else ""
    return f"face {', '.join(map(str, faces[:NAMED]))}{more}"


def painted(part: Part, work: dict[str, int]) -> Step:
    """The step in which a part falls on the picture."""
    work["pixels painted"] += len(part.pixels)
    told = f"none left has to come before {part.name}: it is painted over {len(part.pixels)} pixels"
    data = {"face": part.face, "pixels": sorted(part.pixels), "verdict": "kept"}
    return Step("painted", told, data, dict(work))


def compared(part: Part, other: Part) -> tuple[str, str]:
    """Which of the five tests lets `part` be painted before `other`, and a sentence; empty if none does."""
    who, whom = part.name, other.name
    if other.low > part.high:
        return "apart in depth", f"test 1: {who} is farther than {whom} everywhere, and than all after it"
    if any(own.isdisjoint(others) for own, others in zip(part.spread, other.spread, strict=True)):
        return "apart across or down", f"test 2: {who} and {whom} share no column or no row"
    if not part.pixels & other.pixels:
        return "sharing no pixel", f"test 3: {who} and {whom} share no pixel"
    if not any(part.is_before(other, pixel) for pixel in part.pixels):
        return "behind the other's plane", f"test 4: {who} lies wholly behind the plane of {whom}"
    if all(other.is_before(part, pixel) for pixel in other.pixels):
        return "the other before its plane", f"test 5: {whom} lies wholly before the plane of {who}"
    return "", ""


def comes_first(part: Part, other: Part) -> bool:
    """Whether the tests of planes allow `part` before `other`."""
    return not part.before(other) or len(other.before(part)) == len(other.pixels)


def split(parts: list[Part], waiting: list[Part], other: Part, work: dict[str, int]) -> Step:
    """Cut the part that waits last along the other's plane, or, in a cycle, one along another's border."""
    part, line = waiting[-1], list[list[tuple[float, float]]]()
    if comes_first(other, part):
        ring = ", ".join(str(one.face) for one in [*waiting, other])
        # From the last that waits, the first that is not all of what it waits for
        for part in reversed(waiting):
            if not part.pixels <= other.pixels:
                break
            other = part
        border = other.pixels
        why = f"a cycle: of face {ring} each waits for the next; {part.name} is cut at the border of face"
        why = f"{why} {other.face}"
    else:
        border, line = part.before(other), crossing(part, other)
        why = f"all tests fail, and the other way round too: {part.name} is cut by the plane of {other.name}"
    at = parts.index(part)
    parts[at : at + 1] = part.cut(border)
    data = {"face": part.face, "faces": [other.face], "tested": sorted(part.pixels & border)}
    return Step("split", why, data | {"segments": line, "verdict": "split"}, dict(work))


# --- a face as a part -------------------------------------------------------------------------------------


def clockwise(projected: Projected, number: int) -> list[tuple[int, int, np.float32]]:
    """The corners of a face, clockwise; none if it shows no side that counts."""
    corners = [
        (int(projected.xy[vertex, 0]), int(projected.xy[vertex, 1]), projected.depth[vertex])
        for vertex in projected.faces[number]
    ]
    (x0, y0, _), (x1, y1, _), (x2, y2, _) = corners
    area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    sides = int(projected.sides[number if len(projected.sides) > 1 else 0])
    if area == 0 or not sides & (CLOCKWISE if area > 0 else COUNTER_CLOCKWISE):
        return []
    return corners if area > 0 else [corners[0], corners[2], corners[1]]


def part_of(face: int, corners: list[tuple[int, int, np.float32]], width: int, height: int) -> list[Part]:
    """What a face covers of the picture; pixels as far as the back are nothing. None where that is all."""
    a, b, c = depth_plane(*corners[0], *corners[1], *corners[2])
    plane = float(a), float(b), float(c)
    lines = []
    for (x0, y0, _), (x1, y1, _) in zip(corners, corners[1:] + corners[:1], strict=True):
        a, b = y0 - y1, x1 - x0
        lines.append((a, b, x0, y0, 0 if a > 0 or (a == 0 and b > 0) else 1))
    across, down = (
        range(max((min(line) + CENTRE - 1) // UNITS, 0), min((max(line) + CENTRE - 1) // UNITS, side))
        for line, side in zip(list(zip(*corners, strict=True))[:2], (width, height), strict=True)
    )
    pixels = frozenset(
        (x, y)
        for y in down
        for x in across
        if all(
            a * (UNITS * x + CENTRE - x0) + b * (UNITS * y + CENTRE - y0) >= least
            for a, b, x0, y0, least in lines
        )
        and depth_at(*plane, x, y) > 0
    )
    if not pixels:
        return []
    # The least and greatest depths of a plane stand at corners
    ends = [depth_at(*plane, x, y) for x in (across[0], across[-1]) for y in (down[0], down[-1])]
    return [Part(face, plane, max(min(ends), np.float32(0)), max(ends), pixels)]


def crossing(part: Part, other: Part) -> list[list[tuple[float, float]]]:
    """The line in which the planes of two parts cut each other, around the pixels of the first."""
    a, b, c = (own - theirs for own, theirs in zip(part.plane, other.plane, strict=True))
    (left, right), (top, bottom) = (
        (min(pixel[k] for pixel in part.pixels), max(pixel[k] for pixel in part.pixels) + 1) for k in (0, 1)
    )
    ends = [(-(c + b * (y - 0.5)) / a + 0.5, float(y)) for y in (top, bottom) if a]
    ends += [(float(x), -(c + a * (x - 0.5)) / b + 0.5) for x in (left, right) if b]
    inside = sorted({(x, y) for x, y in ends if left <= x <= right and top <= y <= bottom})
    return [[inside[0], inside[-1]]] if len(inside) > 1 else []
