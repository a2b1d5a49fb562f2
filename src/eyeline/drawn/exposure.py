"""What each frame of a layer shows: a drawing, an in-between of two, or nothing."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Mapping
from itertools import pairwise
from typing import NamedTuple

from eyeline.errors import FileError

BLANK = "x"
INBETWEEN = re.compile(r"in-?between(?:\s+(\d+(?:\.\d+)?)\s*%)?", re.IGNORECASE)
REPEAT = re.compile(r"repeat\s+(\d{1,7})\s*-\s*(\d{1,7})", re.IGNORECASE)


class Exposure(NamedTuple):
    """A drawing, or what is between it and another one."""

    drawing: str
    towards: str = ""  # "" is no in-between
    part: float = 0.0  # of the way


def exposures(cells: Mapping[int, str], frames: int) -> tuple[Exposure | None, ...]:
    """What every frame shows, None for nothing; cells: what is written at some frames, from 1.

    An empty cell holds the drawing before. `x` shows nothing. `inbetween` is made between the drawings before
    and after, by how far along in time its frame is, or `inbetween 30%` so much of the way. `repeat 1-8`
    shows frames 1 to 8 again and again, until something else is written.
    """
    starts = sorted(frame for frame, words in cells.items() if words and frame <= frames)
    keys = [start for start in starts if is_drawing(cells[start])]
    breaks = [
        start for start in starts if not (is_drawing(cells[start]) or INBETWEEN.fullmatch(cells[start]))
    ]
    shown: list[Exposure | None] = [None] * ((starts[0] if starts else frames + 1) - 1)
    for start, end in pairwise([*starts, frames + 1]):
        words = cells[start]
        if found := REPEAT.fullmatch(words):
            shown += repeated(shown, int(found[1]), int(found[2]), start, end)
        elif found := INBETWEEN.fullmatch(words):
            first, last = neighbours(keys, breaks, start)
            part = float(found[1]) / 100 if found[1] else (start - first) / (last - first)
            shown += [Exposure(cells[first], cells[last], part)] * (end - start)
        else:
            shown += [Exposure(words) if is_drawing(words) else None] * (end - start)
    return tuple(shown)


def neighbours(keys: list[int], breaks: list[int], frame: int) -> tuple[int, int]:
    """The frames of the drawings before and after an in-between; only in-betweens lie between them."""
    after = bisect_left(keys, frame)
    if 0 < after < len(keys) and bisect_left(breaks, keys[after - 1]) == bisect_left(breaks, keys[after]):
        return keys[after - 1], keys[after]
    raise FileError(f"frame {frame} is an in-between, but not between two drawings")


def is_drawing(words: str) -> bool:
    """Whether a cell names a drawing."""
    return words.lower() != BLANK and not INBETWEEN.fullmatch(words) and not REPEAT.fullmatch(words)


def repeated(
    shown: list[Exposure | None], first: int, last: int, start: int, end: int
) -> list[Exposure | None]:
    """Frames first to last again and again, for frames start to end."""
    if not 1 <= first <= last < start:
        raise FileError(f"frame {start} repeats {first}-{last}; what is repeated must come before it")
    return [shown[first - 1 + k % (last - first + 1)] for k in range(end - start)]
