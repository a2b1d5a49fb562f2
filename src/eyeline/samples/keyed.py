"""Curves for the samples' clips, written as (time, value) keys."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from eyeline.geometry.arrays import FloatArray
from eyeline.motion.curve import Curve
from eyeline.motion.track import Track

Key = tuple[float, npt.ArrayLike]


def flowing(keys: Sequence[Key]) -> Curve:
    """Through all keys without overshooting; at rest at both ends and wherever it turns back. [Fritsch80]"""
    times, values, slopes = rows(keys)
    return hermite(times, values, slopes, slopes)


def turning(axis: npt.ArrayLike, keys: Sequence[Key]) -> Curve:
    """Turns about one unit axis (3,) through angles in radians, as `flowing`."""
    times, angles, slopes = rows(keys)
    x, y, z = np.asarray(axis, dtype=np.float64)
    sine, cosine = np.sin(angles / 2)[:, None], np.cos(angles / 2)[:, None]
    turn = np.hstack([sine * (x, y, z), cosine])
    speed = slopes[:, None] / 2 * np.hstack([cosine * (x, y, z), -sine])
    return Curve(times, np.stack([speed, turn, speed], axis=1), "cubic", rotation=True)


def hermite(times: FloatArray, values: FloatArray, slopes_in: FloatArray, slopes_out: FloatArray) -> Curve:
    """A cubic through values (K, ...) with the speeds it arrives and leaves with."""
    return Curve(times, np.stack([slopes_in, values, slopes_out], axis=1), "cubic")


def rows(keys: Sequence[Key]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Times (K,), values (K, ...) and slopes (K, ...) of keys."""
    times = np.array([time for time, _ in keys], dtype=np.float64)
    values = np.array([value for _, value in keys], dtype=np.float64)
    slopes = np.zeros_like(values)
    gaps = np.diff(times).reshape(-1, *[1] * (values.ndim - 1))
    steps = np.diff(values, axis=0) / gaps
    before, after = steps[:-1], steps[1:]
    # The weighted harmonic mean of the two sides keeps the cubic between its keys
    w, u = 2 * gaps[1:] + gaps[:-1], gaps[1:] + 2 * gaps[:-1]
    onward = before * after > 0
    sides = np.where(onward, before, 1), np.where(onward, after, 1)
    slopes[1:-1] = np.where(onward, (w + u) / (w / sides[0] + u / sides[1]), 0)
    return times, values, slopes


def moves(path: str, keys: Sequence[Key], property_name: str = "translation") -> Track:
    """A track that carries a node, or another of its properties, through keys."""
    return Track("node", path, property_name, flowing(keys))


def swings(path: str, keys: Sequence[Key], axis: npt.ArrayLike = (0, 0, 1)) -> Track:
    """A track that turns a node about an axis, through angles in degrees."""
    return Track("node", path, "rotation", turning(axis, [(time, np.radians(angle)) for time, angle in keys]))
