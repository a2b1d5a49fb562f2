"""A sheet as DXF (AutoCAD 2010): metres, y up, a layer for each kind of line.

An orthographic drawing is true to scale. A perspective one is as large as on paper, 96 pixels to the inch.
"""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from eyeline.drawing.pens import Pen
from eyeline.drawing.sheet import PARTS, Sheet

if TYPE_CHECKING:
    from ezdxf.document import Drawing

PAPER = 0.0254 / 96  # metres in a pixel on paper
MILLIMETRES = 25.4 / 96  # in a pixel on paper: pens are meant for it, whatever the scale
METRE = 6  # the format's number for the unit
# The format's widths of a pen, hundredths of a millimetre
WIDTHS = (
    0, 5, 9, 13, 15, 18, 20, 25, 30, 35, 40, 50, 53, 60, 70, 80, 90, 100, 106, 120, 140, 158, 200, 211,
)  # fmt: skip


def dxf_of(sheet: Sheet) -> bytes:
    """The file; hidden kinds have layers of their own, dashed."""
    with without_date():
        document, text = document_of(sheet), io.StringIO()
        document.write(text)
        return document.encode(text.getvalue())


def document_of(sheet: Sheet) -> Drawing:
    """The drawing as its library holds it."""
    import ezdxf

    metres, height = sheet.metres or PAPER, sheet.size[1]
    document = ezdxf.new("R2010")
    document.header["$INSUNITS"] = METRE
    document.header["$MEASUREMENT"] = 1  # metric
    space = document.modelspace()
    for group in sheet.groups:
        layer = group.kind if group.seen else f"hidden {group.kind}"
        if layer not in document.layers:
            add_layer(document, layer, group.pen, metres)
        for path in group.paths:
            places = [(x / PARTS * metres, (height - y / PARTS) * metres) for x, y in path.tolist()]
            closed = len(places) > 2 and places[0] == places[-1]
            corners = places[:-1] if closed else places
            space.add_lwpolyline(corners, close=closed, dxfattribs={"layer": layer})
    return document


def add_layer(document: Drawing, name: str, pen: Pen, metres: float) -> None:
    """A layer whose lines are drawn with a pen."""
    linetype = "CONTINUOUS"
    if pen.dash:
        linetype = name.upper().replace(" ", "_")
        on, off = (length * metres for length in pen.dash)
        document.linetypes.add(linetype, pattern=[on + off, on, -off], description=name)
    wanted = pen.width * MILLIMETRES * 100
    layer = document.layers.add(
        name, linetype=linetype, lineweight=min(WIDTHS, key=lambda width: abs(width - wanted))
    )
    layer.rgb = (int(pen.colour[1:3], 16), int(pen.colour[3:5], 16), int(pen.colour[5:], 16))


@contextmanager
def without_date() -> Iterator[None]:
    """Documents made and written within bear no time and no random numbers."""
    import ezdxf

    kept = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = kept
