"""`eyeline compare`: all methods on one scene, side by side."""

from __future__ import annotations

import json as encoding
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

Out = Annotated[
    Path,
    typer.Option(
        "--output", "-o", metavar="OUT", show_default=False,
        help="A sheet (.png), a page (.html), or data (.json).",
    ),
]  # fmt: skip
Methods = Annotated[str | None, typer.Option(metavar="NAME,NAME", help="Which methods.", show_default="all")]
Climb = Annotated[
    bool, typer.Option("--ladder", help="Also how time grows with faces and with pixels; takes minutes.")
]


def compare(
    scene: SceneName,
    output: Out,
    methods: Methods = None,
    size: Size = "1280x720",
    time: Time = 0.0,
    clip: ClipName = None,
    camera: CameraName = None,
    ladder: Climb = False,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:
    """Compare visible-surface methods on a scene: time, memory, work, and whether they agree."""
    from eyeline.comparison import compare as compared
    from eyeline.comparison.comparison import WRITERS
    from eyeline.files.whole import refuse_place

    if output.suffix.lower() not in WRITERS:
        raise FileError(f"{output}: is no comparison; use {', '.join(WRITERS)}")
    refuse_place(output)
    opened = scene_of(scene)
    names = None if methods is None else [name.strip() for name in methods.split(",")]
    with progress_bar(output.name, quiet) as progress:
        found = compared(
            opened, names, camera, size_of(size), time,
            clip=clip_of(opened, clip), ladder=ladder, progress=progress,
        )  # fmt: skip
    found.save(output)
    if json:
        print(encoding.dumps(found.data()))
