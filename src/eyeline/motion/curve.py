"""A value over time, given by keys."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np
import numpy.typing as npt

from eyeline.cached import cached_property
from eyeline.errors import SceneError, suggestion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion import checked
from eyeline.motion.bundle import Bundle
from eyeline.motion.easing import EASINGS, Easing, easing
from eyeline.motion.tangents import automatic

if TYPE_CHECKING:
    from eyeline.motion.key import Key

Interpolation = Literal["step", "linear", "cubic", "bezier", "catmull_rom", "squad"]
Extrapolation = Literal["hold", "linear", "cycle", "cycle_offset", "ping_pong"]
KeyKind = Literal["key", "extreme", "breakdown", "moving_hold"]

LINEAR = EASINGS["linear"]
STENCIL = 4096  # a segment's speed is measured over so small a part of it


@dataclass(frozen=True, eq=False)
class Curve:
    """Keys, and the way from each to the next.

    times: (K,) seconds, strictly increasing. values: (K, ...), one for each key; where any segment is "cubic"
    (K, 3, ...): the tangent that comes in, the value, the tangent that goes out, tangents per second.
    [glTF 2.0, appendix C.5] rotation: values are quaternions x y z w of any length but 0; "linear" turns
    along the shorter arc at constant speed, and every answer has length one.

    interpolation, ease, kinds: one for all keys, or one for each: how it goes on to the next, how that motion
    is spread over the time, and what the key means to an animator. extrapolate: before the first key and
    after the last, one for both or two. handles: (K, 2, 2, ...) of "bezier" segments, in and out, each a time
    and a value beside its key; NaN, or none at all, is laid automatically. One longer than its segment is
    shortened to it, as in Blender.
    """

    times: FloatArray
    values: FloatArray
    interpolation: Interpolation | Sequence[Interpolation] = "linear"
    rotation: bool = False
    ease: str | Easing | Sequence[str | Easing] = LINEAR
    extrapolate: Extrapolation | tuple[Extrapolation, Extrapolation] = "hold"
    kinds: KeyKind | Sequence[KeyKind] = "key"
    handles: FloatArray | None = None

    def __post_init__(self) -> None:
        """Refuse keys that make no curve."""
        times: FloatArray = np.ascontiguousarray(self.times, dtype=np.float64)
        values: FloatArray = np.ascontiguousarray(self.values, dtype=np.float64)
        checked.refuse_times(times)
        ways = _each(self.interpolation, len(times), get_args(Interpolation), "interpolation")
        kinds = _each(self.kinds, len(times), get_args(KeyKind), "kind of key")
        sides = _each(self.extrapolate, 2, get_args(Extrapolation), "extrapolation")
        eases = _eases(self.ease, len(times))
        cubic = "cubic" in ways
        checked.refuse_values(times, values, cubic)
        checked.refuse_ways(ways, eases, self.rotation)
        handles = self.handles
        signs = None
        if self.rotation:
            values, signs = checked.turns(values, ways)
        if "bezier" in ways:
            handles = _handles(times, values[:, 1] if cubic else values, handles, signs)
        for name, value in {
            "times": times,
            "values": values,
            "interpolation": ways[0] if len(set(ways)) == 1 else tuple(ways),
            "ease": eases[0] if len(set(eases)) == 1 else tuple(eases),
            "extrapolate": tuple(sides),
            "kinds": kinds[0] if len(set(kinds)) == 1 else tuple(kinds),
            "handles": handles,
        }.items():
            object.__setattr__(self, name, value)

    @classmethod
    def of(
        cls,
        keys: Mapping[float, npt.ArrayLike | Key] | Iterable[tuple[float, npt.ArrayLike | Key]],
        *,
        ease: str | Easing = LINEAR,
        interpolation: Interpolation = "linear",
        extrapolate: Extrapolation | tuple[Extrapolation, Extrapolation] = "hold",
        rotation: bool = False,
    ) -> Curve:
        """A curve from {seconds: value} or {seconds: Key(value, ...)}, in the order of time.

        `ease` and `interpolation` hold for every key that does not say its own.
        """
        from eyeline.motion.key import columns

        return cls(
            **columns(keys, easing(ease), interpolation, rotation), extrapolate=extrapolate, rotation=rotation
        )

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of one value."""
        return self.key_values.shape[1:]

    @property
    def width(self) -> int:
        """How many numbers one value has."""
        return int(np.prod(self.shape, dtype=np.int64))

    @property
    def key_values(self) -> FloatArray:
        """(K, ...) the values at the keys, without tangents."""
        return self.values[:, 1] if "cubic" in self.ways else self.values

    @property
    def ways(self) -> tuple[str, ...]:
        """(K,) how each key goes on to the next."""
        one = self.interpolation
        return (one,) * len(self.times) if isinstance(one, str) else tuple(one)

    @property
    def eases(self) -> tuple[Easing, ...]:
        """(K,) how the motion from each key to the next is spread over the time."""
        return tuple(_eases(self.ease, len(self.times)))

    @property
    def is_plain(self) -> bool:
        """Whether glTF can say it: step, linear or cubic throughout, not eased, holding outside its keys."""
        return (
            self.interpolation in ("step", "linear", "cubic")
            and self.ease == LINEAR
            and self.extrapolate == ("hold", "hold")
        )

    def at(self, times: npt.ArrayLike) -> FloatArray:
        """Its values (T, ...) at times (T,), in seconds; at a key exactly the key's."""
        seconds = np.asarray(times, dtype=np.float64).reshape(-1)
        if not np.isfinite(seconds).all():
            raise SceneError("times hold a number that is not finite; seconds are needed")
        return self._bundle.at(seconds).reshape(len(seconds), *self.shape)

    def speed(self, times: npt.ArrayLike) -> FloatArray:
        """How fast its values change (T, ...), per second; of a rotation the angular velocity (T, 3), rad/s.

        At a key the speed with which it goes on. Measured by a five-point stencil inside each segment, exact
        for polynomials of fourth degree.
        """
        seconds = np.asarray(times, dtype=np.float64).reshape(-1)
        edges = np.concatenate([[-np.inf], self.times, [np.inf]])
        place = np.searchsorted(edges, seconds, side="right")
        low, high = edges[place - 1], edges[place]
        span = max(float(self.times[-1] - self.times[0]), 1.0)
        step = np.where(np.isfinite(high - low), high - low, span) / STENCIL
        middle = np.clip(seconds, low + 2 * step, high - 2 * step)
        points = np.array([-2, -1, 0, 1, 2])
        found = self.at((middle[:, None] + points * step[:, None]).reshape(-1))
        found = found.reshape(len(seconds), 5, -1)
        weights = _stencil((seconds - middle) / step) / step[:, None]
        change = np.einsum("tp,tpw->tw", weights, found)
        return checked.angular(self.at(seconds), change) if self.rotation else change.reshape(-1, *self.shape)

    @cached_property
    def _bundle(self) -> Bundle:
        return Bundle.of([self])


