"""What each frame of a layer shows: a drawing, an in-between of two, or nothing."""

from __future__ import annotations

import re
from collections.abc import Mapping
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
    shown: list[Exposure | None] = [None] * ((starts[0] if starts else frames + 1) - 1)
    for place, start in enumerate(starts):
        end = starts[place + 1] if place + 1 < len(starts) else frames + 1
        words = cells[start]
        if found := REPEAT.fullmatch(words):
            shown += repeated(shown, int(found[1]), int(found[2]), start, end)
        else:
            shown += [one_exposure(cells, starts, place)] * (end - start)
    return tuple(shown)


def one_exposure(cells: Mapping[int, str], starts: list[int], place: int) -> Exposure | None:
    """What is shown from the frame at this place of `starts`."""
    words = cells[starts[place]]
    if words.lower() == BLANK:
        return None
    found = INBETWEEN.fullmatch(words)
    if not found:
        return Exposure(words)
    before = max((k for k in range(place) if is_drawing(cells[starts[k]])), default=None)
    after = min((k for k in range(place, len(starts)) if is_drawing(cells[starts[k]])), default=None)
    others = range((before or 0) + 1, after or 0)
    if before is None or after is None or not all(INBETWEEN.fullmatch(cells[starts[k]]) for k in others):
        raise FileError(f"frame {starts[place]} is an in-between, but not between two drawings")
    first, last = starts[before], starts[after]
    part = float(found[1]) / 100 if found[1] else (starts[place] - first) / (last - first)
    return Exposure(cells[first], cells[last], part)


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
