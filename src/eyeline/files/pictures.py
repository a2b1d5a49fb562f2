"""Pictures that models bring with them: decoded in bounded memory, or refused in a sentence."""

from __future__ import annotations

import io
import warnings
from typing import TYPE_CHECKING

import numpy as np

from eyeline.errors import FileError
from eyeline.files.limits import IMAGE_PIXELS, Allowance
from eyeline.files.png import png_of
from eyeline.geometry.arrays import ByteArray

if TYPE_CHECKING:
    import PIL.Image


def decoded(data: bytes, place: str, formats: tuple[str, ...], pixels: Allowance) -> ByteArray:
    """(H, W, 4) uint8 sRGB, of one of `formats`; `place` is what errors call it.

    Its size is looked at, and taken from the allowance, before it is decoded.
    """
    from PIL import Image

    # Pillow warns of large pictures; ours are counted and refused instead
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            with Image.open(io.BytesIO(data), formats=formats) as image:
                width, height = image.size
                if width * height > IMAGE_PIXELS:
                    raise FileError(
                        f"{place} has {width} x {height} pixels; at most {IMAGE_PIXELS:,} are read,"
                        " so shrink it"
                    )
                pixels.spend(width * height, place)
                return in_bytes(image)
        except Image.DecompressionBombError as error:
            raise FileError(f"{place} has too many pixels; at most {IMAGE_PIXELS:,} are read") from error
        except (OSError, SyntaxError, ValueError, EOFError, IndexError, KeyError, TypeError) as error:
            raise FileError(
                f"{place} is no {', '.join(formats[:-1])} or {formats[-1]} image that can be read"
                f" ({type(error).__name__}); save it again"
            ) from error


def in_bytes(image: PIL.Image.Image) -> ByteArray:
    """(H, W, 4) uint8; deep greys lose their low bits; colour profiles are left aside."""
    if image.mode.startswith("I"):
        deep = np.asarray(image)
        grey = (deep >> 8).clip(0, 255).astype(np.uint8)
        return np.dstack([grey, grey, grey, np.full_like(grey, 255)])
    return np.array(image.convert("RGBA"))


def encoded(pixels: ByteArray) -> bytes:
    """A PNG of a picture (H, W, 4): every byte comes back; alpha is left out where all is opaque."""
    opaque = bool((pixels[..., 3] == 255).all())
    return png_of(np.ascontiguousarray(pixels[..., :3] if opaque else pixels))
