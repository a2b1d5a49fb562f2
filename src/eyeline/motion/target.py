"""Where one track leads in one scene."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeVar

from eyeline.errors import SceneError
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.track import Track
from eyeline.scene.material import Material
from eyeline.scene.scene import Scene, suggestion

Thing = TypeVar("Thing")

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


@dataclass(frozen=True, eq=False)
class Target:
    """A property of a node or a material, and where a state of one time holds its value."""

    node: int  # -1: it is a material's
    material: str
    path: tuple[str, ...]  # names of fields, the last is what moves
    first: int  # column
    end: int
    scalar: bool
    low: float
    high: float

    @classmethod
    def of(cls, track: Track, node: int, first: int) -> Target:
        """The target of a track whose value stands at column `first`."""
        low, high = LIMITS.get(track.property, (-math.inf, math.inf))
        material = track.name if track.kind == "material" else ""
        scalar = track.curve.shape == ()
        return cls(
            node,
            material,
            tuple(track.property.split(".")),
            first,
            first + track.curve.width,
            scalar,
            low,
            high,
        )

    def value(self, state: FloatArray) -> Any:
        """What the property becomes."""
        numbers = tuple(state[self.first : self.end].tolist())
        if self.path == ("visible",):
            return numbers[0] > 0.5
        if self.low > -math.inf:
            numbers = tuple(min(max(number, self.low), self.high) for number in numbers)
        return numbers[0] if self.scalar else numbers

    def enter(self, changes: dict[str, Any], state: FloatArray) -> None:
        """Note the new value among a thing's changes, nested as the path is."""
        for name in self.path[:-1]:
            changes = changes.setdefault(name, {})
        changes[self.path[-1]] = self.value(state)


def changed(thing: Thing, changes: Mapping[str, Any]) -> Thing:
    """A frozen thing with other values; a mapping in place of a value changes the value in turn."""
    return replace(thing, **resolved(thing, changes))  # type: ignore[type-var]


def resolved(thing: object, changes: Mapping[str, Any]) -> dict[str, Any]:
    """The new values of a thing's fields, mappings among them followed to the end."""
    return {
        name: changed(getattr(thing, name), value) if isinstance(value, dict) else value
        for name, value in changes.items()
    }


def find(track: Track, scene: Scene, paths: Mapping[str, int], materials: Mapping[str, Material]) -> int:
    """The node a track leads to, -1 for a material.

    Refused: what is not there, and what has not the part that would move.
    """
    thing: object
    if track.kind == "material":
        node = -1
        if track.name not in materials:
            raise SceneError(f"there is no material {track.name!r}{suggestion(track.name, materials)}")
        thing = materials[track.name]
    else:
        node = paths[track.name] if track.name in paths else scene.find(track.name)
        thing = scene.nodes[node]
    *parts, last = track.property.split(".")
    for part in parts:
        thing = getattr(thing, part)
        if thing is None:
            raise SceneError(f"{track} leads nowhere: there is no {part} to move")
    if last in ("fov", "height") and getattr(thing, last) is None:
        raise SceneError(
            f"{track} leads nowhere: the camera is {'orthographic' if last == 'fov' else 'perspective'}"
        )
    if last == "weights":
        _refuse_weights(track, scene, node)
    return node


def _refuse_weights(track: Track, scene: Scene, node: int) -> None:
    mesh = scene.nodes[node].mesh
    targets = len(mesh.targets) if mesh is not None else 0
    if track.curve.shape != (targets,):
        raise SceneError(
            f"{track} has {track.curve.shape[0]} weights for {targets} morph targets; one for each is needed"
        )
