"""Motion of a scene: tracks under a name."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from weakref import WeakKeyDictionary

from eyeline.errors import SceneError
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.plan import Plan
from eyeline.motion.track import Track
from eyeline.scene.pose import Samples
from eyeline.scene.scene import Scene

_plans: WeakKeyDictionary[Clip, WeakKeyDictionary[Scene, Plan]]


@dataclass(frozen=True, eq=False)
class Clip:
    """A pure function of time: tracks, each moving a property of its own."""

    name: str
    tracks: tuple[Track, ...] = ()

    def __init__(self, name: str, tracks: Iterable[Track] = ()) -> None:
        """Refuse two tracks that move the same."""
        object.__setattr__(self, "name", name)
        object.__setattr__(self, "tracks", tuple(tracks))
        taken = set()
        for track in self.tracks:
            target = (track.kind, track.name, track.property)
            if target in taken:
                raise SceneError(f"clip {name!r} has {track} twice; one curve for a property is needed")
            taken.add(target)

    @property
    def duration(self) -> float:
        """Seconds from 0 to its last key; 0 without keys."""
        return max([0.0, *(float(track.curve.times[-1]) for track in self.tracks)])

    def pose(self, scene: Scene, time: float) -> Scene:
        """`scene` as it stands at `time`, seconds; before the first key and after the last it holds.

        The answer has no clips, and only nodes that are moved are new in it. Refused: a track of something
        that the scene does not have.
        """
        return self._plan(scene).pose(scene, time)

    def sample(self, scene: Scene, times: FloatArray) -> Samples:
        """All node transforms and morph weights at `times` (T,), in one batch."""
        return self._plan(scene).sample(times)

    def _plan(self, scene: Scene) -> Plan:
        """Where the tracks lead in this scene: found once, kept as long as both live."""
        plans = _plans.setdefault(self, WeakKeyDictionary())
        if (plan := plans.get(scene)) is None:
            plan = plans[scene] = Plan.of(self.tracks, scene)
        return plan


_plans = WeakKeyDictionary()
