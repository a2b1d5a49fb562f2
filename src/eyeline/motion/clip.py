"""Motion of a scene: tracks under a name."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from weakref import WeakKeyDictionary

from eyeline.errors import SceneError
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.action import Action
from eyeline.motion.bundle import Bundle
from eyeline.motion.plan import Plan
from eyeline.motion.track import Track

_bundles: WeakKeyDictionary[Clip, WeakKeyDictionary[Plan, Bundle]]


@dataclass(frozen=True, eq=False)
class Clip(Action):
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

    def fill(self, plan: Plan, times: FloatArray, state: FloatArray) -> None:
        """Write every track's values at times (T,) over a state of the plan."""
        bundles = _bundles.setdefault(self, WeakKeyDictionary())
        if (bundle := bundles.get(plan)) is None:
            bundle = bundles[plan] = plan.bundle(self.tracks)
        bundle.at(times, state)

    def mirror(self, plane: str = "x") -> Clip:
        """For the other side: names swapped, motion reflected in the plane with the normal x, y or z."""
        from eyeline.motion.mirror import mirrored

        return mirrored(self, plane)


_bundles = WeakKeyDictionary()
