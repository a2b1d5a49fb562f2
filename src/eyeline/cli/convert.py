"""`eyeline convert`: a scene to another file format."""

from __future__ import annotations

import json as encoding
from pathlib import Path
from typing import Annotated

import typer

from eyeline.cli.progress import say
from eyeline.cli.values import Debug, Json, Quiet, SceneName, scene_of

Out = Annotated[
    Path,
    typer.Option("--output", "-o", metavar="OUT", show_default=False, help="A model: .glb or .gltf."),
]  # fmt: skip
Fps = Annotated[float, typer.Option(help="Times a second that constraints and deformers are asked.")]
Tolerance = Annotated[float, typer.Option(help="How far sampled keys may be, as a part of their range.")]


def convert(
    scene: SceneName,
    output: Out,
    fps: Fps = 60.0,
    tolerance: Tolerance = 1e-4,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:
    """Write a scene, with its clips, in the format that the suffix of OUT says."""
    from eyeline.files.saving import writer_of
    from eyeline.files.whole import refuse_place

    writer_of(output)
    refuse_place(output)
    notes = scene_of(scene).save(output, fps=fps, tolerance=tolerance)
    size = output.stat().st_size
    if json:
        print(encoding.dumps({"output": str(output), "bytes": size, "notes": list(notes)}))
    else:
        for line in (*notes, f"{output}: {size:,} bytes"):
            say(line, quiet)
