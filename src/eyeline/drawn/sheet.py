"""The exposure sheet, or dope sheet: which drawing of which layer is shown in which frame."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from eyeline.drawn.drawings import Drawings, bounded, drawing_file, naming, natural_size
from eyeline.drawn.exposure import Exposure, exposures
from eyeline.drawn.stack import stacked, tinted
from eyeline.drawn.tables import CHARACTERS, TABLES
from eyeline.errors import EyelineError, FileError, OptionError
from eyeline.projection.project import checked_size
from eyeline.render.image import Image
from eyeline.render.reel import Pictures, Progress, Reel
from eyeline.render.shot import MOST_PIXELS

if TYPE_CHECKING:
    from eyeline.geometry.arrays import ByteArray

FPS = 24.0
EARLIER, LATER = (0.86, 0.24, 0.18), (0.12, 0.52, 0.78)  # tints, sRGB
NEAREST, FADE = 0.5, 0.55  # how strong the nearest neighbour is, and how much of that the one beyond it


def exposure_sheet(
    path: str | os.PathLike[str],
    *,
    on: int | None = None,
    fps: float | None = None,
    size: tuple[int, int] | None = None,
    under: Pictures | None = None,
    over: Pictures | None = None,
) -> ExposureSheet:
    """The film that an exposure sheet, .csv or .yaml, makes of drawings, .svg or .png, in its folder.

    on: how many frames a row is exposed, 2 is "on twos"; the sheet's own, else 1. fps: the sheet's own, else
    24. size: (width, height), pixels; the sheet's own, else that of its first drawing. under, over: pictures
    behind and before all drawings, such as an `el.film`; the last one holds. Refused in one sentence: what a
    sheet cannot mean, drawings outside its folder, and drawings that run or refer to anything.
    """
    path = Path(path)
    if path.suffix.lower() not in TABLES:
        raise FileError(f"{path.name}: the suffix {path.suffix!r} is no sheet; use {', '.join(TABLES)}")
    if on is not None and on < 1:
        raise OptionError(f"on is {on}; 1 frame or more for each row is needed")
    with naming(path):
        table = TABLES[path.suffix.lower()](sheet_text(path), on)
        layers = {name: layer_exposures(name, cells, table.frames) for name, cells in table.layers.items()}
        films = [film for film in (under, over) if film is not None]
        sides = size or table.size or first_size(path.parent, layers, films)
        drawings = Drawings(path.parent, film_size(sides))
        return ExposureSheet(drawings, layers, table.frames, fps or table.fps or FPS, under, over)


def sheet_text(path: Path) -> str:
    """What is written in a sheet."""
    try:
        return bounded(path, CHARACTERS).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileError("is no UTF-8 text; save it so") from error


def layer_exposures(name: str, cells: Mapping[int, str], frames: int) -> tuple[Exposure | None, ...]:
    """What each frame of a layer shows."""
    try:
        return exposures(cells, frames)
    except EyelineError as error:
        raise FileError(f"layer {name!r}: {error}") from error


@dataclass(frozen=True, eq=False)
class ExposureSheet:
    """Frames made one by one when they are asked for, in any order."""

    drawings: Drawings
    layers: dict[str, tuple[Exposure | None, ...]]  # from back to front; what each frame shows
    frames: int
    fps: float
    under: Pictures | None = None
    over: Pictures | None = None

    def __post_init__(self) -> None:
        """Refuse drawings that are not there, and films of another size, before long work begins."""
        shown = {exposure for layer in self.layers.values() for exposure in layer if exposure is not None}
        for name in sorted({name for exposure in shown for name in exposure[:2]} - {""}):
            drawing_file(self.drawings.folder, name)
        for film in (self.under, self.over):
            if film is not None and film[0].size != self.size:
                raise OptionError(
                    f"the film has {film[0].size[0]}x{film[0].size[1]} pixels and the drawings"
                    f" {self.size[0]}x{self.size[1]}; give both one size"
                )

    @property
    def size(self) -> tuple[int, int]:
        """(width, height), pixels."""
        return self.drawings.size

    def __len__(self) -> int:
        return self.frames

    def __getitem__(self, number: int) -> Image:
        if not -self.frames <= number < self.frames:
            raise IndexError(f"there is no frame {number}; the sheet has {self.frames}")
        return Image(stacked(self._pictures(number % self.frames), self.size))

    def __iter__(self) -> Iterator[Image]:
        return (self[number] for number in range(self.frames))

    def save(self, path: str | Path, *, progress: Progress | None = None) -> Path:
        """Write a film: .mp4, .webm, .gif or animated .webp, or a folder of PNG frames."""
        return Reel(self, self.fps).save(path, progress=progress)

    def onion(self, number: int, before: int = 2, after: int = 2, layer: str | None = None) -> Image:
        """Frame `number` with the drawings before it in red and those after it in blue, fainter and fainter.

        before, after: how many other drawings are shown; a drawing that is held counts once. layer: of this
        one only; left out, all of them together. On white paper, without the films.
        """
        if layer is not None and layer not in self.layers:
            raise OptionError(f"there is no layer {layer!r}; there is {', '.join(self.layers)}")
        layers = (layer,) if layer is not None else tuple(self.layers)
        here = range(self.frames)[number]
        earlier = self._others(layers, here, range(here - 1, -1, -1))[:before]
        later = self._others(layers, here, range(here + 1, self.frames))[:after]
        sheets = [np.full((self.size[1], self.size[0], 4), 255, np.uint8)]
        for frames, tint in ((earlier, EARLIER), (later, LATER)):
            for distance, frame in reversed(list(enumerate(frames))):
                drawing = stacked(self._drawn(layers, frame), self.size)
                sheets.append(tinted(drawing, tint, NEAREST * FADE**distance))
        return Image(stacked([*sheets, *self._drawn(layers, here)], self.size))

    def _pictures(self, frame: int) -> Iterator[ByteArray]:
        """All that a frame shows, from back to front."""
        if self.under is not None:
            yield self.under[min(frame, len(self.under) - 1)].pixels
        yield from self._drawn(tuple(self.layers), frame)
        if self.over is not None:
            yield self.over[min(frame, len(self.over) - 1)].pixels

    def _drawn(self, layers: tuple[str, ...], frame: int) -> Iterator[ByteArray]:
        for name in layers:
            exposure = self.layers[name][frame]
            if exposure is not None:
                yield self.drawings.picture(exposure)

    def _others(self, layers: tuple[str, ...], here: int, frames: range) -> list[int]:
        """The frames at which something else is shown than at the one looked at before."""
        found, latest = [], [self.layers[name][here] for name in layers]
        for frame in frames:
            shown = [self.layers[name][frame] for name in layers]
            if shown != latest:
                found.append(frame)
                latest = shown
        return found


def first_size(
    folder: Path, layers: Mapping[str, tuple[Exposure | None, ...]], films: Sequence[Pictures]
) -> tuple[int, int]:
    """The size of a film that comes with the sheet, else of its first drawing."""
    if films:
        return films[0][0].size
    for layer in layers.values():
        for exposure in layer:
            if exposure is not None:
                return natural_size(drawing_file(folder, exposure.drawing))
    raise FileError("shows no drawing in any frame; name one")


def film_size(size: tuple[int, int]) -> tuple[int, int]:
    """A size a film can have."""
    width, height = checked_size(size)
    if width * height > MOST_PIXELS:
        raise OptionError(f"size is {width}x{height}; a picture has at most {MOST_PIXELS} pixels")
    return width, height
