"""A shot: an author's notebook. Whatever is written in it becomes keys of a clip, and nothing else."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any, Self

import numpy as np
import numpy.typing as npt

from eyeline.errors import SceneError
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.act import Act, Change, Read, together
from eyeline.motion.actor import Actor
from eyeline.motion.address import Address
from eyeline.motion.clip import Clip
from eyeline.motion.constraints import FollowPath, LookAt, Shake
from eyeline.motion.curve import Curve
from eyeline.motion.easing import easing
from eyeline.motion.key import Key
from eyeline.motion.path import Path
from eyeline.motion.track import Track
from eyeline.scene.constraint import Constraint
from eyeline.scene.scene import Scene

CLOSE = 1 / 24  # seconds between the keys that keep a way which is not straight
STEP = 1e-4  # of such a change's time: over so much its speed is measured


class Shot:
    """Directs a scene: keys by time, or acts one after another; `scene` is what comes of it.

    The same two doors, mixed as one likes: `key` says where a thing is at given times, `play` lets things
    act from the playhead on and moves the playhead. Both only write keys. Times are seconds.
    """

    def __init__(self, scene: Scene, name: str = "shot") -> None:
        """Begin with a scene as it stands; its own clips stay beside the one that is written."""
        self.time = 0.0  # the playhead
        self._name = name
        self._scene = scene
        self._keys: dict[Address, dict[float, Key]] = {}
        self._ways: dict[Address, dict[str, Any]] = {}

    def __getitem__(self, name: str) -> Actor:
        """A node by its path, or a material or constraint by its name."""
        return Actor(name)

    # --- writing ----------------------------------------------------------------------------------------

    def key(
        self,
        what: str,
        keys: Mapping[float, npt.ArrayLike | Key],
        *,
        ease: Any = None,
        interpolation: Any = None,
        extrapolate: Any = None,
    ) -> Self:
        """Keys of a property, {seconds: value}: "ball.translation", "clay.roughness", "sun.light.intensity".

        ease, interpolation: how these keys go on to the next; a Key may say its own. extrapolate: before
        the first key and after the last. A key at a time that has one replaces it.
        """
        address = Address.of(what, self._scene)
        rest = address.at_rest(self._scene)
        rows = dict(self._keys.get(address, {}))
        for time, given in keys.items():
            key = given if isinstance(given, Key) else Key(given)
            value = np.asarray(key.value, dtype=np.float64)
            if value.shape != rest.shape:
                raise SceneError(f"{what} at {time} s has shape {value.shape}; {rest.shape} is needed")
            own = key.ease or ease, key.interpolation or interpolation
            rows[_seconds(time)] = replace(key, value=value, ease=own[0], interpolation=own[1])
        if rows:
            self._keys[address] = rows
        if extrapolate is not None:
            self._ways.setdefault(address, {})["extrapolate"] = extrapolate
        return self

    def play(
        self, *acts: Act, run_time: float = 1.0, ease: Any = "smooth", lag_ratio: float | None = None
    ) -> Self:
        """Acts from the playhead on, for `run_time` seconds; the playhead goes to their end.

        lag_ratio: without it all begin together; with it each begins when so much of the one before is
        over, and `run_time` is that of each.
        """
        if not 0 < run_time < math.inf:
            raise SceneError(f"run_time is {run_time} s; more than 0 is needed")
        starts = [self.time + run_time * (lag_ratio or 0.0) * index for index in range(len(acts))]
        changes = [
            (start + run_time * change.begin, start + run_time * change.end, change)
            for start, act in zip(starts, acts, strict=True)
            for change in together(act).changes
        ]
        for begin, end, change in sorted(changes, key=lambda row: row[0]):
            self._write(change, begin, end, ease)
        self.time = max([self.time, *(start + run_time for start in starts)])
        return self

    def wait(self, seconds: float = 1.0) -> Self:
        """Let everything stand for so long."""
        if not 0 <= seconds < math.inf:
            raise SceneError(f"a wait of {seconds} s; 0 or more is needed")
        self.time += seconds
        return self

    def constrain(self, *constraints: Constraint) -> Self:
        """Constraints, kept after those the scene has; their numbers can be keyed like all others."""
        self._scene = replace(self._scene, constraints=(*self._scene.constraints, *constraints))
        return self

    def travel(
        self,
        node: str,
        path: Path,
        *,
        run_time: float | None = None,
        speed: float | None = None,
        ease: Any = "linear",
        ahead: str | None = None,
    ) -> Self:
        """A node along a path, from the playhead on: for `run_time` seconds, or at `speed` metres a second.

        ahead: which of its axes goes first, as FollowPath has it. The constraint is called "NODE path"; it
        holds from then on, so that the node stays at the path's end.
        """
        if (run_time is None) == (speed is None):
            raise SceneError("a journey has either a run_time or a speed; give one")
        name = self._free(f"{node} path")
        self.constrain(FollowPath(name, node, path, ahead=ahead))
        whole = run_time if run_time is not None else path.length / _positive("speed", speed)
        if self.time > 0:
            self.key(f"{name}.influence", {0.0: 0.0, self.time: 1.0}, interpolation="step")
        return self.play(Actor(name).animate.set("along", path.length), run_time=whole, ease=ease)

    def watch(self, node: str, target: str, **options: Any) -> Self:
        """A node looks at another from now to the end; options: those of LookAt."""
        return self.constrain(LookAt(self._free(f"{node} look"), node, target, **options))

    def handheld(self, node: str, *, seed: int = 0, **options: Any) -> Self:
        """A node trembles as a camera held by hand, all the time; options: those of Shake."""
        name = self._free(f"{node} shake")
        self.constrain(Shake(name, node, seed=seed, **options))
        return self.key(f"{name}.time", {0.0: 0.0, 1.0: 1.0}, extrapolate="linear")

    # --- reading ----------------------------------------------------------------------------------------

    @property
    def clip(self) -> Clip:
        """The clip that has been written; it lasts to the playhead, if no key is later."""
        curves = {address: self._curve(address) for address in self._keys}
        last = max((float(curve.times[-1]) for curve in curves.values()), default=0.0)
        still = [one for one in curves if one not in self._ways]
        if still and self.time > last:
            held = self._keys[still[0]] | {self.time: Key(curves[still[0]].at([last])[0])}
            curves[still[0]] = Curve.of(sorted(held.items()), rotation=still[0].turns())
        return Clip(
            self._name, [Track(one.kind, one.name, one.property, curve) for one, curve in curves.items()]
        )

    @property
    def scene(self) -> Scene:
        """The scene with the clip, its first; it lasts at least to the playhead."""
        return replace(self._scene, clips=(self.clip, *self._scene.clips))

    def _curve(self, address: Address) -> Curve:
        rows = sorted(self._keys[address].items())
        return Curve.of(rows, rotation=address.turns(), **self._ways.get(address, {}))

    def _read(self, address: Address, time: float) -> FloatArray:
        """A property's value at a time, as it is written so far."""
        if self._keys.get(address):
            value: FloatArray = self._curve(address).at([time])[0]
            return value
        return address.at_rest(self._scene)

    def _write(self, change: Change, begin: float, end: float, ease: Any) -> None:
        """A change as keys: two where it goes straight, else close ones with their speeds."""
        address = Address.of(f"{change.name}.{change.property}", self._scene)
        rows = self._keys.get(address, {})
        inside = [time for time in rows if begin < time < end]
        if inside:
            raise SceneError(
                f"{address} has a key at {inside[0]:g} s already, between {begin:g} and {end:g} s"
            )
        steps = 1 if change.straight else math.ceil((end - begin) / CLOSE)
        begun = self._at(change.name, begin)
        written = dict(_keys(change, begun, begin, end, steps, change.ease or ease))
        if begin in rows:  # how the act before came to where this one begins
            written[begin] = replace(written[begin], in_tangent=rows[begin].in_tangent)
        self._keys[address] = {**rows, **written}

    def _at(self, name: str, time: float) -> Read:
        """Reads the properties of a thing at a time, as they are written so far."""
        return lambda what: self._read(Address.of(f"{name}.{what}", self._scene), time)

    def _free(self, name: str) -> str:
        """A name for a constraint that no other has."""
        taken = {constraint.name for constraint in self._scene.constraints}
        names = (name if count == 1 else f"{name} {count}" for count in range(1, len(taken) + 2))
        return next(one for one in names if one not in taken)


