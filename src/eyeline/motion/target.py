"""Where one track leads in one scene."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from eyeline.deform.deformer import Deformer
from eyeline.errors import SceneError, suggestion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.track import OPEN, Track
from eyeline.scene.camera import fov_of
from eyeline.scene.material import Material
from eyeline.scene.scene import Scene

# What a spline may not overshoot: no thing can be made with more or less.
LIMITS: dict[str, tuple[float, float]] = {
    "metallic": (0, 1),
    "roughness": (0, 1),
    "occlusion_strength": (0, 1),
    "alpha_cutoff": (0, 1),
    "base_color": (0, math.inf),
    "emissive": (0, math.inf),
    "light.color": (0, math.inf),
    "light.intensity": (0, math.inf),
    "light.range": (0, math.inf),
    "light.inner_cone": (0, math.pi / 2),
    "light.outer_cone": (0, math.pi / 2),
}

# Properties that things hold in another form: the field's name, and its value.
CONVERSIONS: dict[str, tuple[str, Callable[[float], float]]] = {"focal_length": ("fov", fov_of)}


@dataclass(frozen=True, eq=False)
class Target:
    """A property of a node or a material, and where a state of one time holds its value."""

    node: int  # -1: it is a material's
    material: str
    path: tuple[str, ...]  # names of fields, the last is what moves
    first: int  # column
    end: int
    shape: tuple[int, ...]
    low: float
    high: float

    @classmethod
    def of(cls, track: Track, node: int, first: int) -> Target:
        """The target of a track whose value stands at column `first`."""
        low, high = LIMITS.get(track.property, (-math.inf, math.inf))
        material = track.name if track.kind == "material" else ""
        end, shape = first + track.curve.width, track.curve.shape
        return cls(node, material, fields_of(track.property), first, end, shape, low, high)

    def value(self, state: FloatArray) -> Any:
        """What the property becomes."""
        numbers = tuple(state[self.first : self.end].tolist())
        if self.path == ("visible",):
            return numbers[0] > 0.5
        if self.low > -math.inf:
            numbers = tuple(min(max(number, self.low), self.high) for number in numbers)
        if len(self.shape) > 1:
            return np.array(numbers).reshape(self.shape)
        return numbers if self.shape else numbers[0]

    def enter(self, changes: dict[str, Any], state: FloatArray) -> None:
        """Note the new value among a thing's changes, nested as the path is; NaN is none."""
        if math.isnan(state[self.first]):
            return
        for name in self.path[:-1]:
            changes = changes.setdefault(name, {})
        name, value = self.path[-1], self.value(state)
        if name in CONVERSIONS:
            name, convert = CONVERSIONS[name]
            value = convert(value)
        changes[name] = value


def fields_of(property_name: str) -> tuple[str, ...]:
    """The names that lead from a thing to what moves; what stands under an open name is one name."""
    first, _, rest = property_name.partition(".")
    return (first, rest) if first in OPEN else tuple(property_name.split("."))


def changed(thing: Any, changes: Mapping[str, Any]) -> Any:
    """A frozen thing with other values; a mapping in place of a value changes the value in turn."""
    match thing:
        case Deformer():
            return thing.changed(changes)
        case Mapping():
            return {**thing, **changes}
    return replace(thing, **resolved(thing, changes))


def resolved(thing: object, changes: Mapping[str, Any]) -> dict[str, Any]:
    """The new values of a thing's fields, mappings among them followed to the end."""
    return {
        name: changed(getattr(thing, name), value) if isinstance(value, dict) else value
        for name, value in changes.items()
    }


def numbers_of(thing: Any) -> dict[str, Any]:
    """Everything that a thing holds by name and that tracks can move."""
    match thing:
        case Deformer():
            return dict(thing.parameters)
        case Mapping():
            return dict(thing)
    return {name: value for name, value in vars(thing).items() if isinstance(value, NUMBERS)}


NUMBERS = (int, float, tuple, np.ndarray)


def find(
    track: Track, scene: Scene, paths: Mapping[str, int], materials: Mapping[str, Material]
) -> tuple[int, FloatArray]:
    """The node a track leads to, -1 for a material or a constraint, and the value at rest, NaN where is none.

    Refused: what is not there, and what has not the part that would move.
    """
    thing: object
    node = -1
    if track.kind == "node":
        node = paths[track.name] if track.name in paths else scene.find(track.name)
        thing = scene.nodes[node]
    else:
        rules = {constraint.name: constraint for constraint in scene.constraints}
        things: Mapping[str, object] = materials if track.kind == "material" else rules
        if track.name not in things:
            raise SceneError(f"there is no {track.kind} {track.name!r}{suggestion(track.name, things)}")
        thing = things[track.name]
    *parts, last = fields_of(track.property)
    for name in parts:
        thing = getattr(thing, name)
        if thing is None:
            raise SceneError(f"{track} leads nowhere: there is no {name} to move")
    field = CONVERSIONS[last][0] if last in CONVERSIONS else last
    if field in ("fov", "height") and getattr(thing, field) is None:
        raise SceneError(
            f"{track} leads nowhere: the camera is {'orthographic' if field == 'fov' else 'perspective'}"
        )
    if track.is_open():
        _refuse_shape(track, thing, last)
    if last == "weights" and track.kind == "node":
        _refuse_weights(track, scene, node)
    return node, _rest(thing, last, track.curve.width)


def _rest(thing: Any, name: str, width: int) -> FloatArray:
    """The numbers a thing holds under a name."""
    value = numbers_of(thing).get(name, getattr(thing, name, None))
    if value is None or np.size(value) != width:
        return np.full(width, np.nan)
    return np.asarray(value, dtype=np.float64).reshape(-1)


def _refuse_shape(track: Track, thing: object, name: str) -> None:
    """What moves must be numbers, as many as the curve has."""
    numbers = numbers_of(thing)
    if name not in numbers:
        raise SceneError(f"{track} leads nowhere{suggestion(name, numbers)}")
    shape = np.shape(numbers[name])
    if shape != track.curve.shape:
        raise SceneError(f"{track} has values of shape {track.curve.shape}; {shape} is needed")


def _refuse_weights(track: Track, scene: Scene, node: int) -> None:
    mesh = scene.nodes[node].mesh
    targets = len(mesh.targets) if mesh is not None else 0
    if track.curve.shape != (targets,):
        raise SceneError(
            f"{track} has {track.curve.shape[0]} weights for {targets} morph targets; one for each is needed"
        )
