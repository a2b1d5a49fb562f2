"""An SVG drawing as a cel: its shapes as painted outlines, in pixels, curves as short straight pieces."""

from __future__ import annotations

import io
import math
from itertools import pairwise
from typing import Any

import numpy as np

from eyeline.errors import FileError
from eyeline.files.extra import extra
from eyeline.geometry.arrays import FloatArray
from eyeline.shapes.cel import Cel, Paint, Patch
from eyeline.shapes.outline import Outline

FINEST, MOST_PIECES = 8, 64  # pieces of a curve: at least and at most
PIECE = 2.0  # pixels: about the length of one
FARTHEST = 1e6  # pixels
HIDDEN = ("hidden", "collapse")


def cel_of(text: str) -> Cel:
    """The patches of a checked drawing. Refused: no shapes, and paint that is no plain colour."""
    with extra("SVG drawings"):
        import svgelements as reader
    try:
        drawing = reader.SVG.parse(io.StringIO(text), reify=False)
        shapes = [one for one in drawing.elements() if isinstance(one, reader.Shape)]
        patches = tuple(found for one in shapes if (found := patch_of(reader, one)) is not None)
        size = float(drawing.width), float(drawing.height)
    except (
        ValueError,
        TypeError,
        ArithmeticError,
        RecursionError,
        IndexError,
        KeyError,
        AttributeError,
    ) as error:
        raise FileError(f"holds a shape that cannot be read ({error}); save it again") from error
    if not patches:
        raise FileError("draws no shapes; a drawing to be in-betweened needs some")
    return Cel(patches, size)


def patch_of(reader: Any, shape: Any) -> Patch | None:
    """A shape as a patch; None where nothing of it is seen."""
    values = shape.values
    for kind in ("fill", "stroke"):
        if str(values.get(kind, "")).strip().startswith("url("):
            raise FileError(
                f"shape {shape.id or type(shape).__name__!r} has a {kind} of {values[kind]!r};"
                " in-betweens need plain colours"
            )
    opacity = number(values.get("opacity"), 1.0)
    fill, stroke = paint(shape.fill, opacity), paint(shape.stroke, opacity)
    if isinstance(shape, reader.SimpleLine):
        fill = None
    if (fill is None and stroke is None) or values.get("visibility") in HIDDEN:
        return None
    outlines = tuple(outlines_of(reader, abs(reader.Path(shape))))
    if not outlines:
        return None
    width = float(shape.implicit_stroke_width or 1.0)
    even_odd = values.get("fill-rule") == "evenodd"
    return Patch(outlines, fill, stroke, width, even_odd, shape.id or "")


def outlines_of(reader: Any, path: Any) -> list[Outline]:
    """The subpaths of a path."""
    found: list[Outline] = []
    points: list[tuple[float, float]] = []
    for segment in path:
        if isinstance(segment, reader.Move):
            found += outline(points, closed=False)
            points = [place(segment.end)]
        elif isinstance(segment, reader.Close):
            found += outline(points, closed=True)
            points = [place(segment.end)] if segment.end is not None else points[:1]
        elif isinstance(segment, reader.Line):
            points.append(place(segment.end))
        else:
            points.extend(curve(segment))
    return found + outline(points, closed=False)


def outline(points: list[tuple[float, float]], closed: bool) -> list[Outline]:
    """One outline, or none of fewer than two points."""
    if any(not -FARTHEST <= value <= FARTHEST for point in points for value in point):
        raise FileError(
            f"holds an outline that leaves the sheet by more than {FARTHEST:,.0f} pixels; mend it"
        )
    return [Outline(np.array(points), closed)] if len(points) > 1 else []


def curve(segment: Any) -> list[tuple[float, float]]:
    """Points along a curve, but its first."""
    rough = sum(math.dist(place(a), place(b)) for a, b in hull(segment))
    pieces = max(FINEST, min(MOST_PIECES, math.ceil(rough / PIECE)))
    inner: FloatArray = np.asarray(segment.npoint(np.linspace(0, 1, pieces + 1)[1:-1]), np.float64)
    return [(float(x), float(y)) for x, y in inner] + [place(segment.end)]


def hull(segment: Any) -> list[tuple[Any, Any]]:
    """The sides of what a curve is drawn by: pairs of points."""
    control = [getattr(segment, name, None) for name in ("start", "control", "control1", "control2", "end")]
    points = [one for one in control if one is not None]
    if len(points) == 2:  # an arc
        points.insert(1, segment.point(0.5))
    return list(pairwise(points))


def place(point: Any) -> tuple[float, float]:
    """A point as two numbers."""
    return float(point.x), float(point.y)


def paint(colour: Any, opacity: float) -> Paint | None:
    """A colour of SVG as numbers 0..1; None where nothing is painted."""
    if colour is None or colour.value is None:
        return None
    return colour.red / 255, colour.green / 255, colour.blue / 255, float(colour.opacity) * opacity


def number(text: object, otherwise: float) -> float:
    """A number or a percentage, within 0 to 1."""
    if text is None:
        return otherwise
    words = str(text).strip()
    value = float(words[:-1]) / 100 if words.endswith("%") else float(words)
    return min(1.0, max(0.0, value))
