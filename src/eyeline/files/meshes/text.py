"""Text of a model file, and numbers in it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from eyeline.errors import FileError
from eyeline.geometry.arrays import FloatArray


def text_of(path: Path) -> str:
    """The file as text; bytes that are no UTF-8 are taken for Latin-1, as old exporters write names."""
    data = path.read_bytes()
    if not data.strip():
        raise FileError("is empty; export the model again")
    if b"\0" in data[:4096]:
        raise FileError("is not a text file; its suffix may be wrong")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def numbers(texts: Sequence[str], kind: str) -> FloatArray:
    """All numbers in some lines, one after the other, float64; `kind` and the row are named in a refusal."""
    try:
        return np.fromiter(map(float, " ".join(texts).split()), dtype=np.float64)
    except ValueError:
        pass
    for row, text in enumerate(texts):
        try:
            list(map(float, text.split()))
        except ValueError as error:
            raise FileError(f"{kind} {row} is {shortened(text)!r}; numbers are needed") from error
    raise FileError(f"{kind} rows hold something that is no number")


def shortened(text: str, most: int = 40) -> str:
    """At most so many characters of a text, for a sentence."""
    return text if len(text) <= most else text[: most - 3] + "..."
