"""A vector drawing of a scene, and how it is kept."""

from __future__ import annotations

import importlib
import importlib.util
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from eyeline.cached import cached_property
from eyeline.errors import FileError, OptionError
from eyeline.files.whole import whole_file
from eyeline.projection.project import checked_size
from eyeline.render.shot import SIZE
from eyeline.render.staging import Staged, staged
from eyeline.render.viewpoint import CameraChoice, chosen_camera

if TYPE_CHECKING:
    from eyeline.drawing.lines import Lines
    from eyeline.drawing.sheet import Sheet

HIDDEN = ("omit", "dashed")
FORMATS = {
    ".svg": ("eyeline.drawing.svg", "svg_of", ""),
    ".pdf": ("eyeline.drawing.pdf", "pdf_of", "fpdf"),
    ".dxf": ("eyeline.drawing.dxf", "dxf_of", "ezdxf"),
}  # suffix -> where its writer is, and the library of the extra `draw` that it needs
CREASE = math.radians(40)


def draw(
    scene: Staged,
    camera: CameraChoice = None,
    time: float = 0.0,
    size: tuple[int, int] = SIZE,
    hidden: str = "omit",
    *,
    edges: Iterable[str] = ("outline", "boundary", "crease", "intersection"),
    crease: float = CREASE,
    clip: str | int | None = None,
) -> Drawing:
    """The lines of a scene at a time (seconds), exactly where they are seen, as vectors.

    camera: a Camera, or the name or number of one in the scene; None is the scene's first, or a view that
    frames the scene. size: (width, height), pixels. hidden: "omit" leaves out what something stands before,
    "dashed" draws it in fine dashes. edges: any of "outline" (where a surface turns away), "boundary" (where
    it ends), "crease" (where its faces turn by more than `crease` radians), "intersection" (where parts pass
    through each other), "mesh" (all other edges). Transparent surfaces count as solid.
    """
    from eyeline.drawing.kinds import checked_kinds
    from eyeline.drawing.lines import lines_of

    size, kinds = checked_size(size), checked_kinds(edges)
    if hidden not in HIDDEN:
        raise OptionError(f"hidden is {hidden!r}; there is {', '.join(map(repr, HIDDEN))}")
    if not 0 <= crease <= math.pi:
        raise OptionError(f"crease is {crease:g} radians; 0 to pi, half a turn, is needed")
    posed = staged(scene).at(time, clip)
    lens = chosen_camera(posed, camera, size[0] / size[1])
    lines = lines_of(posed, lens, size, kinds, crease)
    metres = None if lens.height is None else lens.height / size[1]
    return Drawing(lines, posed.paths, hidden == "dashed", posed.name, metres)


@dataclass(frozen=True, eq=False)
class Drawing:
    """Lines of a scene, and which of them are shown."""

    lines: Lines
    names: tuple[str, ...]  # of the scene's nodes
    dashed: bool  # whether hidden lines are drawn
    title: str = ""
    metres: float | None = None  # in a pixel, of an orthographic camera

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) in pixels."""
        return self.lines.size

    @cached_property
    def sheet(self) -> Sheet:
        """Paths and pens."""
        from eyeline.drawing.sheet import sheet_of

        return sheet_of(self.lines, self.names, self.dashed, self.title, self.metres)

    def save(self, path: str | Path) -> Path:
        """Write a .svg, .pdf or .dxf; the file appears whole or not at all."""
        path = Path(path)
        content = writer_of(path)(self.sheet)
        with whole_file(path) as unfinished:
            unfinished.write_bytes(content)
        return path

    def _repr_svg_(self) -> str:
        from eyeline.drawing.svg import svg_of

        return svg_of(self.sheet).decode()


def writer_of(path: Path) -> Callable[[Sheet], bytes]:
    """What writes a drawing to a file of this name. Refused: what it cannot be, and a missing library."""
    suffix = path.suffix.lower()
    if suffix not in FORMATS:
        raise FileError(f"{path}: {path.suffix or 'no suffix'} is no drawing; use {', '.join(FORMATS)}")
    module, function, library = FORMATS[suffix]
    if library and importlib.util.find_spec(library) is None:
        raise OptionError(f"{path}: {suffix} needs what is not installed; pip install eyeline[draw]")
    writer: Callable[[Sheet], bytes] = getattr(importlib.import_module(module), function)
    return writer
