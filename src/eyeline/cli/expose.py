"""`eyeline expose`: the film of an exposure sheet, or an onion skin of one frame."""

from __future__ import annotations

import json as encoding
import time as clock
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from eyeline.cli.progress import progress_bar, say
from eyeline.cli.values import Debug, Json, Quiet, size_of
from eyeline.errors import OptionError

if TYPE_CHECKING:
    from eyeline.drawn import ExposureSheet

Sheet = Annotated[
    Path,
    typer.Argument(
        metavar="SHEET",
        show_default=False,
        help="An exposure sheet, .csv or .yaml, with its drawings beside it.",
    ),
]
Out = Annotated[
    Path,
    typer.Option(
        "--output", "-o", metavar="OUT", show_default=False,
        help="A film (.mp4 .webm .gif .webp), or a folder of PNG frames; with --onion, a picture.",
    ),
]  # fmt: skip
On = Annotated[
    int | None,
    typer.Option(metavar="FRAMES", help="Frames a row is exposed.", show_default="the sheet's, or 1"),
]
Fps = Annotated[float | None, typer.Option(help="Frames a second.", show_default="the sheet's, or 24")]
Size = Annotated[
    str | None,
    typer.Option(metavar="WIDTHxHEIGHT", help="Pixels.", show_default="the sheet's, or the first drawing's"),
]
Onion = Annotated[
    int | None,
    typer.Option(metavar="FRAME", help="The drawings around this frame, from 1.", show_default=False),
]


def expose(
    sheet: Sheet,
    output: Out,
    on: On = None,
    fps: Fps = None,
    size: Size = None,
    onion: Onion = None,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:
    """Make a film of drawings, as an exposure sheet says."""
    from eyeline.drawn import exposure_sheet

    begun = clock.perf_counter()
    refuse_output(output, onion)
    film = exposure_sheet(sheet, on=on, fps=fps, size=None if size is None else size_of(size))
    if onion is None:
        with progress_bar(output.name, quiet) as progress:
            film.save(output, progress=progress)
        frames = len(film)
    else:
        skin(film, onion, output)
        frames = 1
    seconds = clock.perf_counter() - begun
    if json:
        told = {"path": str(output), "frames": frames, "fps": film.fps, "size": list(film.size)}
        print(encoding.dumps({**told, "seconds": round(seconds, 3)}))
    else:
        say(f"{output}: {frames} frame{'s' * (frames != 1)} in {seconds:.1f} s", quiet)


def refuse_output(output: Path, onion: int | None) -> None:
    """Refuse a place or a suffix that cannot be written, before long work begins."""
    from eyeline.files.whole import refuse_place
    from eyeline.render.encoders import encoder_for
    from eyeline.render.image import FORMATS

    if onion is None:
        encoder_for(output).check(output)
    elif output.suffix.lower() not in FORMATS:
        raise OptionError(f"{output}: an onion skin is one picture; use {', '.join(FORMATS)}")
    else:
        refuse_place(output)


def skin(film: ExposureSheet, frame: int, output: Path) -> None:
    """Save the onion skin of a frame, counted from 1 as sheets do."""
    if not 1 <= frame <= len(film):
        raise OptionError(f"frame is {frame}; the sheet has frames 1 to {len(film)}")
    film.onion(frame - 1).save(output)
