"""The depth buffer's working memory: bins of fragments and records, kept from call to call.

Memory that is touched for the first time costs more than the work done in it. Whoever calls takes a Scratch
from the shelf and puts it back, so two callers at once never share one.
"""

from __future__ import annotations

from collections import deque
from typing import NamedTuple

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.visibility.binning import BLOCK

PADDING = 16  # int64: no two threads write one cache line

_shelf: deque[Scratch] = deque(maxlen=2)


class Scratch(NamedTuple):
    """Bins of every part and band: P parts, B bands, N blocks, R records."""

    ends: IntArray  # (P, B + PADDING) int64, where a band's bin ends; 0 is an empty bin
    previous: IntArray  # (P, N) int64, the end of the block before each block of a chain
    pixels: IntArray  # (P, N * BLOCK) int32, y << 16 | x of a fragment, or RECORD
    keys: IntArray  # (P, N * BLOCK) int64, depth bits << 32 | ~face of a fragment, or the number of a record
    corners: IntArray  # (P, 6 R) int32, x y of three corners, clockwise
    planes: FloatArray  # (P, 3 R) float64, the depth's a b c
    sources: IntArray  # (P, R) int32, scene faces


def take(parts: int, bands: int, faces: int) -> Scratch:
    """A scratch for so many parts, bands and faces that nobody else uses."""
    for _ in range(len(_shelf)):
        try:
            found = _shelf.popleft()
        except IndexError:
            break
        if found.ends.shape == (parts, bands + PADDING):
            return found
    return made(parts, bands, 64 + bands + 2 * faces // (parts * BLOCK), 1024 + faces // (4 * parts))


def give_back(scratch: Scratch) -> None:
    """Put a scratch on the shelf; the oldest of too many falls off."""
    _shelf.append(scratch)


def grown(scratch: Scratch, blocks: int, records: int) -> Scratch | None:
    """A scratch with so many blocks and records and some more; None if this one has them."""
    room, record_room = scratch.previous.shape[1], scratch.sources.shape[1]
    if blocks <= room and records <= record_room:
        return None
    parts, bands = scratch.ends.shape[0], scratch.ends.shape[1] - PADDING
    return made(parts, bands, max(room, blocks + blocks // 4), max(record_room, records + records // 4))


def made(parts: int, bands: int, blocks: int, records: int) -> Scratch:
    """A new scratch; what of it is never touched takes no memory."""
    return Scratch(
        np.empty((parts, bands + PADDING), np.int64),
        np.empty((parts, blocks), np.int64),
        np.empty((parts, blocks * BLOCK), np.int32),
        np.empty((parts, blocks * BLOCK), np.int64),
        np.empty((parts, 6 * records), np.int32),
        np.empty((parts, 3 * records), np.float64),
        np.empty((parts, records), np.int32),
    )