def _keys(
    change: Change, begun: Read, begin: float, end: float, steps: int, ease: Any
) -> Iterator[tuple[float, Key]]:
    """A change's keys: two and an easing where it goes straight, else many with their speeds."""
    if change.straight:
        first, last = (change.way(begun, np.array([part]))[0] for part in (0.0, 1.0))
        yield begin, Key(first, ease=ease)
        yield end, Key(last)
        return
    part_of_way = easing(ease)

    def value(times: FloatArray) -> FloatArray:
        return change.way(begun, part_of_way(times))

    parts = np.linspace(0, 1, steps + 1)
    before, after = np.maximum(parts - STEP, 0), np.minimum(parts + STEP, 1)
    values, moved = value(parts), value(after) - value(before)
    spans = ((after - before) * (end - begin)).reshape(-1, *[1] * (values.ndim - 1))
    for part, place, speed in zip(parts, values, moved / spans, strict=True):
        time = end if part == 1 else begin + part * (end - begin)
        yield time, Key(place, interpolation="cubic", in_tangent=speed, out_tangent=speed)


def _seconds(time: float) -> float:
    if not math.isfinite(time):
        raise SceneError(f"a key is at {time} s; a finite time is needed")
    return float(time)


def _positive(what: str, value: float | None) -> float:
    if value is None or not 0 < value < math.inf:
        raise SceneError(f"{what} is {value}; more than 0 is needed")
    return value
