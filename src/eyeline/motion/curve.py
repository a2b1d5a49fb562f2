"""A value over time, given by keys."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
import numpy.typing as npt

from eyeline.cached import cached_property
from eyeline.errors import SceneError
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.bundle import Bundle

Interpolation = Literal["step", "linear", "cubic"]


@dataclass(frozen=True, eq=False)
class Curve:
    """Keys, and the way from one to the next; before the first and after the last it holds still.

    times: (K,) seconds, strictly increasing. values: (K, ...), one for each key; with "cubic"
    (K, 3, ...): the tangent that comes in, the value, the tangent that goes out, tangents per second.
    [glTF 2.0, appendix C.5] rotation: values are quaternions x y z w of any length but 0; "linear" turns
    along the shorter arc at constant speed, and every answer has length one.
    """

    times: FloatArray
    values: FloatArray
    interpolation: Interpolation = "linear"
    rotation: bool = False

    def __post_init__(self) -> None:
        """Refuse keys that make no curve."""
        times: FloatArray = np.ascontiguousarray(self.times, dtype=np.float64)
        values: FloatArray = np.ascontiguousarray(self.values, dtype=np.float64)
        if self.interpolation not in get_args(Interpolation):
            raise SceneError(f"interpolation is {self.interpolation!r}; step, linear or cubic is needed")
        _refuse_times(times)
        if len(np.atleast_1d(values)) != len(times):
            raise SceneError(
                f"there are {len(times)} key times for values of shape {values.shape}; one for each is needed"
            )
        if self.interpolation == "cubic" and (values.ndim < 2 or values.shape[1] != 3):
            raise SceneError(
                f"cubic values have shape {values.shape}; (keys, 3, ...), tangent value tangent, is needed"
            )
        finite = np.isfinite(values.reshape(len(times), -1)).all(axis=1)
        if not finite.all():
            raise SceneError(
                f"the value of key {int(np.flatnonzero(~finite)[0])} is not finite; every number must be"
            )
        if self.rotation:
            values = _turns(values, self.interpolation)
        object.__setattr__(self, "times", times)
        object.__setattr__(self, "values", values)

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of one value."""
        return self.values.shape[2 if self.interpolation == "cubic" else 1 :]

    @property
    def width(self) -> int:
        """How many numbers one value has."""
        return int(np.prod(self.shape, dtype=np.int64))

    def at(self, times: npt.ArrayLike) -> FloatArray:
        """Its values (T, ...) at times (T,), in seconds; at a key exactly the key's."""
        seconds = np.asarray(times, dtype=np.float64).reshape(-1)
        if not np.isfinite(seconds).all():
            raise SceneError("times hold a number that is not finite; seconds are needed")
        return self._bundle.at(seconds).reshape(len(seconds), *self.shape)

    @cached_property
    def _bundle(self) -> Bundle:
        return Bundle.of([self])


def _refuse_times(times: FloatArray) -> None:
    if times.ndim != 1 or len(times) == 0:
        raise SceneError(f"key times have shape {times.shape}; (keys,) with one key or more is needed")
    if not np.isfinite(times).all():
        raise SceneError(
            f"key {int(np.flatnonzero(~np.isfinite(times))[0])} has no finite time; seconds are needed"
        )
    late = np.flatnonzero(np.diff(times) <= 0)
    if len(late):
        key = int(late[0])
        raise SceneError(
            f"key {key + 1} is at {times[key + 1]} s, key {key} at {times[key]} s; times must increase"
        )


def _turns(values: FloatArray, interpolation: str) -> FloatArray:
    """Quaternions of length one, and each on the side of the one before, so that the way between is short.

    Splines keep their values as they are: tangents belong to them.
    """
    turns = values[:, 1] if interpolation == "cubic" and values.ndim > 1 else values
    if turns.ndim != 2 or turns.shape[1] != 4:
        raise SceneError(f"rotations have shape {turns.shape}; (keys, 4) is needed: x y z w")
    lengths = np.sqrt((turns * turns).sum(axis=1, keepdims=True))
    if not lengths.all():
        raise SceneError(
            f"the rotation of key {int(np.flatnonzero(lengths == 0)[0])} is 0 0 0 0; a turn is needed"
        )
    if interpolation == "cubic":
        return values
    turns = turns / lengths
    agrees = np.where((turns[1:] * turns[:-1]).sum(axis=1) < 0, -1.0, 1.0)
    kept: FloatArray = turns * np.cumprod(np.concatenate([[1.0], agrees]))[:, None]
    return kept
