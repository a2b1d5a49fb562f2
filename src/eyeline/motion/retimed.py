"""Motion by another clock: trimmed, stretched, backwards, over and over."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from eyeline.errors import SceneError
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.action import Action
from eyeline.motion.curve import Curve
from eyeline.motion.plan import Plan
from eyeline.motion.track import Track


@dataclass(frozen=True, eq=False)
class Retimed(Action):
    """An action whose time is told by a clock: at each second the second of the action that is shown."""

    action: Action
    clock: Curve  # of single numbers, seconds
    duration: float  # seconds
    name: str = ""

    def __post_init__(self) -> None:
        """Refuse a clock that tells no time; without a name it has the action's."""
        if self.clock.shape != ():
            raise SceneError(f"a clock has values of shape {self.clock.shape}; single seconds are needed")
        object.__setattr__(self, "name", self.name or self.action.name)

    @property
    def tracks(self) -> Sequence[Track]:
        """What the action moves; their times are by its own clock."""
        return self.action.tracks

    def fill(self, plan: Plan, times: FloatArray, state: FloatArray) -> None:
        """Write what the action moves over a state of the plan."""
        self.action.fill(plan, self.clock.at(times), state)


def trimmed(action: Action, start: float, end: float) -> Retimed:
    """The part from start to end, which must lie after it."""
    if not (math.isfinite(start) and math.isfinite(end) and start < end):
        raise SceneError(
            f"{action.name!r} is trimmed from {start} to {end} s; an end after the start is needed"
        )
    return Retimed(action, Curve.of({0: start, end - start: end}), end - start)


def stretched(action: Action, clock: float | Curve) -> Retimed:
    """As many times as long, or by a clock."""
    if isinstance(clock, Curve):
        return Retimed(action, clock, max(0.0, float(clock.times[-1])))
    if not (math.isfinite(clock) and clock > 0):
        raise SceneError(
            f"{action.name!r} is made {clock} times as long; more than 0 is needed; reverse() turns it"
        )
    return Retimed(action, Curve.of({0: 0, clock: 1}, extrapolate="linear"), action.duration * clock)


def reversed_(action: Action) -> Retimed:
    """From its end to its beginning."""
    end = _lasting(action, "reversed")
    return Retimed(action, Curve.of({0: end, end: 0}, extrapolate="linear"), end)


def looped(action: Action, count: float) -> Retimed:
    """So many times over, then held."""
    if not (math.isfinite(count) and count > 0):
        raise SceneError(f"{action.name!r} is looped {count} times; more than 0 is needed")
    end = _lasting(action, "looped")
    laps = Curve.of({0: 0, end: end}, extrapolate=("hold", "cycle"))
    lap = Retimed(action, laps, end * count)
    return trimmed(lap, 0.0, end * count)


def shifted(action: Action, by: float) -> Retimed:
    """Later by so many seconds."""
    if not math.isfinite(by):
        raise SceneError(f"{action.name!r} is shifted by {by} s; a number of seconds is needed")
    return Retimed(action, Curve.of({by: 0, by + 1: 1}, extrapolate="linear"), max(0.0, action.duration + by))


def _lasting(action: Action, done: str) -> float:
    if action.duration <= 0:
        raise SceneError(f"{action.name!r} lasts 0 s and cannot be {done}; keys after 0 s are needed")
    return action.duration
