"""One drawing by itself: read as outlines, and seen as a picture."""

from __future__ import annotations

import os
from pathlib import Path

from eyeline.drawn.drawings import cel_from
from eyeline.files.svg.picture import picture_of, text_of
from eyeline.render.image import Image
from eyeline.shapes.cel import Cel


def cel(path: str | os.PathLike[str]) -> Cel:
    """The painted outlines of an .svg; `cel(a).inbetween(cel(b)).at(0.5)` is the drawing half way.

    Refused in one sentence: what runs, what refers to anything outside, letters, and paint that is no plain
    colour.
    """
    return cel_from(Path(path))


def picture(drawing: Cel, size: tuple[int, int] | None = None) -> Image:
    """A cel as pixels, clear where nothing is drawn; size: (width, height), its own if left out."""
    width, height = drawing.size
    return Image(picture_of(text_of(drawing), size or (max(1, round(width)), max(1, round(height)))))
