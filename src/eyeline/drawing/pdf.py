"""A sheet as PDF: one page, a pixel is 3/4 of a point as on the web."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import TYPE_CHECKING

from eyeline.drawing.pens import Pen
from eyeline.drawing.sheet import PARTS, Sheet

if TYPE_CHECKING:
    from fpdf.drawing import PaintedPath

POINTS = 0.75  # 1/72 inch in a pixel, 1/96 inch
NO_DATE = datetime(1970, 1, 1, tzinfo=UTC)  # so that the same sheet is the same bytes


def pdf_of(sheet: Sheet) -> bytes:
    """The file; lines are in the order of the SVG. PDF has no groups: each pen's lines are one object."""
    import fpdf
    from fpdf.drawing import PaintedPath

    width, height = sheet.size
    page = fpdf.FPDF(unit="pt", format=(width * POINTS, height * POINTS))
    page.set_creation_date(NO_DATE)
    page.set_title(sheet.title)
    page.set_margin(0)
    page.set_auto_page_break(False)
    page.add_page()
    with page.drawing_context() as context:
        for group in sheet.groups:
            drawn = PaintedPath()
            put_pen(drawn, group.pen)
            for path in group.paths:
                first, *rest = (path * (POINTS / PARTS)).tolist()
                drawn.move_to(*first)
                closed = len(rest) > 1 and rest[-1] == first
                for place in rest[:-1] if closed else rest:
                    drawn.line_to(*place)
                if closed:
                    drawn.close()
            context.add_item(drawn)
    return bytes(page.output())


def put_pen(drawn: PaintedPath, pen: Pen) -> None:
    """Draw a path with a pen."""
    from fpdf.drawing import color_from_hex_string

    style = drawn.style
    style.auto_close, style.fill_color = False, None
    style.stroke_color = color_from_hex_string(pen.colour)
    style.stroke_width = pen.width * POINTS
    style.stroke_cap_style, style.stroke_join_style = "round", "round"
    if pen.dash:
        style.stroke_dash_pattern = tuple(length * POINTS for length in pen.dash)
