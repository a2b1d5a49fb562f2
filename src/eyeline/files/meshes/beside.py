"""Files that a model names: only in the model's own folder, and pictures only of a bounded size."""

from __future__ import annotations

from pathlib import Path

from eyeline.errors import FileError
from eyeline.files.limits import Allowance
from eyeline.files.meshes.text import shortened
from eyeline.files.pictures import decoded
from eyeline.geometry.arrays import ByteArray

FORMATS = ("PNG", "JPEG", "WebP", "TGA", "BMP", "TIFF")


def beside(folder: Path, name: str) -> Path | None:
    """The file `name` inside `folder`, every link followed; None where there is none.

    Refused: a name that leads elsewhere, be it an address, an absolute path or a way up.
    """
    plain, said = name.replace("\\", "/"), repr(shortened(name))
    if "://" in plain or plain.startswith("/") or plain[1:2] == ":":
        raise FileError(f"names {said}; only files in the model's own folder are read, so put it there")
    inside = folder.resolve()
    try:
        path = (inside / plain).resolve()
        found = path.is_file()
    except (OSError, RuntimeError, ValueError) as error:
        raise FileError(f"names {said}, which is no name of a file; put the file beside the model") from error
    if not path.is_relative_to(inside):
        raise FileError(f"names {said}, which leads out of the model's folder; put the file there")
    return path if found else None


def picture(path: Path, pixels: Allowance) -> ByteArray:
    """(H, W, 4) an image file; its size is looked at, and taken from the allowance, before it is decoded."""
    data = path.read_bytes()
    pixels.earn(len(data))
    return decoded(data, f"picture {shortened(path.name)!r}", FORMATS, pixels)
