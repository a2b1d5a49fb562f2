"""What keys must be to make a curve."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from eyeline.errors import SceneError
from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.easing import Easing


def refuse_times(times: FloatArray) -> None:
    """Key times are finite and increase."""
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


def refuse_values(times: FloatArray, values: FloatArray, cubic: bool) -> None:
    """There is one finite value for each key, with tangents where a segment is cubic."""
    if len(np.atleast_1d(values)) != len(times):
        raise SceneError(
            f"there are {len(times)} key times for values of shape {values.shape}; one for each is needed"
        )
    if cubic and (values.ndim < 2 or values.shape[1] != 3):
        raise SceneError(
            f"cubic values have shape {values.shape}; (keys, 3, ...), tangent value tangent, is needed"
        )
    finite = np.isfinite(values.reshape(len(times), -1)).all(axis=1)
    if not finite.all():
        raise SceneError(
            f"the value of key {int(np.flatnonzero(~finite)[0])} is not finite; every number must be"
        )


def refuse_ways(ways: Sequence[str], eases: Sequence[Easing], rotation: bool) -> None:
    """Each segment has one way to go, and only one thing that spreads it over its time."""
    for key, (way, ease) in enumerate(zip(ways, eases, strict=True)):
        if way == "squad" and not rotation:
            raise SceneError(
                f"key {key} goes on by squad, which turns; catmull_rom is its like for other values"
            )
        if way in ("bezier", "step") and ease.name != "linear":
            other = "handles shape it" if way == "bezier" else "it does not move"
            raise SceneError(f"key {key} goes on by {way} and is eased by {ease}; {other}: leave one out")


def refuse_handles(handles: FloatArray, shape: tuple[int, ...]) -> None:
    """Handles that come in lie before their keys, those that go out after; NaN is laid automatically."""
    if handles.shape != shape:
        raise SceneError(f"handles have shape {handles.shape}; {shape} is needed: in and out, time and value")
    if np.isinf(handles).any():
        raise SceneError(
            f"a handle of key {int(np.argwhere(np.isinf(handles))[0, 0])} is not finite; every number must be"
        )
    for side, (name, sign) in enumerate((("in", -1), ("out", 1))):
        wrong = np.argwhere(sign * handles[:, side, 0] < 0)
        if len(wrong):
            key = int(wrong[0, 0])
            time = float(handles[key, side, 0].reshape(-1)[np.ravel(sign * handles[key, side, 0] < 0)][0])
            order = "before" if sign < 0 else "after"
            raise SceneError(
                f"the {name} handle of key {key} lies {time} s beside it; it must be {order} the key"
            )


def turns(values: FloatArray, ways: Sequence[str]) -> tuple[FloatArray, FloatArray]:
    """Quaternions of length one, each on the side of the one before, so that the way between is short.

    A curve that is a spline throughout keeps its values as they are: tangents belong to them. Also (K, 1)
    what handles of a key are to be multiplied by.
    """
    cubic = "cubic" in ways
    found = values[:, 1] if cubic and values.ndim > 1 else values
    if found.ndim != 2 or found.shape[1] != 4:
        raise SceneError(f"rotations have shape {found.shape}; (keys, 4) is needed: x y z w")
    lengths = np.sqrt((found * found).sum(axis=1, keepdims=True))
    if not lengths.all():
        raise SceneError(
            f"the rotation of key {int(np.flatnonzero(lengths == 0)[0])} is 0 0 0 0; a turn is needed"
        )
    unit = found / lengths
    agrees = np.where((unit[1:] * unit[:-1]).sum(axis=1) < 0, -1.0, 1.0)
    signs: FloatArray = np.cumprod(np.concatenate([[1.0], agrees]))[:, None]
    if not cubic:
        return unit * signs, signs / lengths
    return (values if set(ways) == {"cubic"} else values / lengths[:, None] * signs[:, None]), signs / lengths


def angular(turns: FloatArray, change: FloatArray) -> FloatArray:
    """(T, 3) rad/s of unit quaternions (T, 4) that change by (T, 4) a second."""
    return 2 * quaternion.multiply(change, turns * (-1, -1, -1, 1))[..., :3]
