"""SVG drawings as pixels, by resvg: the same on every machine, for no fonts and no files are looked at."""

from __future__ import annotations

import math
import re

from lxml import etree

from eyeline.errors import FileError
from eyeline.files.limits import Allowance
from eyeline.files.pictures import decoded
from eyeline.files.svg.drawer import png_of
from eyeline.geometry.arrays import ByteArray
from eyeline.shapes.cel import Cel, Paint, Patch
from eyeline.shapes.outline import Outline

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
UNITS = {"px": 1.0, "in": 96.0, "cm": 96 / 2.54, "mm": 96 / 25.4, "pt": 96 / 72, "pc": 16.0}


def picture_of(text: str, size: tuple[int, int]) -> ByteArray:
    """(H, W, 4) uint8 sRGB of a checked drawing, as large as fits into (width, height), in the middle."""
    data = png_of(fitted(text, size))
    return decoded(data, "the drawing", ("PNG",), Allowance("pixels", size[0] * size[1], 0))


def fitted(text: str, size: tuple[int, int]) -> str:
    """The drawing with all that it shows as large as fits into size, in its middle."""
    root = etree.fromstring(text)
    wide, high = (length(root.get(side)) for side in ("width", "height"))
    if root.get("viewBox") is None:
        if wide is None or high is None:
            raise FileError("tells neither width and height in pixels nor a viewBox; give it one")
        root.set("viewBox", f"0 0 {wide:g} {high:g}")
    root.set("width", str(size[0]))
    root.set("height", str(size[1]))
    root.attrib.pop("preserveAspectRatio", None)
    return str(etree.tostring(root, encoding="unicode"))


def size_of(text: str) -> tuple[int, int]:
    """(width, height) of a checked drawing, whole pixels."""
    root = etree.fromstring(text)
    sides = [length(root.get(side)) for side in ("width", "height")]
    if None in sides:
        box = [float(one) for one in re.findall(NUMBER, root.get("viewBox") or "")]
        if len(box) != 4 or not all(0 < side < math.inf for side in box[2:]):
            raise FileError("tells neither width and height in pixels nor a viewBox; give it one")
        sides = [box[2], box[3]]
    width, height = (max(1, round(side or 0)) for side in sides)
    return width, height


def length(words: str | None) -> float | None:
    """A length in pixels; None where there is none, or it depends on something else."""
    found = re.fullmatch(rf"\s*({NUMBER})(px|in|cm|mm|pt|pc)?\s*", words or "")
    pixels = float(found[1]) * UNITS[found[2] or "px"] if found else 0.0
    return pixels if 0 < pixels < math.inf else None


def text_of(cel: Cel) -> str:
    """A cel as SVG."""
    width, height = cel.size
    patches = "".join(patch_text(patch) for patch in cel.patches)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.6g}" height="{height:.6g}"'
        f' viewBox="0 0 {width:.6g} {height:.6g}" stroke-linecap="round" stroke-linejoin="round">'
        f"{patches}</svg>"
    )


def patch_text(patch: Patch) -> str:
    """A patch as one path."""
    d = "".join(outline_text(one) for one in patch.outlines)
    rule = ' fill-rule="evenodd"' if patch.even_odd else ""
    return (
        f'<path d="{d}"{rule} {paint_text("fill", patch.fill)} {paint_text("stroke", patch.stroke)}'
        f' stroke-width="{patch.width:.6g}"/>'
    )


def outline_text(outline: Outline) -> str:
    """An outline as the `d` of a path, to the thousandth."""
    return (
        f"M{' '.join(f'{x:.3f},{y:.3f}' for x, y in outline.points.tolist())}{'Z' if outline.closed else ''}"
    )


def paint_text(kind: str, paint: Paint | None) -> str:
    """A fill or a stroke as attributes."""
    if paint is None:
        return f'{kind}="none"'
    red, green, blue = (round(255 * channel) for channel in paint[:3])
    return f'{kind}="#{red:02x}{green:02x}{blue:02x}" {kind}-opacity="{paint[3]:.4g}"'
