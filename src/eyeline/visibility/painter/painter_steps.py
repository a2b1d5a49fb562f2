"""The painter's decisions, one by one, to be read: the same lists, tests, swaps and cuts as the kernel's."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from eyeline.geometry.fixedpoint import CENTRE, UNITS, depth_at, depth_plane
from eyeline.projection.projected import CLOCKWISE, COUNTER_CLOCKWISE, Projected
from eyeline.visibility.method import Step
from eyeline.visibility.painter.cell_masks import CELL

if TYPE_CHECKING:
    from eyeline.visibility.painter.painter import Painter

Pixel = tuple[int, int]
Plane = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Part:
    """What is left to paint of a face in one cell."""

    face: int  # scene face
    plane: Plane
    low: np.float32  # nowhere in the cell is it farther
    high: np.float32  # nowhere in the cell is it nearer
    pixels: frozenset[Pixel]

    def before(self, other: Part) -> frozenset[Pixel]:
        """Those of its pixels that lie before the other's plane; of equal depths the lower face is before."""
        return frozenset(pixel for pixel in self.pixels if is_nearer(self, other, pixel))

    def cut(self, border: frozenset[Pixel]) -> tuple[Part, Part]:
        """The part outside a border, and the part within."""
        return tuple(  # type: ignore[return-value]
            Part(self.face, self.plane, self.low, self.high, pixels)
            for pixels in (self.pixels - border, self.pixels & border)
        )


def is_nearer(part: Part, other: Part, pixel: Pixel) -> bool:
    """Whether a part's plane is nearer than another's at a pixel; a tie goes to the lower face."""
    own, theirs = depth_at(*part.plane, *pixel), depth_at(*other.plane, *pixel)
    return bool(own > theirs or (own == theirs and part.face < other.face))


def steps(painter: Painter, projected: Projected) -> Iterator[Step]:
    """Faces turned away; then cell by cell the list, each comparison, swap and cut; then the painting."""
    from eyeline.visibility.painter.painter import WORK

    work = dict.fromkeys(WORK, 0)
    cells: dict[Pixel, list[Part]] = {}
    for number, source in enumerate(projected.source.tolist()):
        work["faces"] += 1
        corners = clockwise(projected, number)
        if not corners:
            work["faces turned away"] += 1
            yield Step("dropped", f"face {source} turns away", {"face": source}, dict(work))
            continue
        for corner, part in parts_of(source, corners, projected.width, projected.height):
            cells.setdefault(corner, []).append(part)
    orders: list[list[Part]] = []
    for corner in sorted(cells, key=lambda corner: corner[::-1]):
        # Farthest first; of equal depths the later face first
        parts = list(reversed(cells[corner]))
        parts.sort(key=lambda part: part.low)
        work["parts of faces in cells"] += len(parts)
        order: list[Part] = []
        orders.append(order)
        yield from put_in_order(painter, corner, parts, order, work)
    face = np.full((projected.height, projected.width), -1, dtype=np.int32)
    depth = np.zeros(face.shape, dtype=np.float32)
    for group in far_to_near(orders):
        pixels = [pixel for part in group for pixel in sorted(part.pixels)]
        for part in group:
            for x, y in part.pixels:
                face[y, x], depth[y, x] = part.face, depth_at(*part.plane, x, y)
        work["pixels painted"] += len(pixels)
        data = {"face": group[0].face, "pixels": pixels, "verdict": "kept"}
        yield Step("painted", f"face {group[0].face} is painted over {len(pixels)} pixels", data, dict(work))
    yield Step("done", "the nearest face was painted last", {"face": face, "depth": depth}, dict(work))


def put_in_order(
    painter: Painter, corner: Pixel, parts: list[Part], order: list[Part], work: dict[str, int]
) -> Iterator[Step]:
    """Move parts from the list of a cell, farthest first, to the order they are painted in.

    A part goes when all that are left were compared with it and none has to come before it; while one has to,
    the part waits.
    """
    where = {"rectangle": (*corner, corner[0] + CELL, corner[1] + CELL)}
    names = [part.face for part in parts]
    listed = f"in the cell at {corner}, farthest first: {', '.join(f'face {name}' for name in names)}"
    yield Step("sorted", listed, {"faces": names, **where}, dict(work))
    waiting: list[tuple[Part, set[Part]]] = []  # a part, and which it was compared with
    while parts:
        waiting = waiting or [(parts[0], set())]
        part, met = waiting[-1]
        other = next((one for one in parts if one is not part and one not in met), None)
        found, sentence = compared(part, other) if other else ("", "")
        pair: dict[str, Any] = {"faces": [part.face, other.face], **where} if other else {}
        if found:
            work[found] += 1
            yield Step("compared", sentence, pair, dict(work))
        hidden = found == "behind the other's plane" and other and part.pixels <= other.pixels
        if hidden:
            work["parts wholly hidden"] += 1
            yield Step("dropped", f"face {part.face} is wholly hidden here", pair, dict(work))
        if other is None or found == "apart in depth" or hidden:
            order += [] if hidden else [part]
            parts.remove(part)
            waiting.pop()
        elif found:
            met.add(other)
        elif comes_first(other, part) and all(other is not one for one, _ in waiting):
            work["swaps"] += 1
            met.add(other)
            waiting.append((other, set()))
            swap = f"face {other.face} is behind face {part.face}, and comes before it"
            yield Step("swapped", swap, pair, dict(work))
        else:
            work["splits"] += 1
            yield split(parts, [one for one, _ in waiting], other, where, work)
            waiting = []
        painter.refuse(np.array(list(work.values())[2:]))


