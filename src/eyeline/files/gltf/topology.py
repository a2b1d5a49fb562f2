"""Triangles out of what primitives list: single ones, strips and fans. [glTF 2.0, 3.7.2.1]"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.arrays import IntArray

POINTS, LINES, LINE_LOOP, LINE_STRIP, TRIANGLES, STRIP, FAN = range(7)
UNDRAWN = {POINTS: "points", LINES: "lines", LINE_LOOP: "a line loop", LINE_STRIP: "a line strip"}


def triangles(corners: IntArray, mode: int) -> IntArray:
    """(F, 3) faces over the corners (N,) of a primitive; corners left over make no face."""
    if mode == TRIANGLES:
        return corners[: len(corners) // 3 * 3].reshape(-1, 3)
    count = max(len(corners) - 2, 0)
    first = np.arange(count)
    if mode == FAN:
        return np.stack([corners[first + 1], corners[first + 2], np.broadcast_to(corners[:1], count)], axis=1)
    # Every second face of a strip turns the other way round: its last two corners change places
    odd = first % 2
    return np.stack([corners[first], corners[first + 1 + odd], corners[first + 2 - odd]], axis=1)


def left_over(count: int, mode: int) -> int:
    """How many corners make no face."""
    if mode == TRIANGLES:
        return count % 3
    return count if count < 3 else 0
