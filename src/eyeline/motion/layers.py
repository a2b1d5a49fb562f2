"""Actions over actions: overriding or added, weighted, masked."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import Literal, get_args

import numpy as np

from eyeline.errors import SceneError, suggestion
from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.action import Action
from eyeline.motion.curve import Curve
from eyeline.motion.plan import Address, Plan
from eyeline.motion.retimed import shifted
from eyeline.motion.track import Track

Mode = Literal["override", "additive"]


@dataclass(frozen=True, eq=False)
class Layer:
    """An action laid over what is below.

    "override" goes from what is below to the action's values, by its weight. "additive" adds, weighted, how
    far the action has moved since `reference`, one of its seconds; turns are added by turning on. mask: paths
    of nodes, or patterns ("body/arm*"), that it may move; nothing else then moves, materials neither.
    """

    action: Action
    mode: Mode = "override"
    weight: float | Curve = 1.0  # 0 is nothing, 1 all of it
    mask: Sequence[str] | None = None
    reference: float = 0.0  # seconds

    def __post_init__(self) -> None:
        """Refuse a mode or a weight that is none."""
        if self.mode not in get_args(Mode):
            raise SceneError(f"a layer's mode is {self.mode!r}; override or additive is needed")
        if isinstance(self.weight, Curve):
            if self.weight.shape != ():
                raise SceneError(
                    f"a layer's weight has values of shape {self.weight.shape}; single numbers are needed"
                )
        elif not math.isfinite(self.weight):
            raise SceneError(f"a layer's weight is {self.weight}; a number, or a curve of numbers, is needed")

    def lay(self, plan: Plan, times: FloatArray, state: FloatArray) -> None:
        """Write over a state what becomes of it at times (T,)."""
        weight = self.weights(times)
        targets = self._targets(plan)
        over = plan.at_rest(len(times))
        self.action.fill(plan, times, over)
        origin = plan.at_rest(1)
        if self.mode == "additive":
            self.action.fill(plan, np.array([self.reference], dtype=np.float64), origin)
        for target, width in targets.items():
            below = plan.column(state, target, width, len(times))
            value = plan.column(over, target, width, len(times))
            is_turn = target[0] == "node" and target[3] == "rotation"
            if self.mode == "additive":
                start = plan.column(origin, target, width, 1)
                below[:] = _added(below, value, start, weight, is_turn)
            else:
                below[:] = _mixed(below, value, weight, is_turn)

    def weights(self, times: FloatArray) -> FloatArray:
        """(T, 1) how much of it there is at times (T,)."""
        if isinstance(self.weight, Curve):
            return self.weight.at(times)[:, None]
        return np.full((len(times), 1), float(self.weight))

    def _targets(self, plan: Plan) -> dict[Address, int]:
        """What it moves, and how many numbers each is."""
        targets = {plan.address(track): track.curve.width for track in self.action.tracks}
        if self.mask is None:
            return targets
        masked = set()
        for pattern in self.mask:
            nodes = {node for node, path in enumerate(plan.paths) if _is_meant(pattern, path)}
            if not nodes:
                raise SceneError(f"the mask {pattern!r} meets no node{suggestion(pattern, plan.paths)}")
            masked |= nodes
        return {target: width for target, width in targets.items() if target[1] in masked}


@dataclass(frozen=True, eq=False)
class Layers(Action):
    """A base, and layers over it, each over all that is below."""

    base: Action
    layers: tuple[Layer, ...]
    name: str
    duration: float  # seconds

    def __init__(self, base: Action, *layers: Layer, name: str = "", duration: float | None = None) -> None:
        """Named as the base, and as long as the longest, unless said otherwise."""
        object.__setattr__(self, "base", base)
        object.__setattr__(self, "layers", tuple(layers))
        object.__setattr__(self, "name", name or base.name)
        longest = max([base.duration, *(layer.action.duration for layer in layers)])
        object.__setattr__(self, "duration", longest if duration is None else duration)

    @property
    def tracks(self) -> Sequence[Track]:
        """What the base moves, and every layer."""
        return [*self.base.tracks, *(track for layer in self.layers for track in layer.action.tracks)]

    def fill(self, plan: Plan, times: FloatArray, state: FloatArray) -> None:
        """Write the base over a state of the plan, and every layer over that."""
        self.base.fill(plan, times, state)
        for layer in self.layers:
            layer.lay(plan, times, state)


@dataclass(frozen=True, eq=False, init=False)
class CrossFade(Layers):
    """One action that gives way to another: where only one moves, the other stands as the scene does."""

    def fill(self, plan: Plan, times: FloatArray, state: FloatArray) -> None:
        """Write both, mixed, over a state of the plan."""
        whole = {plan.address(track): track.curve.width for track in self.tracks}
        resting = plan.at_rest(len(times))
        for target, width in whole.items():
            plan.column(state, target, width, len(times))[:] = plan.column(resting, target, width, len(times))
        self.base.fill(plan, times, state)
        (layer,) = self.layers
        weight = layer.weights(times)
        layer.action.fill(plan, times, resting)
        for target, width in whole.items():
            below = plan.column(state, target, width, len(times))
            value = plan.column(resting, target, width, len(times))
            below[:] = _mixed(below, value, weight, target[0] == "node" and target[3] == "rotation")


def cross_faded(first: Action, second: Action, seconds: float) -> Layers:
    """One, then another, which begins so many seconds before the first ends."""
    if not (math.isfinite(seconds) and 0 <= seconds <= min(first.duration, second.duration)):
        longest = min(first.duration, second.duration)
        raise SceneError(
            f"a cross-fade of {seconds} s between {first.name!r} and {second.name!r}; 0 to {longest:g} s fit"
        )
    start = first.duration - seconds
    if seconds > 0:
        weight = Curve.of({start: 0, first.duration: 1})
    else:
        weight = Curve.of({start - 1: 0, start: 1}, interpolation="step")
    after = shifted(second, start)
    return CrossFade(
        first, Layer(after, weight=weight), name=f"{first.name}, {second.name}", duration=after.duration
    )


def _is_meant(pattern: str, path: str) -> bool:
    """Whether a path is the pattern, ends with it, or matches it."""
    return path == pattern or path.endswith("/" + pattern) or fnmatchcase(path, pattern)


def _mixed(below: FloatArray, value: FloatArray, weight: FloatArray, is_turn: bool) -> FloatArray:
    """From one to the other by the weight; where there is nothing below, the other."""
    if is_turn:
        return np.where(weight == 0, below, quaternion.slerp(below, value, weight[:, 0]))
    mixed = (1 - weight) * below + weight * value
    return np.where(np.isnan(below), value, np.where(np.isnan(value), below, mixed))


def _added(
    below: FloatArray, value: FloatArray, start: FloatArray, weight: FloatArray, is_turn: bool
) -> FloatArray:
    """What is below, and on by what has changed since the start."""
    if not is_turn:
        return below + weight * (value - start)
    turned = quaternion.multiply(below, quaternion.multiply(start * (-1, -1, -1, 1), value))
    return np.where(weight == 0, below, quaternion.slerp(below, turned, weight[:, 0]))
