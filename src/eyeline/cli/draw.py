"""`eyeline draw`: the lines of a scene as vectors."""

from __future__ import annotations

import json as encoding
import math
import time as clock
from collections import Counter
from pathlib import Path
from typing import Annotated

import typer

from eyeline.cli.progress import say
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
from eyeline.errors import OptionError

Out = Annotated[
    Path,
    typer.Option(
        "--output", "-o", metavar="OUT", show_default=False, help="A drawing: .svg, .pdf or .dxf.",
    ),
]  # fmt: skip
Hidden = Annotated[str, typer.Option(help="What something stands before: omit or dashed.")]
Edges = Annotated[
    str, typer.Option(metavar="KIND,KIND", help="Of outline, boundary, crease, intersection, mesh.")
]
Crease = Annotated[float, typer.Option(metavar="DEGREES", help="Faces that turn by more make a crease.")]


def draw(
    scene: SceneName,
    output: Out,
    size: Size = "1280x720",
    time: Time = 0.0,
    clip: ClipName = None,
    camera: CameraName = None,
    hidden: Hidden = "omit",
    edges: Edges = "outline,boundary,crease,intersection",
    crease: Crease = 40.0,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:
    """Draw the visible lines of a scene as vectors, in the format that the suffix of OUT says."""
    from eyeline.drawing.kinds import checked_kinds
    from eyeline.files.whole import refuse_place
    from eyeline.projection.project import checked_size
    from eyeline.render.drawing import draw as drawing_of
    from eyeline.render.drawing import writer_of

    begun = clock.perf_counter()
    writer_of(output)
    refuse_place(output)
    if not 0 <= crease <= 180:
        raise OptionError(f"crease is {crease:g} degrees; 0 to 180 is needed")
    wanted = checked_size(size_of(size))
    kinds = checked_kinds(name.strip() for name in edges.split(",") if name.strip())
    opened = scene_of(scene)
    drawing = drawing_of(
        opened, camera, time, wanted, hidden,
        edges=kinds, crease=math.radians(crease), clip=clip_of(opened, clip),
    )  # fmt: skip
    drawing.save(output)
    seconds = clock.perf_counter() - begun
    paths = Counter[str]()
    for group in drawing.sheet.groups:
        paths[group.kind if group.seen else f"hidden {group.kind}"] += len(group.paths)
    if json:
        told = {"path": str(output), "size": list(drawing.size), "paths": dict(paths)}
        print(encoding.dumps({**told, "seconds": round(seconds, 3)}))
    else:
        say(f"{output}: {sum(paths.values())} paths in {seconds:.1f} s", quiet)
