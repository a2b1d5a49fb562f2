"""SVG drawings: what is read of them, what they look like, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest

from eyeline.errors import FileError
from eyeline.files.svg.cels import cel_of
from eyeline.files.svg.picture import picture_of, size_of, text_of
from eyeline.files.svg.safety import ELEMENTS, checked

NAMESPACES = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
BOMB = (
    "".join(f'<g id="g{k}"><use href="#g{k + 1}"/><use href="#g{k + 1}"/></g>' for k in range(20))
    + '<rect id="g20" width="1" height="1"/>'
)


def drawing(body: str, head: str = "", attributes: str = 'width="100" height="50"') -> bytes:
    return f"{head}<svg {NAMESPACES} {attributes}>{body}</svg>".encode()


REFUSED = {
    "script": (drawing("<script>alert(1)</script>"), "line 1: holds <script>; what can run"),
    "handler": (drawing('<rect onclick="x()" width="1" height="1"/>'), "onclick would run something"),
    "foreign": (drawing("<foreignObject/>"), "holds <foreignObject>"),
    "moving": (drawing("<rect><animate/></rect>"), "it moves by itself"),
    "words": (drawing("<text>hello</text>"), "turn text into paths"),
    "image outside": (drawing('<image href="http://a.b/c.png"/>'), "nothing outside the drawing is read"),
    "image beside": (drawing('<image xlink:href="../secret.png"/>'), "nothing outside the drawing is read"),
    "file": (drawing('<image href="file:///etc/passwd"/>'), "nothing outside the drawing is read"),
    "svg in data": (drawing('<image href="data:image/svg+xml;base64,AA"/>'), "nothing outside the drawing"),
    "use outside": (drawing('<use href="other.svg#a"/>'), "nothing outside the drawing is read"),
    "paint outside": (drawing('<rect fill="url(http://a.b/c)"/>'), "fill refers to"),
    "style outside": (drawing("<rect style=\"fill:url( 'x.svg#a')\"/>"), "style refers to"),
    "import": (drawing("<style>@import 'a.css';</style>"), "<style> refers to what is outside"),
    "entity": (drawing("&a;", '<!DOCTYPE svg [<!ENTITY a "b">]>'), "entities of its own"),
    "outer entity": (
        drawing("&a;", '<!DOCTYPE svg [<!ENTITY a SYSTEM "/etc/passwd">]>'),
        "entities of its own",
    ),
    "instruction": (drawing('<?php x?><rect width="1" height="1"/>'), r"an instruction <\?php\?>"),
    "many": (drawing(BOMB.replace("<rect", "<g/>" * 3 + "<rect")), f"draws more than {ELEMENTS:,} elements"),
    "circle": (drawing('<g id="a"><use href="#a"/></g>'), "draws itself"),
    "no xml": (b"<svg", "is no XML that can be read"),
    "empty": (b"", "is no XML that can be read"),
    "not svg": (b"<html/>", "begins with <html>"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_runs_or_reaches_outside_is_refused(name: str) -> None:
    data, sentence = REFUSED[name]
    with pytest.raises(FileError, match=sentence):
        checked(data)


def test_a_document_type_is_left_aside() -> None:
    """Most programs write one; nobody follows it."""
    head = (
        '<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">'
    )
    assert checked(drawing("<rect/>", head)).startswith("<svg")


SHAPES = {
    "rect": '<rect x="10" y="10" width="40" height="20" fill="#ff0000"/>',
    "turned and moved": '<g transform="translate(20 5) rotate(10)"><circle cx="20" cy="20" r="12"/></g>',
    "path with a hole": '<path fill-rule="evenodd" d="M10 10h40v30h-40zM20 20h10v10h-10z"/>',
    "curves": '<path d="M10 40C10 10 60 0 60 40S80 45 90 10A20 20 0 0 1 70 5Q40 0 10 40z" fill="teal"/>',
    "lines": '<polyline points="5,5 20,40 50,10" fill="none" stroke="navy" stroke-width="3"'
    ' stroke-linecap="round" stroke-linejoin="round"/>',
    "used again": '<defs><rect id="r" width="20" height="10"/></defs><use href="#r" x="30" y="5"/>',
    "styled": '<style>.a{fill:#884422}</style><ellipse class="a" cx="50" cy="25" rx="40" ry="15"/>',
}


@pytest.mark.parametrize("name", SHAPES)
def test_a_cel_looks_like_its_drawing(name: str) -> None:
    """Read as outlines and written again it is the same picture, but for a pixel's part along curves."""
    text = checked(drawing(SHAPES[name], attributes='width="200" height="100" viewBox="0 0 100 50"'))
    cel = cel_of(text)
    assert cel.size == (200, 100)
    one, other = picture_of(text, (400, 200)), picture_of(text_of(cel), (400, 200))
    assert one[..., 3].max() == 255
    difference = np.abs(one.astype(int) - other)
    assert difference.mean() < 0.2
    assert (difference.max(axis=2) > 64).mean() < 0.001


def test_a_drawing_fits_into_the_middle() -> None:
    text = checked(drawing('<rect width="100" height="50"/>'))
    opaque = picture_of(text, (60, 60))[..., 3] == 255
    rows, columns = np.nonzero(opaque)
    assert (rows.min(), rows.max(), columns.min(), columns.max()) == (15, 44, 0, 59)


@pytest.mark.parametrize(
    ("attributes", "size"),
    [
        ('width="10" height="20"', (10, 20)),
        ('viewBox="0 0 30 40"', (30, 40)),
        ('width="1in" height="25.4mm"', (96, 96)),
    ],
)
def test_the_size_of_a_drawing_is_known(attributes: str, size: tuple[int, int]) -> None:
    assert size_of(checked(drawing("", attributes=attributes))) == size


def test_what_cannot_be_in_betweened_is_refused() -> None:
    with pytest.raises(
        FileError, match=r"shape 'a' has a fill of 'url\(#g\)'; in-betweens need plain colours"
    ):
        cel_of(checked(drawing('<rect id="a" width="5" height="5" fill="url(#g)"/>')))
    with pytest.raises(FileError, match="draws no shapes"):
        cel_of(checked(drawing("")))
    with pytest.raises(FileError, match="neither width and height in pixels nor a viewBox"):
        size_of(checked(drawing("", attributes="")))
