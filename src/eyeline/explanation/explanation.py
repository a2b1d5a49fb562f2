"""`explain`: a method's steps on a scene, limited to what a person can follow."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

from eyeline.cached import cached_property
from eyeline.errors import FileError, OptionError, suggestion
from eyeline.explanation.frames import Frame, frames_of
from eyeline.explanation.reduction import reduced
from eyeline.geometry.arrays import ByteArray
from eyeline.projection import project
from eyeline.projection.project import checked_size
from eyeline.projection.projected import Projected
from eyeline.render.staging import Staged, staged
from eyeline.render.viewpoint import CameraChoice, chosen_camera
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS
from eyeline.visibility.method import Method, Step

if TYPE_CHECKING:
    from eyeline.render.film import Progress

SIZE = (96, 54)  # pixels, each large enough to be seen
MOST_FACES = 400
MOST_PIXELS = 320 * 180
MOST_STEPS = 60_000  # more are not made; the method stops there
PAGE_FRAMES, FILM_FRAMES, SHEET_FRAMES = 3000, 480, 12
FPS = 12


def explain(
    scene: Staged,
    method: str,
    camera: CameraChoice = None,
    size: tuple[int, int] = SIZE,
    time: float = 0.0,
    *,
    clip: str | int | None = None,
    cull: str = "auto",
    faces: int = MOST_FACES,
) -> Explanation:
    """The steps of a method of METHODS on a scene at a time (seconds), ready to be shown.

    size: (width, height) of the explained picture in its own pixels, at most 320x180 of them, for each is
    drawn large. faces: a larger scene is shown with about so many, and a notice says so.
    """
    if method not in METHODS:
        raise OptionError(f"there is no method {method!r}{suggestion(method, METHODS)}")
    width, height = checked_size(size)
    if width * height > MOST_PIXELS:
        raise OptionError(f"size is {width}x{height}; an explanation has at most {MOST_PIXELS} pixels")
    if faces < 1:
        raise OptionError(f"faces is {faces}; at least 1 is needed")
    posed = staged(scene).at(time, clip)
    view = chosen_camera(posed, camera, width / height).fitted(posed.bounds)
    small = reduced(posed, faces)
    projected = project(small.scene, view, (width, height), cull)
    steps = tuple(islice(METHODS[method].steps(projected), MOST_STEPS))
    notices = [small.notice] if small.notice else []
    if len(steps) == MOST_STEPS:
        notices.append(f"the method is shown up to its step {MOST_STEPS:,}; fewer faces or pixels take fewer")
    return Explanation(small.scene, projected, METHODS[method], steps, tuple(notices))


@dataclass(frozen=True, eq=False)
class Explanation:
    """The steps of one method on one scene."""

    scene: Scene
    projected: Projected
    method: Method
    steps: tuple[Step, ...]
    notices: tuple[str, ...] = ()  # a sentence each: what was made smaller

    def __iter__(self) -> Iterator[Step]:
        return iter(self.steps)

    def __len__(self) -> int:
        return len(self.steps)

    def frames(self, most: int) -> Iterator[Frame]:
        """The steps as at most so many frames."""
        return frames_of(self.steps, self.projected, most)

    @cached_property
    def colours(self) -> ByteArray:
        """(F, 3) sRGB: every face's colour in the explanation."""
        from eyeline.shading.face_colours import face_colours

        return face_colours(self.scene, self.projected.camera)

    def save(self, path: str | Path, progress: Progress | None = None) -> Path:
        """Write a film (.mp4 .webm .gif .webp), a page (.html), a sheet (.svg) or the steps as data (.json).

        The file appears whole or not at all.
        """
        path = Path(path)
        suffix = path.suffix.lower()
        if suffix not in WRITERS:
            raise FileError(f"{path}: {suffix or 'no suffix'} is no explanation; use {', '.join(WRITERS)}")
        WRITERS[suffix](self, path, progress)
        return path

    def _repr_html_(self) -> str:
        from eyeline.explanation.page import embedded

        return embedded(self)


def write_film(explanation: Explanation, path: Path, progress: Progress | None) -> None:
    """A film of at most FILM_FRAMES frames."""
    from eyeline.explanation.board import write

    write(explanation, path, FILM_FRAMES, FPS, progress)


def write_page(explanation: Explanation, path: Path, progress: Progress | None) -> None:
    """A page that needs nothing beside it."""
    from eyeline.explanation.page import page
    from eyeline.files.whole import whole_file

    with whole_file(path) as unfinished:
        unfinished.write_text(page(explanation), encoding="utf-8")


def write_sheet(explanation: Explanation, path: Path, progress: Progress | None) -> None:
    """A drawing of at most SHEET_FRAMES frames side by side."""
    from eyeline.explanation.sheet import sheet
    from eyeline.files.whole import whole_file

    with whole_file(path) as unfinished:
        unfinished.write_text(sheet(explanation, SHEET_FRAMES), encoding="utf-8")


def write_data(explanation: Explanation, path: Path, progress: Progress | None) -> None:
    """What the page is made of."""
    from eyeline.explanation.page import data_of
    from eyeline.files.whole import whole_file

    with whole_file(path) as unfinished:
        unfinished.write_text(data_of(explanation), encoding="utf-8")


WRITERS = {
    ".mp4": write_film,
    ".webm": write_film,
    ".gif": write_film,
    ".webp": write_film,
    ".html": write_page,
    ".svg": write_sheet,
    ".json": write_data,
}
