"""The spans of one row, to be read: who is in front, for how long, and who is compared for that."""

from __future__ import annotations

import heapq
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from eyeline.visibility.scanline.overtaking import overtaken
from eyeline.visibility.scanline.segments import Segment

Hidden = list[tuple[float, tuple[int, int], Segment]]  # a heap, the greatest depth on top


@dataclass(frozen=True)
class Stretch:
    """Columns over which one segment is in front; none is background."""

    front: Segment | None
    first: int
    last: int
    rivals: list[Segment]  # what it met at its first column
    comparisons: int
    coherent: bool = False  # it was in front before
    overtakes: Segment | None = None  # what it came through


class Front(NamedTuple):
    """The segment in front, up to where it is known to be, and its least depth from here on."""

    segment: Segment
    until: int
    least: np.float32


def spans_of_row(segments: list[Segment], width: int) -> Iterator[Stretch]:
    """Sweep a row: where a segment begins, or the front ends or is overtaken, see who is nearest."""
    waiting: defaultdict[int, list[Segment]] = defaultdict(list)
    for segment in segments:
        waiting[segment.first].append(segment)
    hidden: Hidden = []
    front: Front | None = None
    overtook: Segment | None = None
    x = 0
    while x < width:
        rivals, coherent, comparisons = waiting.pop(x, []), front is not None, 0
        if front is None:
            leader = greatest(rivals, hidden, x)
            if leader is not None:
                rivals = [rival for rival in rivals if rival is not leader]
                front = risen(leader, rivals, hidden, x)
        while front is not None:
            front, rivals, nearest, tries = contest(front, rivals, x)
            comparisons += tries
            if nearest is None:
                break
            # Somebody is nearer at this very column: the nearest of them comes to the front
            rivals = [front.segment if rival is nearest else rival for rival in rivals]
            coherent, front = False, risen(nearest, rivals, hidden, x)
        for rival in rivals:
            heapq.heappush(hidden, (-rival.near, rival.number, rival))
        stop = min([front.until if front else width, *waiting])
        leading = front.segment if front else None
        yield Stretch(leading, x, stop - 1, rivals, comparisons, coherent, overtook)
        overtook, x = None, stop
        if front is not None and x == front.until:
            if x <= front.segment.last:
                overtook = front.segment
                heapq.heappush(hidden, (-overtook.near, overtook.number, overtook))
            front = None


def greatest(beginning: list[Segment], hidden: Hidden, x: int) -> Segment | None:
    """The segment of the greatest depth, of those that begin and those that were hidden so far."""
    while hidden and hidden[0][2].last < x:
        heapq.heappop(hidden)
    every = [(-segment.near, segment.number, segment) for segment in beginning] + hidden[:1]
    if not every:
        return None
    best = min(every)
    if hidden and best is hidden[0]:
        heapq.heappop(hidden)
    return best[2]


def risen(segment: Segment, rivals: list[Segment], hidden: Hidden, x: int) -> Front:
    """A segment comes to the front at x; hidden ones that reach its least depth become its rivals."""
    least = min(segment.depth(x), segment.depth(segment.last))
    while hidden and -hidden[0][0] >= least:
        rival = heapq.heappop(hidden)[2]
        if rival.last >= x:
            rivals.append(rival)
    return Front(segment, segment.last + 1, least)


def contest(front: Front, rivals: list[Segment], x: int) -> tuple[Front, list[Segment], Segment | None, int]:
    """Compare the front with its rivals from x on: until where it leads, who goes on, who is nearer at x.

    The last is how many comparisons that took. A rival goes on if it is nearer somewhere, or ends later.
    """
    own, until, tries = front.segment, front.until, 0
    going, nearer = [], []
    for rival in rivals:
        end = min(rival.last, own.last)
        meets = end + 1
        if rival.near >= front.least:
            lower = own.number < rival.number
            meets, count = overtaken(own.slope, own.k, rival.slope, rival.k, lower, x, end)
            tries += count
        if meets <= end or rival.last > own.last:
            going.append(rival)
        if meets <= end:
            until = min(until, meets)
        if meets == x:
            nearer.append(rival)
    nearest = min(nearer, key=lambda rival: (-rival.depth(x), rival.number), default=None)
    return Front(own, until, front.least), going, nearest, tries
