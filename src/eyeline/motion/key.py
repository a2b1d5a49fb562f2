"""One key as an animator writes it, and many as a curve takes them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from eyeline.errors import SceneError
from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.curve import Interpolation, KeyKind
from eyeline.motion.easing import EASINGS, Easing, easing

Handle = tuple[npt.ArrayLike, npt.ArrayLike]  # seconds and value, both beside the key
SETTLE = EASINGS["ease_out_sine"]


@dataclass(frozen=True, eq=False)
class Key:
    """A value, and how it goes on to the next key; what is left out is as the curve says.

    in_handle, out_handle: of a bezier, (seconds, value) beside the key, seconds negative for the one that
    comes in; a segment with a handle at either end is a bezier unless its key says otherwise. in_tangent,
    out_tangent: of a cubic, per second. hold: a moving hold for so many seconds: the value drifts on by the
    part `drift` of the way it came, so that what rests does not freeze.
    """

    value: npt.ArrayLike
    ease: str | Easing | None = None
    kind: KeyKind = "key"
    interpolation: Interpolation | None = None
    in_handle: Handle | None = None
    out_handle: Handle | None = None
    in_tangent: npt.ArrayLike | None = None
    out_tangent: npt.ArrayLike | None = None
    hold: float = 0.0
    drift: float = 0.05

    def __post_init__(self) -> None:
        """Refuse a hold that lasts less than no time."""
        if not (np.isfinite(self.hold) and self.hold >= 0):
            raise SceneError(f"a key holds for {self.hold} s; 0 or more is needed")
        if not np.isfinite(self.drift):
            raise SceneError(f"a moving hold drifts by {self.drift}; a part of the way it came is needed")


def columns(
    keys: Mapping[float, npt.ArrayLike | Key] | Iterable[tuple[float, npt.ArrayLike | Key]],
    ease: Easing,
    interpolation: Interpolation,
    rotation: bool,
) -> dict[str, Any]:
    """What `Curve` takes, from keys as people write them."""
    pairs = list(keys.items()) if isinstance(keys, Mapping) else list(keys)
    written = [(time, key if isinstance(key, Key) else Key(key)) for time, key in pairs]
    times, values, rows = _held(*_read(written), [key for _, key in written], rotation)
    ways = _ways(rows, interpolation)
    made: dict[str, Any] = {
        "times": times,
        "values": values,
        "interpolation": ways,
        "ease": [_ease(key, ease, way) for key, way in zip(rows, ways, strict=True)],
        "kinds": [key.kind for key in rows],
    }
    if "bezier" in ways:
        made["handles"] = _handles(rows, values.shape[1:])
    if "cubic" in ways:
        tangents = [[_tangent(key, side, values.shape[1:]) for key in rows] for side in ("in", "out")]
        made["values"] = np.stack([np.array(tangents[0]), values, np.array(tangents[1])], axis=1)
    return made


def _read(rows: list[tuple[float, Key]]) -> tuple[FloatArray, FloatArray]:
    """Times (K,) and values (K, ...), all of one shape."""
    if not rows:
        raise SceneError("a curve of no keys; one key or more is needed")
    try:
        times = np.array([float(time) for time, _ in rows])
        values = [np.asarray(key.value, dtype=np.float64) for _, key in rows]
    except (TypeError, ValueError) as error:
        raise SceneError(f"a key cannot be read: {error}; times and values are numbers") from None
    for index, value in enumerate(values):
        if value.shape != values[0].shape:
            raise SceneError(
                f"key {index} has a value of shape {value.shape}, key 0 of {values[0].shape}; one is needed"
            )
    return times, np.array(values)


def _held(
    times: FloatArray, values: FloatArray, rows: list[Key], rotation: bool
) -> tuple[FloatArray, FloatArray, list[Key]]:
    """Every moving hold as two keys: where it begins, and where it has drifted to when it ends."""
    ends: list[tuple[float, FloatArray, Key]] = []
    for index, (time, value, key) in enumerate(zip(times, values, rows, strict=True)):
        if key.hold == 0:
            ends.append((time, value, key))
            continue
        before = values[max(index - 1, 0)]
        begin = replace(key, kind="moving_hold", ease=SETTLE, interpolation="linear", out_handle=None)
        end = replace(key, kind="moving_hold", in_handle=None, in_tangent=None, hold=0.0)
        ends.append((time, value, begin))
        ends.append((time + key.hold, _drifted(before, value, key.drift, rotation), end))
    return (
        np.array([time for time, _, _ in ends]),
        np.array([value for _, value, _ in ends]),
        [key for _, _, key in ends],
    )


def _drifted(before: FloatArray, value: FloatArray, part: float, rotation: bool) -> FloatArray:
    """A value that has gone on by a part of the way from the one before."""
    if not rotation:
        return value + part * (value - before)
    first, last = quaternion.normalized(before), quaternion.normalized(value)
    if (first * last).sum() < 0:
        first = -first
    return quaternion.slerp(first, last, 1 + part)


def _ways(rows: list[Key], usual: Interpolation) -> list[Interpolation]:
    ways: list[Interpolation] = []
    for index, key in enumerate(rows):
        following = rows[index + 1] if index + 1 < len(rows) else None
        handled = key.out_handle is not None or (following is not None and following.in_handle is not None)
        ways.append(key.interpolation or ("bezier" if handled else usual))
    return ways


def _ease(key: Key, usual: Easing, way: str) -> Easing:
    """A key's own easing; the usual one only where it can have an effect."""
    if key.ease is not None:
        return easing(key.ease)
    return EASINGS["linear"] if way in ("bezier", "step") else usual


def _handles(rows: list[Key], shape: tuple[int, ...]) -> FloatArray:
    """(K, 2, 2, ...), NaN where none is given."""
    handles = np.full((len(rows), 2, 2, *shape), np.nan)
    for index, key in enumerate(rows):
        for side, handle in enumerate((key.in_handle, key.out_handle)):
            if handle is None:
                continue
            try:
                handles[index, side, 0], handles[index, side, 1] = handle
            except (TypeError, ValueError):
                raise SceneError(
                    f"a handle of key {index} is {handle!r}; (seconds, value of shape {shape}) is needed"
                ) from None
    return handles


def _tangent(key: Key, side: str, shape: tuple[int, ...]) -> FloatArray:
    given = key.in_tangent if side == "in" else key.out_tangent
    if given is None:
        return np.zeros(shape)
    tangent: FloatArray = np.asarray(given, dtype=np.float64)
    if tangent.shape != shape:
        raise SceneError(f"an {side} tangent has shape {tangent.shape}; {shape} is needed")
    return tangent