def compared(part: Part, other: Part) -> tuple[str, str]:
    """Which of the five tests lets `part` be painted before `other`, and a sentence; empty if none does."""
    who, whom = f"face {part.face}", f"face {other.face}"
    if other.low > part.high:
        return "apart in depth", f"{who} is farther than {whom} everywhere, and than all after it"
    if not all({one[k] for one in part.pixels} & {one[k] for one in other.pixels} for k in (0, 1)):
        return "apart across or down", f"{who} and {whom} share no column or no row"
    if not part.pixels & other.pixels:
        return "sharing no pixel", f"{who} and {whom} share no pixel"
    if not part.before(other):
        return "behind the other's plane", f"{who} lies wholly behind the plane of {whom}"
    if all(is_nearer(other, part, pixel) for pixel in other.pixels):
        return "the other before its plane", f"{whom} lies wholly before the plane of {who}"
    return "", ""


def comes_first(part: Part, other: Part) -> bool:
    """Whether the tests of planes allow `part` before `other`."""
    return not part.before(other) or len(other.before(part)) == len(other.pixels)


def split(
    parts: list[Part], waiting: list[Part], other: Part, where: dict[str, Any], work: dict[str, int]
) -> Step:
    """Cut the part that waits last along the other's plane, or, in a cycle, one along another's border."""
    part = waiting[-1]
    if comes_first(other, part):
        # From the last that waits, the first that is not all of what it waits for
        for part in reversed(waiting):
            if not part.pixels <= other.pixels:
                break
            other = part
        border = other.pixels
        why = f"a cycle: face {part.face} is cut along the border of face {other.face}"
    else:
        border = part.before(other)
        where = where | {"segments": crossing(part.plane, other.plane, where["rectangle"])}
        why = f"faces {part.face} and {other.face} pierce each other: the first is cut by the other's plane"
    at = parts.index(part)
    parts[at : at + 1] = part.cut(border)
    data = {
        "face": part.face,
        "faces": [part.face, other.face],
        "tested": sorted(part.pixels & border),
        **where,
    }
    return Step("split", why, data | {"verdict": "split"}, dict(work))


def far_to_near(orders: list[list[Part]]) -> Iterator[list[Part]]:
    """The parts of all cells, each cell in its order, those of a face together where that can be."""
    while orders := [order for order in orders if order]:
        left: dict[int, int] = {}
        for order in orders:
            for part in order:
                left[part.face] = left.get(part.face, 0) + 1
        groups: dict[int, list[Part]] = {}
        for order in orders:
            groups.setdefault(order[0].face, []).append(order[0])
        whole = [group for face, group in groups.items() if len(group) == left[face]]
        group = min(whole or groups.values(), key=lambda group: min(part.low for part in group))
        orders = [order[1:] if order[0] in group else order for order in orders]
        yield group


# --- a face in cells --------------------------------------------------------------------------------------


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


def parts_of(
    face: int, corners: list[tuple[int, int, np.float32]], width: int, height: int
) -> Iterator[tuple[Pixel, Part]]:
    """What a face covers of each cell, with the cell's corner; pixels as far as the back are nothing."""
    a, b, c = depth_plane(*corners[0], *corners[1], *corners[2])
    plane = float(a), float(b), float(c)
    lines = []
    for (x0, y0, _), (x1, y1, _) in zip(corners, corners[1:] + corners[:1], strict=True):
        a, b = y0 - y1, x1 - x0
        lines.append((a, b, x0, y0, 0 if a > 0 or (a == 0 and b > 0) else 1))
    (left, right), (top, bottom) = (
        (max((min(line) + CENTRE - 1) // UNITS, 0), min((max(line) + CENTRE - 1) // UNITS, side))
        for line, side in zip(list(zip(*corners, strict=True))[:2], (width, height), strict=True)
    )
    for row in range(top - top % CELL, bottom, CELL):
        for column in range(left - left % CELL, right, CELL):
            across = range(max(left, column), min(right, column + CELL))
            down = range(max(top, row), min(bottom, row + CELL))
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
            if pixels:
                # The least and greatest depths of a plane stand at corners
                ends = [depth_at(*plane, x, y) for x in (across[0], across[-1]) for y in (down[0], down[-1])]
                yield (column, row), Part(face, plane, max(min(ends), np.float32(0)), max(ends), pixels)


def crossing(
    plane: Plane, other: Plane, rectangle: tuple[int, int, int, int]
) -> list[list[tuple[float, float]]]:
    """The line in which two planes cut each other, inside a rectangle: [(from, to)] in pixels, or nothing."""
    a, b, c = (own - theirs for own, theirs in zip(plane, other, strict=True))
    left, top, right, bottom = rectangle
    ends = [(-(c + b * (y - 0.5)) / a + 0.5, float(y)) for y in (top, bottom) if a]
    ends += [(float(x), -(c + a * (x - 0.5)) / b + 0.5) for x in (left, right) if b]
    inside = sorted({(x, y) for x, y in ends if left <= x <= right and top <= y <= bottom})
    return [[inside[0], inside[-1]]] if len(inside) > 1 else []
