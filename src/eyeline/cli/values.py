"""What people type, as values: sizes, colours, scenes; and the options that several commands share."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from eyeline.errors import OptionError

if TYPE_CHECKING:
    from eyeline.scene.scene import Scene

SAMPLE = "sample:"

SceneName = Annotated[
    str,
    typer.Argument(
        metavar="SCENE", help="A model file, or sample:NAME for a built-in one.", show_default=False
    ),
]
Json = Annotated[bool, typer.Option("--json", help="Print data for programs.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No progress, no notes.")]
Debug = Annotated[bool, typer.Option("--debug", help="Print the traceback of a defect.")]
Size = Annotated[str, typer.Option(metavar="WIDTHxHEIGHT", help="Pixels.")]
Time = Annotated[float, typer.Option(help="Seconds: when the scene is looked at.")]
ClipName = Annotated[str | None, typer.Option(help="A clip's name or number.", show_default="the first")]
CameraName = Annotated[
    str | None,
    typer.Option(help="A camera's name or number.", show_default="the first, or a view that frames all"),
]


def size_of(text: str) -> tuple[int, int]:
    """1280x720 -> (1280, 720)."""
    found = re.fullmatch(r"(\d{1,9})[xX×](\d{1,9})", text.strip(), re.ASCII)
    if not found:
        raise OptionError(f"size is {text!r}; write it as 1280x720")
    return int(found[1]), int(found[2])


def background_of(text: str) -> Any:
    """Studio, transparent, or a colour as CSS writes it -> what a Look takes (linear light)."""
    if text in ("studio", "transparent"):
        return text
    from PIL import ImageColor

    try:
        shown = ImageColor.getrgb(text)[:3]
    except ValueError:
        raise OptionError(
            f"background is {text!r}; studio, transparent, or a colour such as white or '#203040' is needed"
        ) from None
    import numpy as np

    from eyeline.scene.colour import linear_from_srgb

    return tuple(linear_from_srgb(np.array(shown) / 255).tolist())


def clip_of(scene: Scene, name: str | None) -> str | int | None:
    """A clip by its name, or by its number where no clip has that name."""
    is_number = name is not None and name.isascii() and name.isdecimal()
    if name is None or not is_number or name in (clip.name for clip in scene.clips):
        return name
    return int(name)


def scene_of(name: str) -> Scene:
    """A scene from a file, or a built-in one."""
    if name.startswith(SAMPLE):
        from eyeline.errors import suggestion
        from eyeline.samples import SAMPLES

        wanted = name.removeprefix(SAMPLE)
        if wanted not in SAMPLES:
            raise OptionError(f"there is no sample {wanted!r}{suggestion(wanted, SAMPLES)}")
        return SAMPLES[wanted]()
    from eyeline.files import load

    return load(Path(name))
