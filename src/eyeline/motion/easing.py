"""Easings: how a motion spreads over the time between two keys, by the names people know."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from eyeline.errors import SceneError, suggestion
from eyeline.geometry.arrays import FloatArray
from eyeline.jit import kernel
from eyeline.motion import warp
from eyeline.motion.warp import warped

CALL = re.compile(r"\s*([\w-]+)\s*(?:\(([^()]*)\))?\s*")
WIDER = 1.525  # how much farther `ease_in_out_back` swings, so that halved it looks as far [Penner02]
EVERYWHERE = (-math.inf, math.inf)

# What a parameter may be
RANGES: dict[str, tuple[float, float]] = {
    "x1": (0, 1),
    "x2": (0, 1),
    "amplitude": (0, math.inf),
    "period": (1e-3, math.inf),
    "count": (1, 1e6),
    "inflection": (1e-3, 100),
    "pause": (0, 0.999),
    "end": (1e-3, 1),
}


@dataclass(frozen=True)
class Easing:
    """A named way to spread a motion over time: part of the time, 0 to 1, to part of the way.

    Called with parts of the time (T,) it answers parts of the way. Written as text it can be read again by
    `easing`: "ease_out_back(2.5)".
    """

    name: str
    idea: str  # one sentence for people
    family: int  # of `warp`
    mode: int = warp.IN
    parameters: tuple[tuple[str, float], ...] = ()  # names and values, in the order they are written
    fixed: tuple[float, ...] = ()  # numbers of its shape that come before the parameters

    def __post_init__(self) -> None:
        """Refuse parameters that make no motion."""
        for name, value in self.parameters:
            low, high = RANGES.get(name, EVERYWHERE)
            if not (math.isfinite(value) and low <= value <= high):
                bounds = "a finite number" if low == -math.inf else f"{low:g} to {high:g}"
                raise SceneError(f"{self.name} has {name} {value:g}; {bounds} is needed")

    def __call__(self, parts: npt.ArrayLike) -> FloatArray:
        """Parts of the way at parts of the time; before 0 it stands at 0, after 1 at the end."""
        given = np.asarray(parts, dtype=np.float64)
        if np.isnan(given).any():
            raise SceneError(f"{self.name} is asked at NaN; a part of the time, 0 to 1, is needed")
        flat = np.ascontiguousarray(np.clip(given, 0, 1).reshape(-1))
        answer = np.empty(len(flat))
        ease(flat, np.array([self.family, self.mode, *self.numbers]), answer)
        return answer.reshape(given.shape)

    def __str__(self) -> str:
        values = ", ".join(f"{value:g}" for _, value in self.parameters)
        return f"{self.name}({values})" if values else self.name

    @property
    def numbers(self) -> tuple[float, float, float, float]:
        """What kernels read: the four numbers of its shape."""
        values = [*self.fixed, *(value for _, value in self.parameters)]
        if self.family == warp.BACK and self.mode == warp.IN_OUT:
            values = [values[0] * WIDER]
        elif self.family == warp.ELASTIC:
            values.append(math.asin(1 / max(1.0, values[0])) / math.tau)
        a, b, c, d = [*values, 0.0, 0.0, 0.0, 0.0][:4]
        return a, b, c, d

    def having(self, *values: float) -> Easing:
        """The same with other parameters, the first ones as given."""
        if len(values) > len(self.parameters):
            names = ", ".join(name for name, _ in self.parameters) or "none"
            raise SceneError(f"{self.name} is given {len(values)} numbers; it takes {names}")
        kept = self.parameters[len(values) :]
        named = zip((name for name, _ in self.parameters), map(float, values), strict=False)
        return replace(self, parameters=(*named, *kept))


@kernel
def ease(parts, shape, answer):
    """Every part of the time, one after the other."""
    for t in range(len(parts)):
        answer[t] = warped(int(shape[0]), int(shape[1]), shape[2], shape[3], shape[4], shape[5], parts[t])


DEGREES = {"quad": 2.0, "cubic": 3.0, "quart": 4.0, "quint": 5.0}
SPRING = (("amplitude", 1.0), ("period", 0.3))
INFLECTION = (("inflection", 10.0),)
SLOW_SPRING = (("amplitude", 1.0), ("period", 0.45))

FAMILIES: dict[str, tuple[int, str, tuple[tuple[str, float], ...]]] = {
    "sine": (warp.SINE, "like a quarter of a sine", ()),
    "quad": (warp.POWER, "with the square of time", ()),
    "cubic": (warp.POWER, "with the third power of time", ()),
    "quart": (warp.POWER, "with the fourth power of time", ()),
    "quint": (warp.POWER, "with the fifth power of time", ()),
    "expo": (warp.EXPO, "doubling its speed ten times over", ()),
    "circ": (warp.CIRC, "along a quarter of a circle, upright at the fast end", ()),
    "back": (warp.BACK, "swinging beyond the key by the overshoot", (("overshoot", 1.70158),)),
    "elastic": (warp.ELASTIC, "swinging like a spring; the period is a part of the time", SPRING),
    "bounce": (warp.BOUNCE, "bouncing off the key three times", ()),
}
WAYS = {
    "in": (warp.IN, "Gathers speed"),
    "out": (warp.OUT, "Comes to rest"),
    "in_out": (warp.IN_OUT, "Gathers speed, then comes to rest,"),
}


def _curved(name: str, idea: str, *points: float) -> Easing:
    named = zip(("x1", "y1", "x2", "y2"), points, strict=True)
    return Easing(name, idea, warp.BEZIER, warp.IN, tuple(named))


def _returning(name: str, idea: str, mode: int, **parameters: float) -> Easing:
    rest = () if "pause" in parameters else (0.0,)
    return Easing(name, idea, warp.SIGMOID, mode, tuple(parameters.items()), (10.0, *rest))


def _styled() -> list[Easing]:
    """The thirty of Penner: ten families, in, out, and both."""
    styled = []
    for family, (code, manner, parameters) in FAMILIES.items():
        for way, (mode, idea) in WAYS.items():
            slow = family == "elastic" and way == "in_out"
            given = SLOW_SPRING if slow else parameters
            fixed = (DEGREES[family],) if family in DEGREES else ()
            styled.append(Easing(f"ease_{way}_{family}", f"{idea} {manner}.", code, mode, given, fixed))
    return styled


NAMED = [
    Easing("linear", "Goes at one speed.", warp.STRAIGHT),
    Easing("step", "Stays until the next key.", warp.STEPS, warp.IN, (("count", 1.0),)),
    Easing("steps", "Jumps, after equal times, by equal parts.", warp.STEPS, warp.IN, (("count", 4.0),)),
    _curved("cubic_bezier", "CSS's curve with the handles (x1, y1) and (x2, y2).", 0.25, 0.1, 0.25, 1),
    _curved("ease", "CSS's usual one: starts briskly, ends softly.", 0.25, 0.1, 0.25, 1),
    _curved("ease_in", "CSS's: starts softly.", 0.42, 0, 1, 1),
    _curved("ease_out", "CSS's: ends softly.", 0, 0, 0.58, 1),
    _curved("ease_in_out", "CSS's: starts and ends softly.", 0.42, 0, 0.58, 1),
    *_styled(),
    Easing("smooth", "manim's usual one: softly at both ends.", warp.SIGMOID, warp.IN, INFLECTION),
    Easing("smoothstep", "At rest at both ends, of third degree.", warp.HERMITE, fixed=(1.0,)),
    Easing(
        "smootherstep", "At rest and free of force at both ends, of fifth degree.", warp.HERMITE, fixed=(2.0,)
    ),
    Easing("double_smooth", "Smoothly half-way, and smoothly on.", warp.SIGMOID, warp.IN_OUT, INFLECTION),
    Easing("rush_into", "Half of smooth: arrives at full speed.", warp.SIGMOID, warp.FIRST_HALF, INFLECTION),
    Easing("rush_from", "Half of smooth: leaves at full speed.", warp.SIGMOID, warp.SECOND_HALF, INFLECTION),
    Easing("slow_into", "Along a quarter of a circle, softly at the end.", warp.CIRC, warp.OUT),
    Easing("running_start", "Pulls back before it goes.", warp.RUN, warp.IN, (("pull", -0.5),)),
    Easing("lingering", "Is there early, and waits.", warp.LINGER, warp.IN, (("end", 0.8),)),
    _returning("there_and_back", "Goes and returns; the next key comes as a jump.", warp.THERE_AND_BACK),
    _returning(
        "there_and_back_with_pause",
        "Goes, rests, returns; the next key comes as a jump.",
        warp.THERE_AND_BACK,
        pause=1 / 3,
    ),
    _returning(
        "wiggle",
        "Swings to and fro, ends where it was; the next key comes as a jump.",
        warp.WIGGLE,
        wiggles=2.0,
    ),
]

EASINGS: dict[str, Easing] = {one.name: one for one in NAMED}


def easing(given: str | Easing) -> Easing:
    """An easing by its name, with parameters in brackets where others than the usual are wanted.

    "ease_out_back(2.5)", "cubic_bezier(0.3, 0, 0.1, 1)", "steps(4)". Refused: a name that is not in EASINGS.
    """
    if isinstance(given, Easing):
        return given
    call = CALL.fullmatch(given) if isinstance(given, str) else None
    if call is None:
        raise SceneError(f"easing is {given!r}; a name is needed, as ease_in_out or ease_out_back(2.5)")
    name = call[1].replace("-", "_")
    if name not in EASINGS:
        raise SceneError(f"there is no easing {name!r}{suggestion(name, EASINGS)}")
    if not (call[2] or "").strip():
        return EASINGS[name]
    try:
        values = [float(number) for number in call[2].split(",")]
    except ValueError:
        raise SceneError(
            f"the easing {given!r} has numbers that cannot be read; numbers and commas are needed"
        ) from None
    return EASINGS[name].having(*values)


def cubic_bezier(x1: float, y1: float, x2: float, y2: float) -> Easing:
    """CSS's timing function with handles (x1, y1) and (x2, y2); x1 and x2 are parts of the time, 0 to 1."""
    return EASINGS["cubic_bezier"].having(x1, y1, x2, y2)


def steps(count: int) -> Easing:
    """Jumps at `count` equal times, the last at the next key, as CSS's steps(count)."""
    return EASINGS["steps"].having(count)
