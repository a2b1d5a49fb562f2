"""`eyeline demo`: what eyeline does, from a built-in scene."""

from __future__ import annotations

import json as encoding
from pathlib import Path
from typing import Annotated

import typer

from eyeline.cli.progress import progress_bar
from eyeline.cli.values import Debug, Json, Quiet, Size, size_of
from eyeline.errors import FileError

Folder = Annotated[
    Path,
    typer.Option("--output", "-o", metavar="FOLDER", help="Where the results go; made if it is not there."),
]
Fps = Annotated[float, typer.Option(help="Frames a second.")]
Samples = Annotated[int, typer.Option(help="Samples a pixel: 1, 2, 4, 8 or 16.")]


def demo(
    output: Folder = Path("demo"),
    size: Size = "1280x720",
    fps: Fps = 24,
    samples: Samples = 4,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:
    """Make a film, a picture, a drawing and a contact sheet of a built-in scene."""
    from eyeline.render.contact import contact_sheet
    from eyeline.render.drawing import draw
    from eyeline.render.film import film
    from eyeline.samples.demo_shot import demo_shot

    if not output.parent.is_dir() or output.is_file():
        raise FileError(f"{output}: the folder cannot be made; its parent must be a folder, and it no file")
    scene = demo_shot()
    shown = film(scene, fps=fps, size=size_of(size), samples=samples)
    output.mkdir(exist_ok=True)
    made = [output / name for name in ("demo.png", "drawing.svg", "contact_sheet.png", "demo.mp4")]
    frame = len(shown) // 3
    shown[frame].save(made[0])
    draw(scene, time=float(shown.times[frame]), size=shown.shot.size).save(made[1])
    contact_sheet(shown).save(made[2])
    with progress_bar("demo.mp4", quiet) as progress:
        shown.save(made[3], progress=progress)
    if json:
        print(encoding.dumps({"paths": [str(path) for path in made], "frames": len(shown)}))
    elif not quiet:
        print("\n".join(str(path) for path in made))
