"""A shot: everything that decides a picture beside the scene and the time."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from eyeline.errors import OptionError, suggestion
from eyeline.projection.project import checked_size
from eyeline.projection.sides import checked_cull
from eyeline.render.sampling import sample_positions
from eyeline.render.viewpoint import CameraChoice
from eyeline.shading.look import Look
from eyeline.visibility import method_named

SIZE = (1280, 720)
MOST_PIXELS = 1 << 26  # so that a mistyped size is refused before it takes all memory


@dataclass(frozen=True, eq=False)
class Shot:
    """The camera, the clip, the size, how hidden surfaces are found, and how the rest shall look."""

    camera: CameraChoice = None  # None: the scene's first, or a view that frames it
    size: tuple[int, int] = SIZE  # width, height, pixels
    clip: str | int | None = None  # None: the scene's first
    method: str = "zbuffer"  # a name in METHODS
    samples: int = 4  # a pixel: 1, 2, 4, 8 or 16
    cull: str = "auto"  # "auto": back faces of single-sided materials; "back": all; "none"
    look: Look = field(default_factory=Look)

    def __post_init__(self) -> None:
        """Refuse what no picture can be made with, before long work begins."""
        width, height = checked_size(self.size)
        if width * height > MOST_PIXELS:
            raise OptionError(f"size is {width}x{height}; a picture has at most {MOST_PIXELS} pixels")
        object.__setattr__(self, "size", (width, height))
        sample_positions(self.samples)
        method_named(self.method)
        checked_cull(self.cull)
        check_style(self.look.style)


def shot_of(style: str = "shaded", **options: Any) -> Shot:
    """A shot of keyword options: those of Shot, and those of Look."""
    own = {name: options.pop(name) for name in tuple(options) if name in SHOT_OPTIONS}
    unknown = set(options) - LOOK_OPTIONS
    if unknown:
        name = min(unknown)
        raise OptionError(
            f"there is no option {name!r}{suggestion(name, sorted(SHOT_OPTIONS | LOOK_OPTIONS))}"
        )
    return Shot(**own, look=Look(style=style, **options))


SHOT_OPTIONS = set(Shot.__dataclass_fields__) - {"look"}
LOOK_OPTIONS = set(Look.__dataclass_fields__) - {"style"}


def check_style(name: str) -> None:
    """Refuse a style that is not there."""
    from eyeline.shading.styles import STYLES

    if name not in STYLES:
        raise OptionError(f"there is no style {name!r}{suggestion(name, STYLES)}")
