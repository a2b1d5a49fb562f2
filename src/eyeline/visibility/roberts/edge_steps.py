"""One edge before the bodies near it, to be read: the same decisions as the kernel's, one by one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from eyeline.geometry.fixedpoint import UNITS
from eyeline.visibility.method import Step
from eyeline.visibility.roberts.hidden_spans import (
    BEHIND_ITSELF,
    DUST,
    SPECK,
    TESTED,
    TURNED_AWAY,
    Question,
)

Span = tuple[float, float]  # where in 0..1 along an edge; none of it if the first is not less
Segment = tuple[tuple[float, float], tuple[float, float]]  # pixels
FATES = {
    TURNED_AWAY: ("edges turned away", "is hidden: its faces all turn away"),
    BEHIND_ITSELF: (
        "edges behind their own body",
        "is hidden: it is on the far side of its own convex body",
    ),
}


@dataclass(frozen=True)
class Line:
    """One edge: P0 + t (P1 - P0)."""

    number: int
    faces: list[int]  # that meet at it
    p0: tuple[float, float, float]  # x and y in 1/256 pixel, depth
    p1: tuple[float, float, float]
    inside: Span  # the part in the picture

    @property
    def long(self) -> float:
        """Its length across or down, whichever is greater."""
        return max(abs(self.p1[0] - self.p0[0]), abs(self.p1[1] - self.p0[1]))

    @property
    def dust(self) -> float:
        """How much of it is too short to be told from rounding."""
        return DUST / self.long

    def box(self) -> tuple[float, float, float, float]:
        """Left, top, right, bottom."""
        (ax, ay, _), (bx, by, _) = self.p0, self.p1
        return min(ax, bx), min(ay, by), max(ax, bx), max(ay, by)

    def segment(self, span: Span) -> Segment:
        """A part of it, in pixels."""
        (ax, ay, _), (bx, by, _) = self.p0, self.p1
        (x0, y0), (x1, y1) = (((ax + t * (bx - ax)) / UNITS, (ay + t * (by - ay)) / UNITS) for t in span)
        return (x0, y0), (x1, y1)


def line_of(asked: Question, number: int, faces: list[int]) -> Line:
    """The edge of this number; faces: the two that meet at it, -1 is none."""
    ax, ay, az, bx, by, bz = asked.ends[number].tolist()
    begin, stop = asked.passages.inside[number].tolist()
    inside = max(begin, 0.0), min(stop, 1.0)
    return Line(number, [face for face in faces if face >= 0], (ax, ay, az), (bx, by, bz), inside)


def steps_of(line: Line, asked: Question, work: dict[str, int]) -> Iterator[Step]:
    """An edge before every body near it; the last step settles it. Adds to the counters."""
    work["edges"] += 1
    fate, hidden = int(asked.fate[line.number]), list[Span]()
    told = ""
    if fate != TESTED:
        counter, told = FATES[fate]
        work[counter] += 1
        hidden = [line.inside]
    elif line.inside[0] < line.inside[1]:
        for body in bodies_met(line, asked, hidden):
            work["edges against bodies"] += 1
            span, sentence = span_behind(line, asked, body)
            hidden[:] = with_span(hidden, span, line.dust)
            yield Step("body", sentence, shown_behind(line, int(asked.bodies.face[body]), span), dict(work))
    yield settled(line, hidden, told, work)


def shown_behind(line: Line, face: int, span: Span) -> dict[str, object]:
    """What a body's step shows: the body, the edge, and what of it the body hides."""
    hides = span[0] < span[1]
    return {
        "faces": line.faces,
        "face": face,
        "segments": [line.segment(line.inside)],
        "hidden": [line.segment(span)] if hides else [],
        "verdict": "kept" if not hides else "dropped" if span == line.inside else "split",
    }


def settled(line: Line, hidden: list[Span], told: str, work: dict[str, int]) -> Step:
    """The step that ends an edge: its pieces."""
    pieces = turns(line, hidden) if line.inside[0] < line.inside[1] else []
    seen = [line.segment(span) for span, shown in pieces if shown]
    behind = [line.segment(span) for span, shown in pieces if not shown]
    work["pieces seen"] += len(seen)
    work["pieces hidden"] += len(behind)
    if not pieces:
        told = "lies beside the picture"
    elif not told:
        parts = " and ".join(f"{begin:.2f} < t < {stop:.2f}" for (begin, stop), shown in pieces if shown)
        told = "is hidden" if not seen else f"is seen for {parts}" if behind else "is seen whole"
    data = {
        "faces": line.faces,
        "segments": seen,
        "hidden": behind,
        "verdict": "dropped" if not seen else "split" if behind else "kept",
        "settled": True,
    }
    where = " and ".join(map(str, line.faces))
    return Step("edge", f"edge {line.number}, of face {where}, {told}", data, dict(work))


def bodies_met(line: Line, asked: Question, hidden: list[Span]) -> Iterator[int]:
    """The bodies in the cells the edge passes, until what is hidden already covers its part of the cell."""
    bodies, passages = asked.bodies, asked.passages
    left, up, right, down = line.box()
    begin, stop = line.inside
    met = set[int]()
    for passage in range(passages.start[line.number], passages.start[line.number + 1]):
        cell = passages.cell[passage]
        c0, c1 = max(passages.span[passage, 0], begin), min(passages.span[passage, 1], stop)
        for key in asked.listed[asked.start[cell] : asked.start[cell + 1]].tolist():
            begins, body = divmod(key, 1 << 32)
            covered = any(t0 <= c0 and t1 >= c1 for t0, t1 in hidden)
            if covered or begins > bodies.steps(min(line.p0[2], line.p1[2])):
                break
            x0, y0, x1, y1 = bodies.box[body].tolist()
            beside = x0 > right or x1 < left or y0 > down or y1 < up
            if not beside and body not in met and bodies.owner[body] not in asked.own[line.number]:
                met.add(body)
                yield body


