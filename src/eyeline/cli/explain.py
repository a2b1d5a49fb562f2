"""`eyeline explain`: a method at work on a scene, step by step."""

from __future__ import annotations

import json as encoding
import sys
from pathlib import Path
from typing import Annotated

import typer

from eyeline.cli.progress import progress_bar
from eyeline.cli.values import (
    CameraName,
    ClipName,
    Debug,
    Json,
    Quiet,
    SceneName,
    Size,
    Time,
    clip_of,
    scene_of,
    size_of,
)
from eyeline.errors import FileError

MethodName = Annotated[str, typer.Argument(metavar="METHOD", help="zbuffer, warnock ...", show_default=False)]
Out = Annotated[
    Path,
    typer.Option(
        "--output", "-o", metavar="OUT", show_default=False,
        help="A film (.mp4 .webm .gif .webp), a page (.html), a sheet of steps (.svg), or data (.json).",
    ),
]  # fmt: skip
Faces = Annotated[int, typer.Option(help="A larger scene is shown with about so many faces.")]


def explain(
    method: MethodName,
    scene: SceneName,
    output: Out,
    size: Size = "96x54",
    time: Time = 0.0,
    clip: ClipName = None,
    camera: CameraName = None,
    faces: Faces = 400,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:
    """Show a method at work on a scene: what it compares, decides and draws, with its counters."""
    from eyeline.explanation import explain as explained
    from eyeline.explanation.explanation import WRITERS
    from eyeline.files.whole import refuse_place

    if output.suffix.lower() not in WRITERS:
        raise FileError(f"{output}: is no explanation; use {', '.join(WRITERS)}")
    refuse_place(output)
    opened = scene_of(scene)
    shown = explained(opened, method, camera, size_of(size), time, clip=clip_of(opened, clip), faces=faces)
    for notice in () if quiet else shown.notices:
        print("eyeline:", notice, file=sys.stderr)
    with progress_bar(output.name, quiet) as progress:
        shown.save(output, progress)
    if json:
        told = {"path": str(output), "method": method, "steps": len(shown), "notices": list(shown.notices)}
        print(encoding.dumps(told | {"work": dict(shown.steps[-1].work) if shown.steps else {}}))
