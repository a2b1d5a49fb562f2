"""What an SVG file may hold: shapes and paint. What runs, what moves, and what lies outside is refused."""

from __future__ import annotations

import re
from collections.abc import Iterator

from lxml import etree

from eyeline.errors import FileError

BYTES = 2**24  # of a drawing; 16 MiB
ELEMENTS = 100_000  # with all that is drawn again by <use>
XLINK = "{http://www.w3.org/1999/xlink}href"
SVG = "{http://www.w3.org/2000/svg}"

ACTIVE = {"script", "foreignObject", "iframe", "audio", "video", "a", "handler", "listener"}
MOVING = {"animate", "animateColor", "animateMotion", "animateTransform", "set"}
WORDS = {"text", "tspan", "textPath", "tref"}
REASONS = {
    **dict.fromkeys(ACTIVE, "what can run or link is not read; take it out"),
    **dict.fromkeys(MOVING, "it moves by itself; save it as a still drawing"),
    **dict.fromkeys(WORDS, "letters look different on every machine; turn text into paths"),
}
PAINTED = re.compile(r"url\(\s*['\"]?\s*#([^)'\"]+?)\s*['\"]?\s*\)", re.IGNORECASE)
INSIDE = re.compile(r"#|data:image/(png|jpeg);base64,", re.IGNORECASE)
OUTSIDE_PAINT = re.compile(
    r"@import|url\(\s*['\"]?\s*(?!['\"#\s])|\\|expression\s*\(|javascript:", re.IGNORECASE
)


def checked(data: bytes) -> str:
    """The drawing as plain text, without a document type, if it holds nothing but shapes and paint."""
    if len(data) > BYTES:
        raise FileError(f"has {len(data):,} bytes; a drawing has at most {BYTES:,}, so simplify it")
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False)
    try:
        root = etree.fromstring(data, parser)
    except (etree.XMLSyntaxError, ValueError) as error:
        raise FileError(
            f"is no XML that can be read ({' '.join(str(error).split())}); save it again"
        ) from error
    if root.tag not in (SVG + "svg", "svg"):
        raise FileError(f"begins with <{plain(root.tag)}>; an SVG drawing begins with <svg>")
    document = root.getroottree().docinfo.internalDTD
    if document is not None and (any(True for _ in document.iterentities())):
        raise FileError("defines entities of its own; they are not read, so save it as plain SVG")
    for element in whole(root):
        check(element)
    refuse_multitudes(root)
    return str(etree.tostring(root, encoding="unicode"))


def whole(root: etree._Element) -> Iterator[etree._Element]:
    """All elements; refused: references to entities, and instructions to programs."""
    for node in root.iter():
        if isinstance(node, etree._Entity):
            raise FileError(
                f"refers to the entity {node.text}; entities are not read, so save it as plain SVG"
            )
        if isinstance(node, etree._ProcessingInstruction):
            raise FileError(f"line {node.sourceline}: holds an instruction <?{node.target}?>; take it out")
        if isinstance(node.tag, str):
            yield node


def check(element: etree._Element) -> None:
    """Refuse an element that runs, moves, or reaches outside."""
    name = plain(element.tag)
    if name in REASONS:
        raise FileError(f"line {element.sourceline}: holds <{name}>; {REASONS[name]}")
    for key, value in element.attrib.items():
        attribute = plain(key)
        if attribute.lower().startswith("on"):
            raise FileError(f"line {element.sourceline}: {attribute} would run something; take it out")
        if attribute in ("href", "src") and not INSIDE.match(value.strip()):
            raise FileError(
                f"line {element.sourceline}: <{name}> refers to {value[:60]!r};"
                " nothing outside the drawing is read"
            )
        if OUTSIDE_PAINT.search(value) and attribute not in ("href", "d", "points", "id") and "}" not in key:
            raise FileError(
                f"line {element.sourceline}: {attribute} refers to {value[:60]!r};"
                " nothing outside the drawing is read"
            )
    if name == "style" and OUTSIDE_PAINT.search("".join(element.itertext())):
        raise FileError(
            f"line {element.sourceline}: <style> refers to what is outside the drawing; take it out"
        )


def refuse_multitudes(root: etree._Element) -> None:
    """Refuse more elements than anybody draws, counting what <use> draws again, and circles of <use>."""
    named = {element.get("id"): element for element in root.iter() if isinstance(element.tag, str)}
    for style in root.iter(SVG + "style", "style"):
        for name in PAINTED.findall("".join(style.itertext())):
            # Whatever has the style would draw it: what is not counted must be light
            if name in named and not plain(named[name].tag).endswith("Gradient"):
                raise FileError(
                    f"line {style.sourceline}: <style> paints with {name!r}; it may with gradients only"
                )
    known: dict[etree._Element, int] = {}
    # Deepest last, so that what an element needs is mostly known when its turn comes
    waiting: list[tuple[etree._Element, bool]] = [(root, False)]
    open_now: set[etree._Element] = set()
    while waiting:
        element, seen = waiting.pop()
        below = drawn_by(element, named)
        if seen:
            open_now.discard(element)
            known[element] = 1 + sum(known[one] for one in below)
            if known[element] > ELEMENTS:
                raise FileError(f"draws more than {ELEMENTS:,} elements; simplify it")
        elif element not in known:
            open_now.add(element)
            waiting.append((element, True))
            for one in below:
                if one in open_now:
                    raise FileError(
                        f"line {element.sourceline}: <{plain(element.tag)}> draws itself; take it out"
                    )
                waiting.append((one, False))


def drawn_by(element: etree._Element, named: dict[str | None, etree._Element]) -> list[etree._Element]:
    """What is drawn where an element is: its children, what it uses, and what it is painted with."""
    below = [one for one in element if isinstance(one.tag, str)]
    used = [(element.get("href") or element.get(XLINK) or "").strip()[1:]]
    used += [name for value in element.attrib.values() for name in PAINTED.findall(value)]
    return below + [named[name] for name in used if name in named]


def plain(name: str) -> str:
    """A name without its namespace."""
    return name.rpartition("}")[2]
