"""The corners of an OBJ file's faces as numbers: point, texture place, normal."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from eyeline.errors import FileError
from eyeline.files.meshes.text import shortened
from eyeline.geometry.arrays import FloatArray, IntArray


def corner_table(faces: Sequence[str]) -> tuple[IntArray, IntArray]:
    """(corners, counts): (C, 3) numbers of point, uv and normal, 0 for none; (P,) corners a face."""
    tokens = [face.split() for face in faces]
    counts = np.array([len(corners) for corners in tokens], dtype=np.int64)
    flat = [corner for corners in tokens for corner in corners]
    try:
        if not any("/" in face for face in faces):
            points = np.array(list(map(int, flat)), dtype=np.int64)
            return np.stack([points, 0 * points, 0 * points], axis=1), counts
        numbers = np.array(list(map(int, "/".join(map(whole, flat)).split("/"))), dtype=np.int64)
        return numbers.reshape(-1, 3), counts
    except (ValueError, OverflowError):
        raise broken(flat, counts) from None


def whole(corner: str) -> str:
    """A corner with all its three numbers: 7, 7/1, 7//2 and 7/1/2 are all allowed."""
    slashes = corner.count("/")
    if slashes < 2:
        corner += "/0" * (2 - slashes)
    return corner.replace("//", "/0/") if "//" in corner else corner


def broken(flat: Sequence[str], counts: IntArray) -> FileError:
    """What is wrong with the first corner that is no three numbers."""
    for place, corner in enumerate(flat):
        parts = whole(corner).split("/")
        if len(parts) != 3 or not all(part.isdecimal() and len(part) < 19 for part in parts):
            face = int(np.searchsorted(np.cumsum(counts), place, side="right"))
            return FileError(
                f"face {face} has the corner {shortened(corner)!r}; numbers as in 7/1/2 are needed"
            )
    return FileError("has a face whose corners are no numbers; export it again")


def chosen(corners: IntArray, count: int, kind: str, face_of: IntArray) -> IntArray:
    """Numbers from 1 (C,) as indices from 0, checked against the count of what they name."""
    bad = (corners < 1) | (corners > count)
    if bad.any():
        at = int(np.flatnonzero(bad)[0])
        raise FileError(f"face {face_of[at]} names {kind} {corners[at]}; there are {count}, numbered from 1")
    return corners - 1


def columns(values: FloatArray, rows: Sequence[str], least: int, kind: str) -> FloatArray:
    """Numbers of lines as a table (N, K) of the columns that all lines have; refuses a line with too few."""
    if not rows:
        return np.zeros((0, least))
    width = len(values) // len(rows)
    counts = np.array([len(row.split()) for row in rows])
    if (counts < least).any():
        row = int(np.flatnonzero(counts < least)[0])
        raise FileError(f"{kind} {row} has {counts[row]} numbers; {least} are needed")
    if (counts == width).all():
        return values.reshape(-1, width)
    first = np.cumsum(counts) - counts
    kept: FloatArray = values[first[:, None] + np.arange(counts.min())]
    return kept
