"""Files that a model names: only in the model's own folder, and pictures only of a bounded size."""

from __future__ import annotations

import io
import warnings
from pathlib import Path

import numpy as np

from eyeline.errors import FileError
from eyeline.files.gltf.limits import IMAGE_PIXELS, Allowance
from eyeline.files.meshes.text import shortened
from eyeline.geometry.arrays import ByteArray

FORMATS = ("PNG", "JPEG", "WEBP", "TGA", "BMP", "TIFF")


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
    from PIL import Image

    data = path.read_bytes()
    pixels.earn(len(data))
    place = f"picture {shortened(path.name)!r}"
    with warnings.catch_warnings():
        # Pillow warns of large pictures; here they are refused
        warnings.simplefilter("ignore")
        try:
            with Image.open(io.BytesIO(data), formats=FORMATS) as image:
                width, height = image.size
                if width * height > IMAGE_PIXELS:
                    raise FileError(
                        f"{place} has {width} x {height} pixels; at most {IMAGE_PIXELS:,} are read"
                    )
                pixels.spend(width * height, place)
                return np.array(image.convert("RGBA"))
        except Image.DecompressionBombError as error:
            raise FileError(f"{place} has too many pixels; at most {IMAGE_PIXELS:,} are read") from error
        except (OSError, SyntaxError, ValueError, EOFError, IndexError, KeyError, TypeError) as error:
            raise FileError(f"{place} cannot be read; save it again as PNG") from error
