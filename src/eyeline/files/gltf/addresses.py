"""Where a URI in a file points: into the URI itself, or to a file in the model's own folder, nowhere else."""

from __future__ import annotations

import base64
import binascii
from pathlib import Path
from urllib.parse import unquote, unquote_to_bytes

from eyeline.errors import FileError
from eyeline.files.gltf.part import Part


def embedded(part: Part) -> bytes | None:
    """The bytes of a data URI; None if `part.uri` is not one. [RFC 2397]"""
    uri = part.text("uri")
    if uri[:5].lower() != "data:":
        return None
    head, comma, data = uri[5:].partition(",")
    if not comma:
        raise part.refuse("uri", "a data URI has a comma before its data")
    if not head.lower().endswith(";base64"):
        return unquote_to_bytes(data)
    try:
        return base64.b64decode(unquote(data), validate=True)
    except (binascii.Error, ValueError) as error:
        raise FileError(f"{part.at('uri')} is not base64: {error}; export the model again") from error


def beside(part: Part, folder: Path) -> Path:
    """Where a relative URI names, inside `folder` with every link followed."""
    uri = part.text("uri")
    name = unquote(uri)
    if "://" in uri or Path(name).is_absolute() or name.startswith("\\") or name[1:2] == ":":
        raise part.refuse("uri", "only files in the model's own folder are read, so copy it there")
    if not name or not name.isprintable():
        raise part.refuse("uri", "the name of a file is needed")
    inside = folder.resolve()
    try:
        path = (inside / name).resolve()
    except (OSError, RuntimeError) as error:
        raise part.refuse("uri", "it cannot be followed, so copy the file itself there") from error
    if not path.is_relative_to(inside):
        raise part.refuse("uri", "it leads out of the model's folder, so copy the file there")
    return path


def present(part: Part, path: Path) -> bool:
    """Whether the file a URI names is there."""
    try:
        return path.is_file()
    except OSError as error:
        raise part.refuse("uri", "it is no name of a file") from error
