"""`eyeline render`: a picture or a film of a scene."""

from __future__ import annotations

import json as encoding
import sys
import time as clock
from pathlib import Path
from typing import Annotated, Any

import typer

from eyeline.cli.progress import progress_bar, say
from eyeline.cli.values import (
    CameraName,
    ClipName,
    Debug,
    Json,
    Quiet,
    SceneName,
    Size,
    background_of,
    clip_of,
    scene_of,
    size_of,
)
from eyeline.errors import OptionError

STILL = (".png", ".jpg", ".jpeg")  # always one picture; .webp is either

Out = Annotated[
    Path,
    typer.Option(
        "--output", "-o", metavar="OUT", show_default=False,
        help="A picture (.png .jpg .webp), a film (.mp4 .webm .gif .webp), or a folder of PNG frames.",
    ),
]  # fmt: skip
Time = Annotated[float | None, typer.Option(help="Seconds: when the picture is taken.", show_default="0")]
Fps = Annotated[float | None, typer.Option(help="Frames a second.", show_default="24")]
Start = Annotated[float | None, typer.Option(help="Seconds: where the film begins.", show_default="0")]
End = Annotated[float | None, typer.Option(help="Seconds: where it ends.", show_default="the clip's end")]
Turntable = Annotated[
    float | None,
    typer.Option(metavar="SECONDS", help="The camera goes once around the scene.", show_default=False),
]
Style = Annotated[str, typer.Option(help="How it looks.")]
Method = Annotated[str, typer.Option(help="How hidden surfaces are found.")]
Samples = Annotated[int, typer.Option(help="Samples a pixel: 1, 2, 4, 8 or 16.")]
Background = Annotated[str, typer.Option(help="studio, transparent, or a colour.")]
Exposure = Annotated[float, typer.Option(metavar="STOPS", help="Each doubles the light.")]
Resume = Annotated[bool, typer.Option("--resume", help="Continue a folder of frames.")]


def render(
    scene: SceneName,
    output: Out,
    size: Size = "1280x720",
    time: Time = None,
    fps: Fps = None,
    start: Start = None,
    end: End = None,
    clip: ClipName = None,
    camera: CameraName = None,
    turntable: Turntable = None,
    style: Style = "shaded",
    method: Method = "zbuffer",
    samples: Samples = 4,
    background: Background = "studio",
    exposure: Exposure = 0.0,
    resume: Resume = False,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:
    """Draw a scene: a picture or a film, as the suffix of OUT says."""
    span = {
        name: value
        for name, value in {"fps": fps, "start": start, "end": end, "turntable": turntable}.items()
        if value is not None
    }
    options: dict[str, Any] = {
        "camera": camera, "size": size_of(size), "clip": clip, "style": style, "method": method,
        "samples": samples, "background": background_of(background), "exposure": exposure,
    }  # fmt: skip
    begun = clock.perf_counter()
    if is_still(output, span, resume):
        done = still(scene, output, time or 0.0, options)
    elif time is not None:
        raise OptionError(f"{output}: is a film; --time is for pictures, --start and --end are for films")
    else:
        done = moving(scene, output, span, options, resume, quiet)
    seconds = clock.perf_counter() - begun
    if json:
        print(encoding.dumps({**done, "seconds": round(seconds, 3)}))
    else:
        say(f"{output}: {done['frames']} frame{'s' * (done['frames'] != 1)} in {seconds:.1f} s", quiet)


def is_still(output: Path, span: dict[str, float], resume: bool) -> bool:
    """Whether OUT is one picture; refuses a picture with the options of a film."""
    suffix = output.suffix.lower()
    if suffix in STILL and (span or resume):
        given = f"--{next(iter(span), 'resume')}"
        raise OptionError(
            f"{output}: is one picture, and {given} is for films; use .mp4 or a folder, or leave it out"
        )
    return suffix in STILL or (suffix == ".webp" and not span)


def still(scene: str, output: Path, time: float, options: dict[str, Any]) -> dict[str, Any]:
    """Make and save one picture."""
    from eyeline.files.whole import refuse_place
    from eyeline.render.frame import render as picture_of
    from eyeline.render.shot import shot_of

    refuse_place(output)
    shot_of(**options)
    opened = scene_of(scene)
    image = picture_of(opened, time=time, **options | {"clip": clip_of(opened, options["clip"])})
    image.save(output)
    return {"path": str(output), "frames": 1, "size": list(image.size)}


def moving(
    scene: str, output: Path, span: dict[str, float], options: dict[str, Any], resume: bool, quiet: bool
) -> dict[str, Any]:
    """Make and save a film."""
    from eyeline.render.encoders import encoder_for
    from eyeline.render.film import film
    from eyeline.render.shot import shot_of

    encoder = encoder_for(output)
    encoder.check(output)
    shot_of(**options)
    opened = scene_of(scene)
    shown = film(opened, **span, **options | {"clip": clip_of(opened, options["clip"])})
    notes = encoder.notes(shown.job())
    for note in () if quiet else notes:
        print("eyeline:", note, file=sys.stderr)
    with progress_bar(output.name, quiet) as progress:
        shown.save(output, resume=resume, progress=progress)
    return {
        "path": str(output), "frames": len(shown), "fps": shown.fps,
        "size": list(shown.shot.size), "notes": list(notes),
    }  # fmt: skip