def _stencil(x: FloatArray) -> FloatArray:
    """(T, 5) weights of values at -2 ... 2 for the slope at x (T,) of the quartic through them."""
    points = np.arange(-2.0, 3.0)
    weights = np.zeros((len(x), 5))
    for index, point in enumerate(points):
        others = np.delete(points, index)
        basis = np.polynomial.Polynomial.fromroots(others) / np.prod(point - others)
        weights[:, index] = basis.deriv()(x)
    return weights


def _each(given: object, count: int, known: tuple[str, ...], what: str) -> list[str]:
    """One name for each of `count`, all known."""
    names = [given] * count if isinstance(given, str) else list(given)  # type: ignore[call-overload]
    if len(names) != count:
        raise SceneError(f"{what} has {len(names)} names; one, or {count}, is needed")
    for name in names:
        if name not in known:
            raise SceneError(f"{what} is {name!r}{suggestion(str(name), known)}")
    return names


def _eases(given: str | Easing | Sequence[str | Easing], count: int) -> list[Easing]:
    """One easing for each of `count` keys."""
    eases = [given] * count if isinstance(given, str | Easing) else list(given)
    if len(eases) != count:
        raise SceneError(f"there are {len(eases)} easings for {count} keys; one, or {count}, is needed")
    return [easing(one) for one in eases]


def _handles(
    times: FloatArray, values: FloatArray, given: FloatArray | None, signs: FloatArray | None
) -> FloatArray:
    """(K, 2, 2, ...) handles, those that are not given laid automatically."""
    found: FloatArray = automatic(times, values.reshape(len(times), -1)).reshape(
        len(times), 2, 2, *values.shape[1:]
    )
    if given is None:
        return found
    handles = np.ascontiguousarray(given, dtype=np.float64)
    checked.refuse_handles(handles, found.shape)
    if signs is not None:
        handles = handles.copy()
        handles[:, :, 1] *= signs[:, None]
    merged = np.where(np.isnan(handles), found, handles)
    # Beyond the ends a handle that is not given goes on as the one within comes
    for key, side in ((0, 0), (-1, 1)):
        free = np.isnan(handles[key, side])
        merged[key, side] = np.where(free, -merged[key, 1 - side], merged[key, side])
    return merged
