"""Explanations as one drawing: frames side by side, each with its sentence; every line stays a line."""

from __future__ import annotations

import html
import textwrap
from collections.abc import Iterator

from eyeline.explanation.explanation import Explanation
from eyeline.explanation.frames import Frame, Mark, Points
from eyeline.explanation.roles import (
    DOT,
    FAINT,
    INK,
    INK_WIDTH,
    NETWORK,
    PAPER,
    ROLES,
    STAGE,
    canvas,
    legend,
    network,
    paint,
    runs,
    title_of,
)
from eyeline.geometry.arrays import ByteArray, IntArray

COLUMNS, WIDTH, GAP, TEXT, HEAD = 3, 420, 24, 84, 56  # of the drawing, in its units
LINE = 58  # characters


def sheet(explanation: Explanation, most: int) -> str:
    """An SVG document of at most `most` frames."""
    projected = explanation.projected
    scale = WIDTH / projected.width
    height = projected.height * scale + TEXT
    frames = list(explanation.frames(most))
    columns = max(1, min(COLUMNS, len(frames)))
    rows = -(-len(frames) // COLUMNS)
    size = columns * (WIDTH + GAP) + GAP, HEAD + rows * (height + GAP) + GAP
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
        f' viewBox="0 0 {size[0]:g} {size[1]:g}" width="{size[0]:g}" height="{size[1]:g}"'
        ' font-family="system-ui, sans-serif">',
        f'<rect width="100%" height="100%" fill="{PAPER}"/>',
        f'<text x="{GAP}" y="36" font-size="22" fill="{INK}">{html.escape(title_of(explanation))}</text>',
        *key(frames, size[0] - GAP),
        f'<defs><g id="network" fill="none" stroke="{NETWORK}" stroke-width="0.06">',
        *(f'<polygon points="{places(corners)}"/>' for corners in network(explanation)),
        "</g></defs>",
    ]
    seen, ink = canvas(explanation), list[Mark]()
    for number, frame in enumerate(frames):
        paint(seen, frame)
        ink += frame.ink
        left, top = GAP + number % COLUMNS * (WIDTH + GAP), HEAD + number // COLUMNS * (height + GAP)
        parts += [
            f'<g transform="translate({left:g} {top:g})">',
            *panel(explanation, frame, seen, ink, scale),
            "</g>",
        ]
    return "\n".join([*parts, "</svg>", ""])


def key(frames: list[Frame], right: float) -> Iterator[str]:
    """What the colours mean, in a line that ends at `right`."""
    spans = (f'<tspan fill="{look.colour}">■</tspan> {look.meaning}' for look in legend(frames).values())
    inside = " \u2003".join(spans)
    yield f'<text x="{right:g}" y="36" font-size="13" text-anchor="end" fill="{INK}">{inside}</text>'


def panel(
    explanation: Explanation, frame: Frame, seen: IntArray, ink: list[Mark], scale: float
) -> Iterator[str]:
    """One frame: the picture so far, the marks, the sentence."""
    projected = explanation.projected
    yield f'<g transform="scale({scale:.6g})">'
    yield f'<rect width="{projected.width}" height="{projected.height}" fill="{STAGE}"/>'
    yield '<use xlink:href="#network"/>'
    yield from blocks(seen, explanation.colours)
    yield from (drawn(mark, INK_WIDTH) for mark in ink)
    yield from (drawn(mark, 1.0) for mark in frame.marks)
    yield "</g>"
    top = projected.height * scale + 22
    for row, line in enumerate(textwrap.wrap(frame.sentence, LINE)[:3]):
        yield f'<text y="{top + 19 * row:g}" font-size="14" fill="{INK}">{html.escape(line)}</text>'
    told = f"step {frame.number:,} of {len(explanation):,}"
    yield f'<text y="{top + 56:g}" font-size="12" fill="{FAINT}">{told}</text>'


def blocks(seen: IntArray, colours: ByteArray) -> Iterator[str]:
    """The picture so far, a path for each face: a rectangle for each run of pixels along a row."""
    rectangles: dict[int, list[str]] = {}
    for y, begin, end, face in runs(seen):
        rectangles.setdefault(face, []).append(f"M{begin} {y}h{end - begin}v1h{begin - end}z")
    for face, pieces in rectangles.items():
        yield f'<path fill="#{bytes(colours[face]).hex()}" d="{"".join(pieces)}"/>'


def drawn(mark: Mark, weight: float) -> str:
    """A mark as an element."""
    look = ROLES[mark.role]
    if mark.shape == "dots":
        dots = "".join(f"M{x:g} {y:g}h0" for x, y in mark.points)
        return f'<path d="{dots}" stroke="{look.colour}" stroke-width="{2 * DOT:g}" stroke-linecap="round"/>'
    style = f'stroke="{look.colour}" stroke-width="{look.width * weight:g}" stroke-linejoin="round"'
    if look.dashed:
        style += ' stroke-dasharray="0.8"'
    if mark.shape == "polygon":
        fill = f'fill="{look.colour}" fill-opacity="{look.fill * weight:g}"'
        return f'<polygon points="{places(mark.points)}" {fill} {style}/>'
    return f'<polyline points="{places(mark.points)}" fill="none" {style}/>'


def places(points: Points) -> str:
    """Pairs as SVG writes them."""
    return " ".join(f"{x:g},{y:g}" for x, y in points)
