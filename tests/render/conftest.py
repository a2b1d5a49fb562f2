"""Small scenes whose pictures take milliseconds."""

from __future__ import annotations

from dataclasses import dataclass, replace

import pytest

import eyeline as el
from eyeline.scene.pose import Samples


@dataclass(frozen=True)
class Slide:
    """A clip that carries the first node in a direction, metres a second."""

    direction: tuple[float, float, float] = (1.0, 0.0, 0.0)
    name: str = "slide"
    duration: float = 1.0

    def pose(self, scene: el.Scene, time: float) -> el.Scene:
        held = min(max(time, 0.0), self.duration)
        x, y, z = (held * part for part in self.direction)
        return replace(scene, nodes=(replace(scene.nodes[0], translation=(x, y, z)), *scene.nodes[1:]))

    def sample(self, scene: el.Scene, times: object) -> Samples:
        raise AssertionError("films pose, they do not sample")


@pytest.fixture
def sliding() -> el.Scene:
    """A square of one metre that slides, and no camera."""
    square = el.Mesh(
        [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)],
        [(0, 1, 2), (0, 2, 3)],
        material=el.Material(base_color=(0.8, 0.1, 0.1, 1.0), unlit=True),
    )
    return replace(el.Scene.of(square), clips=(Slide(),))


@pytest.fixture
def falling(sliding: el.Scene) -> el.Scene:
    """The square, falling one metre."""
    return replace(sliding, clips=(Slide((0.0, -1.0, 0.0), "fall"),))
