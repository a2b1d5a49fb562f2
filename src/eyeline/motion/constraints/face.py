"""Face: controls blend the shapes of a head, and turn its eyes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from eyeline.cached import cached_property
from eyeline.errors import SceneError
from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.constraints.space import blended, number
from eyeline.scene.pose import Samples

SIDEWAYS, UP, DOWN = (math.radians(angle) for angle in (32, 24, 30))  # how far a full look turns an eye


@dataclass(frozen=True)
class Face:
    """Writes a head's morph weights from its controls; each target's name says what moves it.

    "jawOpen": the control of that name. "jawOpen@0.5": an in-between, whole where the control is 0.5, gone
    where the next of its shapes is whole. "jawOpen*mouthPucker": a corrective, the product of controls.
    What is below 0 counts as 0; above 1 a shape goes on as it went.

    node: the head. targets: names of its mesh's morph targets, in their order. left_eye, right_eye: nodes
    that look along their z and are turned by the eyeLook controls. influence: 0..1, of the weights.
    """

    name: str
    node: str
    targets: tuple[str, ...]
    left_eye: str | None = None
    right_eye: str | None = None
    influence: float = 1.0

    def __post_init__(self) -> None:
        """Refuse in-betweens that are none, and those without the shape they lead to."""
        for target in self.targets:
            control, _, peak = target.partition("@")
            if not peak:
                continue
            if not _is_part(peak):
                raise SceneError(
                    f"constraint {self.name!r}: the in-between {target!r} needs a number between 0 and 1"
                )
            if control not in self.targets:
                raise SceneError(
                    f"constraint {self.name!r}: {target!r} leads to {control!r}, which is no target"
                )

    def __call__(self, pose: Samples, moved: Mapping[str, FloatArray]) -> Samples:
        """The head blended and its eyes turned; a control the head does not have is 0."""
        head = pose.find(self.node)
        weights = pose.weights.get(head)
        if weights is None or weights.shape[1] != len(self.targets):
            there = 0 if weights is None else weights.shape[1]
            raise SceneError(
                f"constraint {self.name!r} names {len(self.targets)} targets; {self.node!r} has {there}"
            )
        controls = pose.controls.get(head, {})
        new = blended(
            weights, self.weights(controls, len(weights)), number(moved, "influence", self.influence)
        )
        pose = replace(pose, weights={**pose.weights, head: new})
        for side, eye in (("Left", self.left_eye), ("Right", self.right_eye)):
            if eye is not None:
                at = pose.find(eye)
                turn = gaze_turn(controls, side, len(weights))
                pose = pose.placed(at, rotation=quaternion.multiply(pose.rotation[:, at], turn))
        return pose

    def weights(self, controls: Mapping[str, FloatArray], count: int) -> FloatArray:
        """Morph weights (T, targets) from controls (T,) by name; count: T."""
        columns = [
            self._corrective(controls, target, count)
            if "*" in target
            else hat(_of(controls, target.partition("@")[0], count), *self._stops[target])
            for target in self.targets
        ]
        return np.stack(columns, axis=1) if columns else np.zeros((count, 0))

    @cached_property
    def _stops(self) -> dict[str, tuple[float, float, float]]:
        """By target: where its shape begins, is whole, and is gone; infinity for the last of a control."""
        peaks: dict[str, dict[float, str]] = {}
        for target in self.targets:
            if "*" not in target:
                control, _, peak = target.partition("@")
                peaks.setdefault(control, {})[float(peak or 1)] = target
        stops = {}
        for named in peaks.values():
            order = [0.0, *sorted(named), math.inf]
            for before, whole, after in zip(order, order[1:], order[2:], strict=False):
                stops[named[whole]] = (before, whole, after)
        return stops

    def _corrective(self, controls: Mapping[str, FloatArray], target: str, count: int) -> FloatArray:
        product = np.ones(count)
        for control in target.split("*"):
            product = product * np.maximum(_of(controls, control, count), 0)
        return product


def hat(values: FloatArray, before: float, peak: float, after: float) -> FloatArray:
    """0 up to before, 1 at the peak, 0 from after on, straight between; without an after it rises on."""
    rising: FloatArray = np.maximum((values - before) / (peak - before), 0)
    if math.isinf(after):
        return rising
    falling: FloatArray = (after - values) / (after - peak)
    return np.clip(np.minimum(rising, falling), 0, 1)


def gaze_turn(controls: Mapping[str, FloatArray], side: str, count: int) -> FloatArray:
    """Rotations (T, 4) of an eye, "Left" or "Right", by its eyeLook controls; the face looks along z."""
    look = {way: _of(controls, f"eyeLook{way}{side}", count) for way in ("In", "Out", "Up", "Down")}
    outwards = 1 if side == "Left" else -1
    yaw = outwards * SIDEWAYS * (look["Out"] - look["In"])
    pitch = DOWN * look["Down"] - UP * look["Up"]
    about_y = quaternion.from_axis_angle(np.tile((0.0, 1.0, 0.0), (count, 1)), yaw)
    about_x = quaternion.from_axis_angle(np.tile((1.0, 0.0, 0.0), (count, 1)), pitch)
    return quaternion.multiply(about_y, about_x)


def _of(controls: Mapping[str, FloatArray], name: str, count: int) -> FloatArray:
    return controls[name] if name in controls else np.zeros(count)


def _is_part(text: str) -> bool:
    try:
        return 0 < float(text) < 1
    except ValueError:
        return False
