"""Curves as the format knows them: STEP, LINEAR and CUBICSPLINE, exact where that can be. [glTF 2.0, C]

A curve is asked for its values, not for the way it is made: any kind of curve can be written, and one whose
every piece is a cubic, however its author calls it, is written without loss.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from eyeline.files.gltf.writing.fitting import fewest_keys
from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.curve import Curve

PIECES = 64  # samples between two keys that a curve is fitted through
LONGEST_STEP = 1 / 60  # seconds between samples, at most
ROUNDING = float(np.finfo(np.float32).eps) / 16  # of the greatest value: lost in the format's 32 bits anyway
HALVINGS = 5  # of the time between samples, twice each, where a curve bends
UNSEEN = 1 / 4  # of the tolerance: what a curve may do between two samples
QUARTERS = np.array([0.25, 0.5, 0.75])  # of the time between samples: where it is looked whether it bends
INSIDE = np.array([1, 2]) / 3  # of a piece: where, with its ends, a cubic is read off
BETWEEN = np.array([0.1, 0.45, 0.7, 0.9])  # of a piece: where it is checked to be one

Change = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True, eq=False)
class Fitted:
    """A curve of the format's own kinds, and how far it may be from the one it stands for."""

    curve: Curve
    error: float = 0.0  # of any number, in the property's unit; 0: exact but for rounding to 32 bits


def as_gltf(curve: Curve, duration: float, tolerance: float, change: Change | None = None) -> Fitted:
    """The curve from 0 to `duration`, seconds, with keys at times the format can hold.

    tolerance: as a part of the range of the values, of 1 for turns.
    change: what is done to every value first.
    """
    fits = curve.times[0] >= 0 and _apart(curve.times) and not _is_loose(curve)
    if change is None and curve.is_plain and fits:
        return Fitted(_shortened(curve))
    if change is None and not curve.rotation:
        cubic = _as_cubic(curve, duration)
        if cubic is not None:
            return Fitted(cubic)
    return _sampled(curve, duration, tolerance, change)


def _shortened(curve: Curve) -> Curve:
    """A spline of one key as that key: the format asks for two."""
    if curve.interpolation != "cubic" or len(curve.times) > 1:
        return curve
    return Curve(curve.times, curve.values[:, 1], "step", curve.rotation)


def _apart(times: FloatArray) -> bool:
    """Whether key times stay apart in 32 bits."""
    return bool((np.diff(times.astype(np.float32)) > 0).all())


def _is_loose(curve: Curve) -> bool:
    """Whether a spline's turns have other lengths than one, which the format does not take."""
    if not curve.rotation or curve.interpolation != "cubic":
        return False
    lengths = np.sqrt(np.square(curve.values[:, 1]).sum(axis=1))
    return bool((np.abs(lengths - 1) > np.finfo(np.float32).eps * 4).any())


def _holds(curve: Curve, duration: float) -> bool:
    """Whether it stands still before its first key and after its last, as the format's curves do."""
    first, last = float(curve.times[0]), float(curve.times[-1])
    before, after = np.linspace(0, first, PIECES + 1), np.linspace(last, max(duration, last), PIECES + 1)
    still = first <= 0 or (curve.at(before) == curve.at([first])).all()
    return bool(still and (curve.at(after) == curve.at([last])).all())


def _as_cubic(curve: Curve, duration: float) -> Curve | None:
    """The curve as a spline with its own keys; None if a piece of it is no cubic."""
    times = curve.times.astype(np.float32).astype(np.float64)
    if len(times) < 2 or times[0] < 0 or not _apart(times) or not _holds(curve, duration):
        return None
    starts, gaps = curve.times[:-1], np.diff(curve.times)
    width = max(curve.width, 1)

    def at(parts: FloatArray) -> FloatArray:
        """(pieces, parts, width) inside every piece."""
        return curve.at(starts[:, None] + gaps[:, None] * parts).reshape(len(starts), len(parts), width)

    values = curve.at(curve.times).reshape(-1, width)
    a, b = values[:-1], values[1:]
    p, q = at(INSIDE).transpose(1, 0, 2)
    # The slopes, in units of a piece, at both ends of the cubic through a, p, q, b
    out = -5.5 * a + 9 * p - 4.5 * q + b
    into = -a + 4.5 * p - 9 * q + 5.5 * b
    u = BETWEEN[:, None]
    near, far = (1 + 2 * u) * (1 - u) ** 2, u * u * (3 - 2 * u)
    cubic = near * a[:, None] + far * b[:, None]
    cubic += u * (1 - u) ** 2 * out[:, None] + u * u * (u - 1) * into[:, None]
    reach = ROUNDING * np.abs(cubic).max(initial=0.0)
    if not (np.abs(cubic - at(BETWEEN)) <= reach).all():
        return None
    ends = np.zeros((1, width))
    slopes_in = np.concatenate([ends, into / gaps[:, None]])
    slopes_out = np.concatenate([out / gaps[:, None], ends])
    keys = np.stack([slopes_in, values, slopes_out], axis=1)
    return Curve(times, keys.reshape(len(times), 3, *curve.shape), "cubic")


