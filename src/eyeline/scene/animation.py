"""What a scene asks of a clip, so that the nouns need not know how motion is made."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from eyeline.geometry.arrays import FloatArray

if TYPE_CHECKING:
    from eyeline.scene.pose import Samples
    from eyeline.scene.scene import Scene


class Animation(Protocol):
    """A clip: a pure function of time that poses a scene."""

    @property
    def name(self) -> str:
        """What it is called, for people and for `clip=`."""

    @property
    def duration(self) -> float:
        """Seconds from 0 to its last key."""

    def pose(self, scene: Scene, time: float) -> Scene:
        """`scene` as it stands at `time`, seconds, without clips; it holds outside its keys."""

    def sample(self, scene: Scene, times: FloatArray) -> Samples:
        """All node transforms and morph weights at `times` (T,), in one batch."""
