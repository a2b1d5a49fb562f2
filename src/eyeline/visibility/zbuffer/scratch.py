"""The depth buffer's working memory: bins of fragments and records, kept from call to call.

Memory that is touched for the first time costs more than the work done in it. Whoever calls takes a Scratch
from the shelf and puts it back, so two callers at once never share one.
"""

from __future__ import annotations

from collections import deque
from typing import NamedTuple

import numpy as np

from eyeline.geometry.arrays import IntArray
from eyeline.visibility.zbuffer.binning import BAND_BITS, BLOCK, WORDS

LINE = 8  # int64: a cache line
PADDING = 2 * LINE  # no two threads write one cache line

_shelf: deque[Scratch] = deque(maxlen=2)


class Scratch(NamedTuple):
    """Bins of every part and band: P parts, B bands, N blocks, R records."""

    ends: IntArray  # (P, B + PADDING) int64, where a band's bin ends; 0 is an empty bin
    previous: IntArray  # (P, N) int64, the end of the block before each block of a chain
    pixels: IntArray  # (P, N * BLOCK) int32, y << 16 | x of a fragment, or RECORD
    keys: IntArray  # (P, N * BLOCK) int64, depth bits << 32 | ~face of a fragment, or the number of a record
    records: IntArray  # (P, WORDS * R) int64
    buffer: IntArray  # (P, rows of a band * pitch) int64, 0 between calls; every row begins a cache line


def take(parts: int, size: tuple[int, int], faces: int) -> Scratch:
    """A scratch for so many parts, a picture of this size and so many faces, that nobody else uses."""
    for _ in range(len(_shelf)):
        try:
            found = _shelf.popleft()
        except IndexError:
            break
        if (found.ends.shape, found.buffer.shape) == shapes(parts, size):
            return found
    blocks = 64 + (size[1] >> BAND_BITS) + 2 * faces // (parts * BLOCK)
    return made(parts, size, blocks, 1024 + faces // (4 * parts))


def give_back(scratch: Scratch) -> None:
    """Put a scratch on the shelf; the oldest of too many falls off."""
    _shelf.append(scratch)


def grown(scratch: Scratch, blocks: int, records: int) -> Scratch | None:
    """A scratch with so many blocks and records and some more; None if this one has them."""
    room, record_room = scratch.previous.shape[1], scratch.records.shape[1] // WORDS
    if blocks <= room and records <= record_room:
        return None
    room, record_room = max(room, blocks + blocks // 4), max(record_room, records + records // 4)
    return Scratch(scratch.ends, *bins(len(scratch.ends), room, record_room), scratch.buffer)


def made(parts: int, size: tuple[int, int], blocks: int, records: int) -> Scratch:
    """A new scratch for pictures of this size."""
    of_ends, of_buffer = shapes(parts, size)
    return Scratch(np.empty(of_ends, np.int64), *bins(parts, blocks, records), cleared(*of_buffer))


def shapes(parts: int, size: tuple[int, int]) -> tuple[tuple[int, int], tuple[int, int]]:
    """Of the ends and the buffer for pictures of this size."""
    width, height = size
    # A row has a line more than its pixels need: from any line of theirs on, two can be drawn at once
    pitch = (-(-width // LINE) + 1) * LINE
    return (parts, ((height - 1) >> BAND_BITS) + 1 + PADDING), (parts, pitch << BAND_BITS)


def bins(parts: int, blocks: int, records: int) -> tuple[IntArray, IntArray, IntArray, IntArray]:
    """Room for so many blocks and records; what of it is never touched takes no memory."""
    return (
        np.empty((parts, blocks), np.int64),
        np.empty((parts, blocks * BLOCK), np.int32),
        np.empty((parts, blocks * BLOCK), np.int64),
        cleared(parts, WORDS * records),
    )


def cleared(parts: int, keys: int) -> IntArray:
    """(parts, keys) int64 zeros that begin at a cache line."""
    memory = np.zeros(parts * keys + LINE, dtype=np.int64)
    first = -memory.ctypes.data // memory.itemsize % LINE
    return memory[first : first + parts * keys].reshape(parts, keys)
