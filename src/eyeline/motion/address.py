"""What an author calls a thing that moves: one string, as "lamp/arm.rotation" or "clay.roughness"."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from eyeline.errors import SceneError, suggestion
from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.target import numbers_of
from eyeline.motion.track import OPEN, SHAPES, Kind
from eyeline.scene.deformation import weights_of
from eyeline.scene.material import Material
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene


@dataclass(frozen=True)
class Address:
    """A property of a node, a material or a constraint of one scene."""

    kind: Kind
    name: str
    property: str

    @classmethod
    def of(cls, text: str, scene: Scene) -> Address:
        """The address a text means; the name may be the end of a path. Refused: what is not there."""
        found = list(_meant(text, scene))
        if len(found) == 1:
            return found[0]
        if found:
            kinds = " and ".join(f"{one.kind} {one.name!r}" for one in found)
            raise SceneError(f"{text!r} is a property of {kinds}; give the whole path")
        raise SceneError(f"nothing in the scene is called {text!r}{suggestion(text, _all(scene))}")

    def __str__(self) -> str:
        return f"{self.name}.{self.property}"

    def turns(self) -> bool:
        """Whether its values are rotations."""
        return self.kind == "node" and self.property == "rotation"

    def at_rest(self, scene: Scene) -> FloatArray:
        """Its value in the scene as it stands."""
        if self.kind == "node":
            return _of_node(scene.nodes[scene.find(self.name)], self.property)
        things: Mapping[str, Any] = _materials(scene) if self.kind == "material" else _constraints(scene)
        return _of(things[self.name], self.property)


def _of_node(node: Node, name: str) -> FloatArray:
    first, _, rest = name.partition(".")
    if first in OPEN:
        return np.asarray(numbers_of(getattr(node, first))[rest], dtype=np.float64)
    if name == "weights":
        return np.array(weights_of(node, node.mesh) if node.mesh is not None else (), dtype=np.float64)
    parts = ("translation", "rotation", "scale")
    if node.matrix is not None and name in parts:
        value: FloatArray = transform.decompose(node.matrix)[parts.index(name)]
        return value
    return _of(node, name)


def _of(thing: object, name: str) -> FloatArray:
    for part in name.split("."):
        thing = getattr(thing, part)
        if thing is None:
            raise SceneError(f"there is no {part} to move by {name!r}; give the thing one first")
    return np.asarray(thing, dtype=np.float64)


def _meant(text: str, scene: Scene) -> Iterator[Address]:
    """Everything a text can mean: it is cut at each dot, names may have dots of their own."""
    cuts = [index for index, letter in enumerate(text) if letter == "."]
    for cut in cuts:
        name, what = text[:cut], text[cut + 1 :]
        ends = [path for path in scene.paths if path == name or path.endswith("/" + name)]
        nodes = [name] if name in ends else ends
        yield from (Address("node", path, what) for path in nodes if _node_has(scene, path, what))
        if name in _materials(scene) and what in SHAPES["material"]:
            yield Address("material", name, what)
        if name in (rules := _constraints(scene)) and what in numbers_of(rules[name]):
            yield Address("constraint", name, what)


def _node_has(scene: Scene, path: str, what: str) -> bool:
    node = scene.nodes[scene.paths.index(path)]
    first, _, rest = what.partition(".")
    if first in OPEN:
        return getattr(node, first) is not None and rest in numbers_of(getattr(node, first))
    return what in SHAPES["node"] and (first == what or getattr(node, first) is not None)


def _all(scene: Scene) -> Iterator[str]:
    """Every address there is, for a sentence that refuses one."""
    for path, node in zip(scene.paths, scene.nodes, strict=True):
        yield from (f"{path}.{what}" for what in SHAPES["node"] if _node_has(scene, path, what))
        for first in OPEN:
            yield from (f"{path}.{first}.{name}" for name in numbers_of(getattr(node, first) or {}))
    yield from (f"{name}.{what}" for name in _materials(scene) for what in SHAPES["material"])
    for name, rule in _constraints(scene).items():
        yield from (f"{name}.{what}" for what in numbers_of(rule))


def _materials(scene: Scene) -> dict[str, Material]:
    found: dict[str, Material] = {}
    for node in scene.nodes:
        for material in node.mesh.materials if node.mesh else ():
            found.setdefault(material.name, material)
    return found


def _constraints(scene: Scene) -> dict[str, Any]:
    return {constraint.name: constraint for constraint in scene.constraints}
