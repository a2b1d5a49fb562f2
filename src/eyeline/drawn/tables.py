"""Exposure sheets as they are written: CSV, a column a layer and a row a frame; or YAML."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from eyeline.errors import FileError
from eyeline.files.extra import extra

CHARACTERS = 2**22  # of a sheet
FRAMES = 1_000_000
CELLS = 10_000_000  # frames of all layers together
FRAME = "frame"  # the first column, where there is one, says so
KNOWN = {"layers", "on", "fps", "size", "frames"}


@dataclass(frozen=True)
class Table:
    """What is written in a sheet."""

    layers: Mapping[str, Mapping[int, str]]  # from back to front; frame, from 1 -> what is written there
    frames: int
    fps: float | None = None
    size: tuple[int, int] | None = None

    def __post_init__(self) -> None:
        """Refuse more than anybody draws: a few bytes can claim it."""
        if self.frames > FRAMES or self.frames * len(self.layers) > CELLS:
            raise FileError(
                f"has {self.frames:,} frames of {len(self.layers):,} layers; at most {FRAMES:,} frames,"
                f" and {CELLS:,} of all layers together, are read"
            )


def from_csv(text: str, on: int | None) -> Table:
    """The first row names the layers, from back to front; each other row is exposed for `on` frames.

    A first column `frame` says where each row begins instead; the last row is then exposed for `on` frames.
    """
    try:
        written = csv.reader(io.StringIO(text, newline=""), strict=True)
        rows = [[cell.strip() for cell in row] for row in written]
    except csv.Error as error:
        raise FileError(f"is no CSV that can be read ({error}); save it again") from error
    while rows and not rows[-1]:  # lines at the end that hold nothing, not even commas
        rows.pop()
    if len(rows) < 2:
        raise FileError("has no frames; its first row names layers, and each other row is one frame or more")
    names, numbered = rows[0], rows[0][:1] == [FRAME]
    layers: dict[str, dict[int, str]] = {}
    for name in names[numbered:]:
        if not name or name in layers:
            raise FileError(f"names layer {name!r} twice or not at all; every column needs a name of its own")
        layers[name] = {}
    start, step = 0, on or 1
    for number, row in enumerate(rows[1:], 2):
        if numbered and not row:
            continue
        if len(row) > len(names):
            raise FileError(f"line {number} has {len(row)} cells for {len(names)} columns")
        before, start = start, whole(row[0], f"line {number}") if numbered else 1 + (number - 2) * step
        if start <= before:
            raise FileError(f"line {number} begins at frame {start}, after frame {before}; frames must rise")
        for name, words in zip(names[numbered:], row[numbered:], strict=False):
            layers[name][start] = words
    return Table(layers, start + step - 1)


def from_yaml(text: str, on: int | None) -> Table:
    """A mapping: `layers`, name -> list of cells or frame -> cell; if wanted on, fps, size, frames."""
    with extra("YAML sheets"):
        import yaml
    try:
        given = yaml.safe_load(text)
    except (yaml.YAMLError, RecursionError) as error:
        raise FileError(f"is no YAML that can be read: {' '.join(str(error).split())}") from error
    # In YAML 1.1 a bare `on` is the truth
    sheet = {("on" if key is True else key): value for key, value in fields(given, "the sheet").items()}
    for key in sheet.keys() - KNOWN:
        raise FileError(f"has a field {key!r}; there is {', '.join(sorted(KNOWN))}")
    step = on or whole(sheet.get("on", 1), "on")
    layers, last = {}, 0
    for name, cells in fields(sheet.get("layers"), "layers").items():
        layers[str(name)] = written = column(cells, f"layer {name!r}", step)
        last = max(last, max(written, default=0) + step - 1)
    frames = whole(sheet["frames"], "frames") if "frames" in sheet else last
    if not layers or frames < 1:
        raise FileError("has no frames; its layers name drawings")
    size = sheet.get("size")
    if size is not None and (not isinstance(size, list) or len(size) != 2):
        raise FileError(f"size is {size!r}; [width, height] in pixels is needed")
    sides = None if size is None else (whole(size[0], "size"), whole(size[1], "size"))
    fps = sheet.get("fps")
    if fps is not None and (isinstance(fps, bool) or not isinstance(fps, int | float)):
        raise FileError(f"fps is {fps!r}; a number is needed")
    return Table(layers, frames, fps, sides)


def column(cells: Any, place: str, step: int) -> dict[int, str]:
    """Frame -> cell, of a list of cells or of a mapping."""
    if isinstance(cells, list):
        return {1 + step * row: word(cell, place) for row, cell in enumerate(cells)}
    written = fields(cells, place)
    return {whole(frame, f"{place}: a frame"): word(cell, place) for frame, cell in written.items()}


def fields(value: Any, place: str) -> Mapping[Any, Any]:
    """A mapping; refused: everything else."""
    if not isinstance(value, dict):
        raise FileError(f"{place} is {type(value).__name__}; name: value is needed")
    return value


def word(cell: Any, place: str) -> str:
    """A cell as text; nothing holds."""
    if cell is None:
        return ""
    if isinstance(cell, bool) or not isinstance(cell, str | int):
        raise FileError(f"{place} has a cell {cell!r}; the name of a drawing is needed")
    return str(cell).strip()


def whole(value: Any, place: str) -> int:
    """A whole number of frames or pixels, above 0."""
    words = str(value).strip()
    if (
        isinstance(value, bool)
        or not words.isascii()
        or not words.isdecimal()
        or not 1 <= int(words[:9]) <= FRAMES
    ):
        raise FileError(f"{place} is {words[:40]!r}; a whole number from 1 to {FRAMES:,} is needed")
    return int(words[:9])


TABLES: dict[str, Callable[[str, int | None], Table]] = {
    ".csv": from_csv,
    ".yaml": from_yaml,
    ".yml": from_yaml,
}  # suffix -> its reader