def span_behind(line: Line, asked: Question, body: int) -> tuple[Span, str]:
    """Where the edge is behind a body, and in words which inequalities say so."""
    bodies, span = asked.bodies, line.inside
    sides = sides_of(line, asked, body)
    name = f"edge {line.number} and the body of face {bodies.face[body]}"
    for number, (at_0, at_1) in enumerate(sides, 1):
        span = solved(at_0, at_1, span)
        if not span[0] < span[1]:
            return span, f"{name}: side {number} of {len(sides)} leaves no t inside"
    told = f"{name}: the {len(sides)} sides leave {span[0]:.2f} < t < {span[1]:.2f}"
    depths = [line.p0[2] + t * (line.p1[2] - line.p0[2]) for t in span]
    if max(depths) < bodies.farthest[body]:
        return span, f"{told}, all of it deeper than the body: hidden"
    ends = ends_on(line, asked, body)
    short = any(ends) and (span[1] - span[0]) * line.long <= SPECK
    for at_0, at_1 in caps_of(line, asked, body, doubted=not short):
        span = under(at_0, at_1, ends, span)
        if not span[0] < span[1]:
            return span, f"{told}, but there alpha > 0 has no solution: it is not behind"
    return span, f"{told}, and alpha > 0 leaves {span[0]:.2f} < t < {span[1]:.2f}: hidden"


def sides_of(line: Line, asked: Question, body: int) -> list[tuple[float, float]]:
    """How far inside each side of a body the edge is, times the side's length, at t = 0 and at t = 1."""
    bodies, found = asked.bodies, []
    (ax, ay, _), (bx, by, _) = line.p0, line.p1
    for side in range(bodies.side_start[body], bodies.side_start[body + 1]):
        px, py, qx, qy = bodies.side[side].tolist()
        dx, dy = qx - px, qy - py
        found.append((dx * (ay - py) - dy * (ax - px), dx * (by - py) - dy * (bx - px)))
    return found


def ends_on(line: Line, asked: Question, body: int) -> tuple[bool, bool]:
    """Whether the first and the last point of the edge are corners of a body."""
    bodies = asked.bodies
    rows = range(bodies.side_start[body], bodies.side_start[body + 1])
    corners = [(*bodies.side[side, :2].tolist(), bodies.corner[side]) for side in rows]
    return line.p0 in corners, line.p1 in corners


def caps_of(line: Line, asked: Question, body: int, doubted: bool) -> list[tuple[float, float]]:
    """The greatest alpha under each cap of a body, at t = 0 and at t = 1; doubted: what is sure of it."""
    bodies, found = asked.bodies, []
    (ax, ay, az), (bx, by, bz) = line.p0, line.p1
    for cap in range(bodies.cap_start[body], bodies.cap_start[body + 1]):
        x, y, z, p, q, doubt = bodies.cap[cap].tolist()
        z += 0.0 if doubted else doubt
        found.append((z + p * (ax - x) + q * (ay - y) - az, z + p * (bx - x) + q * (by - y) - bz))
    return found


def solved(at_0: float, at_1: float, span: Span) -> Span:
    """The part of a span where a number that is at_0 for t = 0 and at_1 for t = 1 is not below 0."""
    t0, t1 = span
    if at_0 < 0:
        return (max(t0, at_0 / (at_0 - at_1)), t1) if at_1 > 0 else (1.0, 0.0)
    return (t0, min(t1, at_0 / (at_0 - at_1))) if at_1 < 0 else span


def under(at_0: float, at_1: float, ends: tuple[bool, bool], span: Span) -> Span:
    """The part of a span that is under a cap; an end that is a corner of the body is not above it."""
    if any(ends):
        if max(at_0 + t * (at_1 - at_0) for t in span) <= 0:
            return 1.0, 0.0
        at_0, at_1 = (max(at, 0.0) if end else at for at, end in zip((at_0, at_1), ends, strict=True))
    return solved(at_0, at_1, span)


def with_span(hidden: list[Span], span: Span, dust: float) -> list[Span]:
    """Spans, sorted and apart from each other, with one more; those closer than dust become one."""
    t0, t1 = span
    if not t0 < t1:
        return hidden
    apart = [one for one in hidden if one[1] + dust < t0 or one[0] > t1 + dust]
    close = [one for one in hidden if one not in apart]
    joined = min([t0, *(begin for begin, _ in close)]), max([t1, *(stop for _, stop in close)])
    return sorted([*apart, joined])


def turns(line: Line, hidden: list[Span]) -> list[tuple[Span, bool]]:
    """What is seen and what is hidden, by turns; dust goes to its neighbour."""
    begin, stop = line.inside
    place, found = begin, list[tuple[Span, bool]]()
    for t0, t1 in hidden:
        t0 = t0 if t0 - begin > line.dust else begin
        t1 = t1 if stop - t1 > line.dust else stop
        if t1 - t0 <= line.dust and (t0 > begin or t1 < stop):
            continue
        if t0 > place:
            found.append(((place, t0), True))
        found.append(((t0, t1), False))
        place = t1
    if place < stop:
        found.append(((place, stop), True))
    return found
