"""Acts: what `Shot.play` writes as keys. An act says where things go, the play when and how."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import accumulate
from typing import Any

from eyeline.errors import SceneError
from eyeline.geometry.arrays import FloatArray

Read = Callable[[str], FloatArray]
Way = Callable[[Read, FloatArray], FloatArray]


@dataclass(frozen=True, eq=False)
class Change:
    """One property on its way: `way(read, parts)` gives values (P, ...) at parts (P,) of the way, 0 to 1.

    read: gives any property of the same thing as it is when the change begins. straight: the way is what a
    curve does by itself between two keys, so that two suffice; otherwise it is kept by keys that lie close.
    """

    name: str  # of the thing
    property: str
    way: Way
    straight: bool = True
    begin: float = 0.0  # of the act's time, 0 to 1
    end: float = 1.0
    ease: Any = None  # an easing; None: the play's

    def within(self, begin: float, end: float) -> Change:
        """This change in a part of another act's time."""
        span = end - begin
        return replace(self, begin=begin + span * self.begin, end=begin + span * self.end)


@dataclass(frozen=True, eq=False)
class Act:
    """Changes that belong together."""

    changes: tuple[Change, ...] = ()

    def eased(self, ease: Any) -> Act:
        """This act with an easing of its own."""
        return Act(tuple(replace(change, ease=ease) for change in self.changes))


def together(*acts: Act) -> Act:
    """Acts at the same time, as one."""
    return Act(tuple(change for act in acts for change in act.changes))


def in_turn(*acts: Act, lasting: tuple[float, ...] = (), lag_ratio: float = 1.0) -> Act:
    """Acts one after another, as one; `lasting`: how long each is against the others; alike if not said.

    lag_ratio: how much of an act is over when the next begins; 1 is all of it, 0 is `together`.
    """
    spans = lasting or (1.0,) * len(acts)
    if len(spans) != len(acts) or min(spans, default=1.0) <= 0:
        raise SceneError(f"{len(acts)} acts last {spans}; a positive number for each is needed")
    if not 0 <= lag_ratio <= 1:
        raise SceneError(f"lag_ratio is {lag_ratio}; 0 to 1 is needed")
    begins = [0.0, *accumulate(lag_ratio * span for span in spans)][: len(acts)]
    whole = max((begin + span for begin, span in zip(begins, spans, strict=True)), default=1.0)
    return Act(
        tuple(
            change.within(begin / whole, (begin + span) / whole)
            for act, begin, span in zip(acts, begins, spans, strict=True)
            for change in act.changes
        )
    )
