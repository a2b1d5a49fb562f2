"""SVG drawings: what is read of them, what they look like, and what is refused."""

from __future__ import annotations

from contextlib import suppress

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from eyeline.errors import FileError, GeometryError
from eyeline.files.svg.cels import cel_of
from eyeline.files.svg.drawer import png_of
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


DAMAGE = (
    b"1e999", b"-1e30", b"nan", b"0", b'"', b"<", b">", b"M", b"A", b"Z", b"c", b"%", b"99999999999", b"\xff",
    b"url(#r)", b"matrix(0 0 0 0 0 0)", b"scale(1e20)", b" ", b"px", b"-", b"",
)  # fmt: skip

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


HUGE = {
    "curve": '<path d="M10 40C10 10 60 99999999999 60 40A20 20 0 0 1 7-1e30z" fill="teal"/>',
    "stroke": '<polyline points="5,5 20,40" stroke="navy" stroke-width="399999999999"/>',
    "infinite": '<path d="M1e999 5h10v10z"/>',
}


@pytest.mark.parametrize("name", HUGE)
def test_numbers_that_break_the_renderer_do_not_break_us(name: str) -> None:
    """It may draw them or be refused; resvg is known to abort its process at some of them."""
    text = checked(drawing(HUGE[name]))
    with suppress(FileError):
        assert picture_of(text, (64, 32)).shape == (32, 64, 4)
    with suppress(FileError, GeometryError):
        cel = cel_of(text)
        cel.inbetween(cel).at(0.5)


def test_an_aborted_renderer_is_a_refusal() -> None:
    with pytest.raises(FileError, match="cannot be drawn"):
        png_of("<svg")


@settings(derandomize=True, deadline=None, max_examples=300)
@given(st.integers(0, 2**32 - 1), st.sampled_from(sorted(SHAPES)))
def test_a_damaged_drawing_is_read_or_refused(seed: int, name: str) -> None:
    random, data = np.random.default_rng(seed), bytearray(drawing(SHAPES[name]))
    for _ in range(random.integers(1, 6)):
        place = int(random.integers(len(data)))
        data[place : place + int(random.integers(0, 5))] = DAMAGE[random.integers(len(DAMAGE))]
    with suppress(FileError, GeometryError):
        text = checked(bytes(data))
        with suppress(FileError):
            size_of(text)
        cel = cel_of(text)
        text_of(cel.inbetween(cel).at(0.5))


PAINTED_BY_ITSELF = (
    '<pattern id="p" width="1" height="1"><rect width="1" height="1" fill="url(#p)"/></pattern>'
    '<rect width="9" height="9" fill="url(#p)"/>'
)


def test_paint_counts_as_drawing() -> None:
    """Patterns of patterns would be drawn a billion times, or for ever."""
    layers = "".join(
        f'<pattern id="p{k}">' + f'<rect fill="url(#p{k + 1})"/>' * 10 + "</pattern>" for k in range(8)
    )
    with pytest.raises(FileError, match="draws more than 100,000 elements"):
        checked(drawing(f'{layers}<pattern id="p8"><rect/></pattern>'))
    with pytest.raises(FileError, match="<rect> draws itself"):
        checked(drawing(PAINTED_BY_ITSELF))
    style = "<style>rect{fill:url(#p)}</style>"
    with pytest.raises(FileError, match="<style> paints with 'p'; it may with gradients only"):
        checked(drawing(f'{style}<pattern id="p"><rect/></pattern>'))
    assert checked(drawing(f'{style}<linearGradient id="p"/>'))


def test_what_cannot_be_in_betweened_is_refused() -> None:
    with pytest.raises(
        FileError, match=r"shape 'a' has a fill of 'url\(#g\)'; in-betweens need plain colours"
    ):
        cel_of(checked(drawing('<rect id="a" width="5" height="5" fill="url(#g)"/>')))
    with pytest.raises(FileError, match="draws no shapes"):
        cel_of(checked(drawing("")))
    with pytest.raises(FileError, match="neither width and height in pixels nor a viewBox"):
        size_of(checked(drawing("", attributes="")))
