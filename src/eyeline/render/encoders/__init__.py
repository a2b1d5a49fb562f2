"""Kinds of film files, by the suffix of their name."""

from __future__ import annotations

from pathlib import Path

from eyeline.errors import FileError
from eyeline.render.encoders.encoder import Encoder
from eyeline.render.encoders.gif import GIF
from eyeline.render.encoders.mp4 import MP4
from eyeline.render.encoders.sequence import SEQUENCE
from eyeline.render.encoders.webm import WEBM
from eyeline.render.encoders.webp import WEBP
from eyeline.render.image import FORMATS

ENCODERS: dict[str, Encoder] = {one.name: one for one in (MP4, WEBM, GIF, WEBP, SEQUENCE)}


def encoder_for(path: Path) -> Encoder:
    """The encoder of a path's suffix; a path without one is a folder of PNG frames."""
    suffix = path.suffix.lower()
    if suffix not in ENCODERS:
        raise FileError(
            f"{path}: {suffix} is no film; use {', '.join(filter(None, ENCODERS))} or a folder of PNG frames,"
            f" and {', '.join(FORMATS)} for one picture"
        )
    return ENCODERS[suffix]
