"""Shake: a node trembles about where it is, as a camera held by hand does; seeded, at any time the same."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from eyeline.cached import cached_property
from eyeline.errors import SceneError
from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.constraints.space import number
from eyeline.scene.pose import Samples

WAVES = 6  # of each of the six numbers: enough that nobody sees them come again
TIMES = (0.35, 2.2)  # of the frequency: from the slowest wave to the quickest


@dataclass(frozen=True)
class Shake:
    """Moves and turns a node by sums of waves.

    time: seconds, what a track moves. place: metres, angle: radians: about the root mean square of each
    axis' tremble. frequency: waves a second, in the middle. influence: 0..1.
    """

    name: str
    node: str
    time: float = 0.0
    place: float = 0.004
    angle: float = 0.006
    frequency: float = 1.3
    seed: int = 0
    influence: float = 1.0

    def __post_init__(self) -> None:
        """Refuse a frequency that is none."""
        if not 0 < self.frequency < np.inf:
            raise SceneError(
                f"constraint {self.name!r}: frequency is {self.frequency}; more than 0 is needed"
            )

    def __call__(self, pose: Samples, moved: Mapping[str, FloatArray]) -> Samples:
        """The node beside where it was, along and about its parent's axes."""
        node = pose.find(self.node)
        part = number(moved, "influence", self.influence)
        waves = self._tremble(number(moved, "time", self.time)[:, 0]) * part
        turn = waves[:, 3:] * number(moved, "angle", self.angle)
        angles = np.sqrt((turn * turn).sum(axis=1))
        axes = turn / np.where(angles > 0, angles, 1)[:, None]
        before = pose.rotation[:, node]
        return pose.placed(
            node,
            translation=pose.translation[:, node] + waves[:, :3] * number(moved, "place", self.place),
            rotation=quaternion.multiply(before, quaternion.from_axis_angle(axes, angles)),
        )

    def _tremble(self, times: FloatArray) -> FloatArray:
        """(T, 6) of root mean square one: three for the place, three for the turn."""
        speeds, starts = self._waves
        waves: FloatArray = np.sin(times[:, None, None] * speeds + starts)
        tremble: FloatArray = np.sqrt(2 / WAVES) * waves.sum(axis=2)
        return tremble

    @cached_property
    def _waves(self) -> tuple[FloatArray, FloatArray]:
        """Radians a second and at the start, (6, WAVES) each."""
        chance = np.random.default_rng(self.seed)
        low, high = np.log(TIMES)
        speeds = 2 * np.pi * self.frequency * np.exp(chance.uniform(low, high, (6, WAVES)))
        return speeds, chance.uniform(0, 2 * np.pi, (6, WAVES))
