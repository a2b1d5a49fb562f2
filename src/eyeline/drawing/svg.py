"""A sheet as SVG 1.1: a group for each node, in it one for each kind of line."""

from __future__ import annotations

import re
from xml.sax.saxutils import escape, quoteattr

from eyeline.drawing.pens import Pen
from eyeline.drawing.sheet import PARTS, Group, Sheet
from eyeline.geometry.arrays import IntArray

# What XML 1.0 cannot hold, escaped or not
UNWRITABLE = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def svg_of(sheet: Sheet) -> bytes:
    """The file, UTF-8. The width and height are pixels; nothing but paths is drawn."""
    width, height = sheet.size
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        f'viewBox="0 0 {width} {height}" style="background:#fff" fill="none" '
        'stroke-linecap="round" stroke-linejoin="round">',
    ]
    if sheet.title:
        lines.append(f"<title>{text(sheet.title)}</title>")
    taken: set[str] = set()
    for name, groups in sheet.nodes:
        lines.append(f"<g id={quoteattr(identifier(name, taken))}>")
        lines.append(f"<title>{text(name)}</title>")
        for group in groups:
            lines += group_lines(group)
        lines.append("</g>")
    lines.append("</svg>\n")
    return "\n".join(lines).encode()


def group_lines(group: Group) -> list[str]:
    """One group of paths."""
    kind = group.kind if group.seen else f"hidden {group.kind}"
    lines = [f'<g class="{kind}" {pen_of(group.pen)}>']
    lines += [f'<path d="{outline(path)}"/>' for path in group.paths]
    return [*lines, "</g>"]


def pen_of(pen: Pen) -> str:
    """A pen as attributes."""
    dash = f' stroke-dasharray="{" ".join(map(short, pen.dash))}"' if pen.dash else ""
    return f'stroke="{pen.colour}" stroke-width="{short(pen.width)}"{dash}'


def outline(path: IntArray) -> str:
    """The `d` of a path (K, 2) in hundredths of a pixel; one that ends where it begins is closed."""
    closed = len(path) > 2 and bool((path[0] == path[-1]).all())
    corners = path[:-1] if closed else path
    places = [f"{short(x / PARTS)},{short(y / PARTS)}" for x, y in corners.tolist()]
    return f"M{' '.join(places)}{'Z' if closed else ''}"


def short(number: float) -> str:
    """A number to the hundredth, without zeros that say nothing."""
    return f"{number:.2f}".rstrip("0").rstrip(".")


def text(words: str) -> str:
    """Words as they stand between tags."""
    return escape(UNWRITABLE.sub("\ufffd", words))


def identifier(name: str, taken: set[str]) -> str:
    """A node's path as an id: without spaces, and like no other."""
    plain = re.sub(r"\s", "_", UNWRITABLE.sub("\ufffd", name)) or "_"
    unique, count = plain, 1
    while unique in taken:
        unique, count = f"{plain}.{count}", count + 1
    taken.add(unique)
    return unique
