"""Samples to the fewest straight pieces that stay within a tolerance."""

from __future__ import annotations

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray

STRIDE = 8  # samples that the search for the end of a piece begins with


def fewest_keys(times: FloatArray, values: FloatArray, tolerance: float, turns: bool = False) -> IntArray:
    """Which samples to keep, so that straight ways between them miss no other by more than `tolerance`.

    times: (S,) seconds, rising. values: (S, width); turns: unit quaternions, each on the side of the one
    before, which turn between two keys along the arc. Each piece reaches as far as it can before the next
    begins: its end is found by doubling, then halving. The error is the greatest of any number.
    """
    kept = [0]
    last = len(times) - 1
    while kept[-1] < last:
        first = kept[-1]
        low, step = first + 1, STRIDE
        high = min(first + step, last)
        while _straight(times, values, first, high, tolerance, turns):
            low = high
            if high == last:
                break
            step *= 2
            high = min(first + step, last)
        while high - low > 1:
            middle = (low + high) // 2
            if _straight(times, values, first, middle, tolerance, turns):
                low = middle
            else:
                high = middle
        kept.append(low)
    return np.array(kept)


def _straight(
    times: FloatArray, values: FloatArray, first: int, last: int, tolerance: float, turns: bool
) -> bool:
    """Whether the straight way from one sample to another passes all between them."""
    part = (times[first + 1 : last] - times[first]) / (times[last] - times[first])
    a, b = values[first], values[last]
    way = arc(a, b, part) if turns else a + part[:, None] * (b - a)
    return bool((np.abs(way - values[first + 1 : last]) <= tolerance).all())


def arc(a: FloatArray, b: FloatArray, part: FloatArray) -> FloatArray:
    """(S, 4) quaternions on the arc from a to b, at parts (S,) of it."""
    angle = np.arctan2(np.sqrt(np.square(b - a).sum()), np.sqrt(np.square(b + a).sum())) * 2
    if angle == 0:
        return np.tile(a, (len(part), 1))
    near, far = np.sin((1 - part) * angle), np.sin(part * angle)
    found: FloatArray = (near[:, None] * a + far[:, None] * b) / np.sin(angle)
    return found
