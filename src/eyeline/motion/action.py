"""Whatever moves a scene as a pure function of time: clips, and what is made of clips."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.motion.plan import Plan
from eyeline.motion.track import Track
from eyeline.scene.pose import Samples
from eyeline.scene.scene import Scene

if TYPE_CHECKING:
    from eyeline.motion.curve import Curve
    from eyeline.motion.layers import Layers
    from eyeline.motion.retimed import Retimed

_plans: WeakKeyDictionary[Action, WeakKeyDictionary[Scene, Plan]]


class Action:
    """A pure function of time that poses a scene. Its verbs answer new ones, and leave it as it is."""

    if TYPE_CHECKING:  # its kinds hold them as fields or make them

        @property
        def name(self) -> str:
            """What it is called, for people and for `clip=`."""

        @property
        def tracks(self) -> Sequence[Track]:
            """Everything it moves; of several that move the same, each."""

        @property
        def duration(self) -> float:
            """Seconds from 0 to its last key."""

        def fill(self, plan: Plan, times: FloatArray, state: FloatArray) -> None:
            """Write what it moves at times (T,) over a state of the plan."""

    def pose(self, scene: Scene, time: float) -> Scene:
        """`scene` as it stands at `time`, seconds; before the first key and after the last it holds.

        The answer has no clips, and only nodes that are moved are new in it. Refused: a track of something
        that the scene does not have.
        """
        plan = self._plan(scene)
        state = plan.at_rest(1)
        self.fill(plan, np.array([time], dtype=np.float64), state)
        return plan.posed(scene, state)

    def sample(self, scene: Scene, times: FloatArray) -> Samples:
        """All node transforms and morph weights at `times` (T,), in one batch."""
        plan = self._plan(scene)
        state = plan.at_rest(len(times))
        self.fill(plan, times, state)
        return plan.sampled(state, len(times))

    def trim(self, start: float = 0.0, end: float | None = None) -> Retimed:
        """The part from `start` to `end`, seconds, begun at 0; it holds outside."""
        from eyeline.motion import retimed

        return retimed.trimmed(self, start, self.duration if end is None else end)

    def retime(self, clock: float | Curve) -> Retimed:
        """As many times as long; or by a clock, a curve that says which of its seconds is shown at each."""
        from eyeline.motion import retimed

        return retimed.stretched(self, clock)

    def reverse(self) -> Retimed:
        """From its end to its beginning."""
        from eyeline.motion import retimed

        return retimed.reversed_(self)

    def loop(self, count: float) -> Retimed:
        """So many times over, then held; a part of a time is a part of a lap."""
        from eyeline.motion import retimed

        return retimed.looped(self, count)

    def shift(self, by: float) -> Retimed:
        """Later by so many seconds; earlier, if less than 0."""
        from eyeline.motion import retimed

        return retimed.shifted(self, by)

    def cross_fade(self, other: Action, seconds: float) -> Layers:
        """This, then another, which begins so many seconds before this ends and takes over in that time."""
        from eyeline.motion import layers

        return layers.cross_faded(self, other, seconds)

    def join(self, other: Action) -> Layers:
        """This, then another, cut hard."""
        return self.cross_fade(other, 0.0)

    def _plan(self, scene: Scene) -> Plan:
        """Where the tracks lead in this scene: found once, kept as long as both live."""
        plans = _plans.setdefault(self, WeakKeyDictionary())
        if (plan := plans.get(scene)) is None:
            plan = plans[scene] = Plan.of(self.tracks, scene)
        return plan


_plans = WeakKeyDictionary()