def _sampled(curve: Curve, duration: float, tolerance: float, change: Change | None) -> Fitted:
    """The fewest straight pieces within the tolerance, through samples so close that no bend is missed."""

    def at(times: FloatArray) -> FloatArray:
        values = curve.at(times)
        return values if change is None else change(values)

    times = sample_times(curve, duration)
    values = at(times)
    for _ in range(HALVINGS):
        rows = _rows(values, curve.rotation)
        inside = (times[:-1, None] + np.diff(times)[:, None] * QUARTERS).astype(np.float32).astype(np.float64)
        found = at(inside.reshape(-1)).reshape(*inside.shape, -1)
        straight = rows[:-1, None] + QUARTERS[:, None] * np.diff(rows, axis=0)[:, None]
        if curve.rotation:
            # The same turn has two signs
            found = found * np.where((found * straight).sum(axis=2) < 0, -1.0, 1.0)[..., None]
        bent = (np.abs(found - straight) > UNSEEN * tolerance * _span(rows, curve.rotation)).any(axis=(1, 2))
        if not bent.any():
            break
        times = np.unique(np.concatenate([times, inside[bent].reshape(-1)]))
        values = at(times)
    made = fitted(times, values, (1 - UNSEEN) * tolerance, curve.rotation)
    return Fitted(made.curve, made.error / (1 - UNSEEN))


def fitted(times: FloatArray, values: FloatArray, tolerance: float, turns: bool = False) -> Fitted:
    """Samples (S, ...) as the fewest straight pieces; tolerance: a part of their range, of 1 for turns."""
    rows = _rows(values, turns)
    error = tolerance * _span(rows, turns)
    kept = fewest_keys(times, rows, error, turns)
    return Fitted(Curve(times[kept], values[kept], "linear", rotation=turns), error)


def _rows(values: FloatArray, turns: bool) -> FloatArray:
    """(S, width) the values; turns of length one, each on the side of the one before."""
    rows = values.reshape(len(values), -1)
    if not turns:
        return rows
    rows = quaternion.normalized(rows)
    sides = np.where((rows[1:] * rows[:-1]).sum(axis=1) < 0, -1.0, 1.0)
    return rows * np.cumprod(np.concatenate([[1.0], sides]))[:, None]


def _span(rows: FloatArray, turns: bool) -> float:
    """What a tolerance is a part of."""
    return 1.0 if turns else float(np.ptp(rows, axis=0).max(initial=0.0))


def sample_times(curve: Curve, duration: float) -> FloatArray:
    """Times the format can hold, dense between keys, with the last moment before each: there it may jump."""
    ends = np.unique(np.clip([0.0, *curve.times, duration], 0, None))
    pieces = []
    for start, end in pairwise(ends):
        count = max(PIECES, int(np.ceil((end - start) / LONGEST_STEP)))
        pieces.append(np.linspace(start, end, count, endpoint=False))
    exact = np.concatenate([*pieces, ends[-1:]]).astype(np.float32)
    before = np.nextafter(ends.astype(np.float32), np.float32(0))
    found: FloatArray = np.unique(np.concatenate([exact, before])).astype(np.float64)
    return found


def switches(curve: Curve, duration: float) -> Curve:
    """Where a number crosses a half, as steps from 0 to 1 and back, to the last bit of time."""
    times = sample_times(curve, duration)
    shown = curve.at(times) > 0.5
    at = np.flatnonzero(shown[1:] != shown[:-1])
    low, high = times[at].astype(np.float32), times[at + 1].astype(np.float32)
    while True:
        middle = ((low.astype(np.float64) + high) / 2).astype(np.float32)
        open_ = (middle > low) & (middle < high)
        if not open_.any():
            break
        same = (curve.at(middle) > 0.5) == shown[at]
        low, high = np.where(open_ & same, middle, low), np.where(open_ & ~same, middle, high)
    keys = np.concatenate([[0.0], high[high > 0]]).astype(np.float64)
    return Curve(keys, np.concatenate([shown[:1], shown[at + 1][high > 0]]).astype(np.float64), "step")
