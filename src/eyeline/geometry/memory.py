"""Arrays over memory that was used before: touching new memory costs more than drawing a small scene."""

from __future__ import annotations

import math
import weakref
from collections import deque
from typing import TypeVar

import numpy as np
import numpy.typing as npt

Number = TypeVar("Number", bound=np.generic)

GRAIN = 1 << 18  # bytes: sizes are rounded up to this, so that nearly equal ones serve each other
LEAST, MOST = 1 << 18, 1 << 26  # bytes: smaller and larger arrays are made anew

_shelf: deque[npt.NDArray[np.uint8]] = deque(maxlen=12)


def recycled(shape: tuple[int, ...], dtype: type[Number]) -> npt.NDArray[Number]:
    """An array like `np.empty`'s; its memory serves again when the last view of it is gone."""
    count = math.prod(shape)
    size = count * np.dtype(dtype).itemsize
    if not LEAST <= size <= MOST:
        return np.empty(shape, dtype)
    memory = taken(-(-size // GRAIN) * GRAIN)
    # With a memoryview between them NumPy does not see `memory` as the owner: every view keeps `lent` alive
    lent = np.frombuffer(memoryview(memory.data), dtype, count)
    weakref.finalize(lent, _shelf.append, memory).atexit = False
    return lent.reshape(shape)


def taken(size: int) -> npt.NDArray[np.uint8]:
    """Memory of exactly `size` bytes that nobody else has, from the shelf or new."""
    # The last given back first: of it most is still in the cache.
    # Another thread may take and put at any time; each step alone is safe
    for _ in range(len(_shelf)):
        try:
            memory = _shelf.pop()
        except IndexError:
            break
        if memory.nbytes == size:
            return memory
        _shelf.appendleft(memory)
    return np.empty(size, dtype=np.uint8)


def forget() -> None:
    """Give all memory on the shelf back: who measures memory begins with none."""
    _shelf.clear()
