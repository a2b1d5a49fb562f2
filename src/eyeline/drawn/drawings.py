"""The drawings of a sheet: files in its folder, as pixels of the film's size."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from eyeline.drawn.exposure import Exposure
from eyeline.errors import EyelineError, FileError
from eyeline.files.limits import IMAGE_PIXELS, Allowance
from eyeline.files.pictures import decoded
from eyeline.files.svg.cels import cel_of
from eyeline.files.svg.picture import picture_of, size_of, text_of
from eyeline.files.svg.safety import BYTES, checked
from eyeline.geometry.arrays import ByteArray
from eyeline.shapes.cel import Cel, CelInbetween

SUFFIXES = (".svg", ".png")
PNG_BYTES = 2**28
KEPT = 64  # pictures that are kept, for drawings are shown again


@dataclass(frozen=True, eq=False)
class Drawings:
    """Drawings by name, made when they are first shown."""

    folder: Path
    size: tuple[int, int]  # of the film
    _pictures: dict[Exposure, ByteArray] = field(default_factory=dict, repr=False)
    _betweens: dict[tuple[str, str], CelInbetween] = field(default_factory=dict, repr=False)

    def picture(self, exposure: Exposure) -> ByteArray:
        """(H, W, 4) uint8 sRGB; change it no more."""
        found = self._pictures.get(exposure)
        if found is None:
            if len(self._pictures) >= KEPT:
                self._pictures.pop(next(iter(self._pictures)), None)
            found = self._pictures[exposure] = self._made(exposure)
        return found

    def _made(self, exposure: Exposure) -> ByteArray:
        path = drawing_file(self.folder, exposure.drawing)
        with naming(path):
            if exposure.towards:
                return picture_of(text_of(self._between(exposure).at(exposure.part)), self.size)
            if path.suffix.lower() == ".svg":
                return picture_of(svg_text(path), self.size)
            return fitted(png_pixels(path), self.size)

    def _between(self, exposure: Exposure) -> CelInbetween:
        key = exposure.drawing, exposure.towards
        if key not in self._betweens:
            start, end = (cel_from(drawing_file(self.folder, name)) for name in key)
            self._betweens[key] = start.inbetween(end)
        return self._betweens[key]


@contextmanager
def naming(path: Path) -> Iterator[None]:
    """Puts a file's name before the sentence of what is refused inside."""
    try:
        yield
    except EyelineError as error:
        if str(error).startswith(f"{path.name}: "):
            raise
        raise FileError(f"{path.name}: {error}") from error
    except OSError as error:
        raise FileError(f"{path.name}: {error.strerror or error}; check the path") from error


def drawing_file(folder: Path, name: str) -> Path:
    """The file of a drawing; its suffix may be left out. Refused: what is not in the folder of the sheet."""
    home = folder.resolve()
    try:
        wanted = (home / name).resolve()
        within = wanted.is_relative_to(home) and wanted != home and "\\" not in name
        for suffix in ("", *SUFFIXES) if within else ():
            path = wanted.with_name(wanted.name + suffix)
            drawing = path.suffix.lower() in SUFFIXES and path.is_file()
            if drawing and path.resolve().is_relative_to(home):
                return path
    except (OSError, ValueError) as error:
        raise FileError(f"{name[:60]!r} cannot be the name of a drawing") from error
    if not within:
        raise FileError(f"drawing {name[:60]!r} is not in the folder of the sheet; put it there")
    raise FileError(f"there is no drawing {name[:60]!r} beside the sheet, as {' or '.join(SUFFIXES)}")


def natural_size(path: Path) -> tuple[int, int]:
    """(width, height) of a drawing as it was made, pixels."""
    with naming(path):
        if path.suffix.lower() == ".svg":
            return size_of(svg_text(path))
        height, width = png_pixels(path).shape[:2]
        return width, height


def cel_from(path: Path) -> Cel:
    """A drawing as outlines."""
    with naming(path):
        if path.suffix.lower() != ".svg":
            raise FileError("is not SVG, and in-betweens are made of outlines; draw it so, or name another")
        return cel_of(svg_text(path))


def svg_text(path: Path) -> str:
    """A drawing that may be drawn."""
    return checked(bounded(path, BYTES))


def png_pixels(path: Path) -> ByteArray:
    """(H, W, 4) uint8."""
    return decoded(bounded(path, PNG_BYTES), "the drawing", ("PNG",), Allowance("pixels", IMAGE_PIXELS, 0))


def bounded(path: Path, most: int) -> bytes:
    """A file's bytes; refused: more than a drawing has."""
    size = path.stat().st_size
    if size > most:
        raise FileError(f"has {size:,} bytes; at most {most:,} are read, so simplify it")
    return path.read_bytes()


def fitted(pixels: ByteArray, size: tuple[int, int]) -> ByteArray:
    """A picture as large as fits into size, in its middle; what is beside it is clear."""
    height, width = pixels.shape[:2]
    if (width, height) == size:
        return pixels
    from PIL import Image

    factor = min(size[0] / width, size[1] / height)
    wide, high = max(1, round(width * factor)), max(1, round(height * factor))
    # With the colours multiplied by alpha, so that what is clear bleeds into nothing
    premultiplied = Image.fromarray(pixels).convert("RGBa")
    scaled = premultiplied.resize((wide, high), Image.Resampling.LANCZOS).convert("RGBA")
    sheet = np.zeros((size[1], size[0], 4), np.uint8)
    left, top = (size[0] - wide) // 2, (size[1] - high) // 2
    sheet[top : top + high, left : left + wide] = np.asarray(scaled)
    return sheet
