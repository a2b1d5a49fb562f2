"""Small pictures for models."""

from __future__ import annotations

import io

import numpy as np
from PIL import Image


def picture(
    color: tuple[int, ...], kind: str = "PNG", size: tuple[int, int] = (2, 2), mode: str = "RGBA"
) -> bytes:
    """A picture of one colour, encoded."""
    file = io.BytesIO()
    Image.new(mode, size, color).save(file, kind, **({"lossless": True} if kind == "WEBP" else {}))
    return file.getvalue()


def png(color: tuple[int, ...]) -> bytes:
    return picture(color)


def encoded(pixels: np.ndarray, kind: str = "PNG") -> bytes:
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, kind)
    return file.getvalue()
