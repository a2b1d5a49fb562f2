"""A clip bound to a scene: what was looked up once, followed at every time."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from eyeline.errors import SceneError
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.motion.bundle import Bundle
from eyeline.motion.target import Target, changed, fields_of, find, resolved
from eyeline.motion.track import Track
from eyeline.scene.constraint import Constraint
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.pose import Samples, differences, found, solved
from eyeline.scene.scene import Scene

Address = tuple[str, int, str, str]  # kind, node or -1, name where there is no node, property

PARTS = {"translation": (0, 3), "rotation": (3, 4), "scale": (7, 3)}  # of a node's ten columns


@dataclass(frozen=True, eq=False)
class Plan:
    """The columns of a state, what fills them, and where they go.

    A state is flat: T rows of N translations, T rows of N rotations, T rows of N scales, then a block of T
    rows for the morph weights of each node that has some, and one for each other property that moves.
    """

    places: Mapping[Address, tuple[int, int, int]]  # columns before the block, its width, the column in it
    blocks: tuple[int, ...]  # (B + 1,) where blocks of columns begin, and their end
    rest: FloatArray  # (columns,) the scene as it stands; NaN where it has no number
    parents: IntArray  # (N,)
    weights: Mapping[int, tuple[int, int]]  # node -> first column and end of its morph weights
    targets: tuple[Target, ...]
    unfolded: Mapping[int, Mapping[str, Any]]  # moved nodes that were given as a matrix -> their parts
    fixed: Mapping[int, FloatArray]  # nodes that stay where a matrix puts them
    painted: Mapping[str, Sequence[int]]  # moved material -> the nodes whose meshes wear it
    steered: Mapping[str, Mapping[str, tuple[int, tuple[int, ...]]]]  # constraint -> number -> column, shape
    controls: Mapping[int, Mapping[str, tuple[int, float]]]  # node -> name -> column or -1, value at rest
    constraints: tuple[Constraint, ...]
    paths: tuple[str, ...]

    @classmethod
    def of(cls, tracks: Sequence[Track], scene: Scene) -> Plan:
        """Columns for everything that tracks move, once each. Refused: a track of what is not there."""
        still = Samples.still(scene, 1)
        materials, wearers = _materials(scene)
        paths = {path: index for index, path in enumerate(scene.paths)}
        leads = [(track, *find(track, scene, paths, materials)) for track in tracks]
        first = {address(track, node): (track, node, rest) for track, node, rest in reversed(leads)}
        tracks, nodes, resting = zip(*reversed(first.values()), strict=True) if first else ((), (), ())
        weights, places, blocks = _columns(tracks, nodes, still)
        moved = {node for track, node in zip(tracks, nodes, strict=True) if track.property in PARTS}
        rest = [still.translation, still.rotation, still.scale, *still.weights.values()]
        own = sum(part.size for part in rest)
        rest += [value for value, place in zip(resting, places, strict=True) if place[0] >= own]
        columns = [before + column for before, _, column in places]
        led = list(zip(tracks, nodes, columns, strict=True))
        return cls(
            places=dict(zip(map(address, tracks, nodes), places, strict=True)),
            blocks=blocks,
            rest=np.concatenate([part.reshape(-1) for part in rest]),
            parents=still.parents,
            weights=weights,
            targets=tuple(Target.of(*one) for one in led if one[0].kind != "constraint"),
            unfolded={node: _parts(still, node) for node in moved & set(still.fixed)},
            fixed={node: matrix for node, matrix in still.fixed.items() if node not in moved},
            painted={track.name: wearers[track.name] for track in tracks if track.kind == "material"},
            steered=_steered(led),
            controls=_controls(led, scene),
            constraints=scene.constraints,
            paths=scene.paths,
        )

    def bundle(self, tracks: Sequence[Track]) -> Bundle:
        """Curves that fill the columns of their tracks. Refused: two of the same."""
        places: dict[Address, tuple[int, int, int]] = {}
        for track in tracks:
            target = self.address(track)
            if target in places:
                raise SceneError(f"{track} is there twice; one curve for a property is needed")
            places[target] = self.places[target]
        rows = np.array(list(places.values()), np.int64).reshape(-1, 3)
        return Bundle.of([track.curve for track in tracks], rows, len(self.rest))

    def address(self, track: Track) -> Address:
        """What a track moves, however its node is named."""
        return address(track, found(track.name, self.paths) if track.kind == "node" else -1)

    def at_rest(self, count: int) -> FloatArray:
        """A state of `count` times the scene as it stands."""
        state = np.empty(count * len(self.rest))
        for first, end in pairwise(self.blocks):
            _block(state, first, end, count)[:] = self.rest[first:end]
        return state

    def column(self, state: FloatArray, target: Address, width: int, count: int) -> FloatArray:
        """One property's values (count, width) in a state, as a view."""
        before, stride, column = self.places[target]
        return _block(state, before, before + stride, count)[:, column : column + width]

    def posed(self, scene: Scene, state: FloatArray) -> Scene:
        """The scene in a state of one time, without clips; what no track moves stays the same object."""
        nodes: dict[int, dict[str, Any]] = {node: dict(parts) for node, parts in self.unfolded.items()}
        materials: dict[str, dict[str, Any]] = {}
        for target in self.targets:
            changes = (
                nodes.setdefault(target.node, {})
                if target.node >= 0
                else materials.setdefault(target.material, {})
            )
            target.enter(changes, state)
        for node, mesh in self._painted(scene, materials).items():
            nodes.setdefault(node, {})["mesh"] = mesh
        pose = None
        if self.constraints:
            before = self._samples(state, 1)
            pose = self._solved(before, state, 1)
            for node, changes in differences(before, pose).items():
                nodes.setdefault(node, {}).update(changes)
        posed = scene.with_changes(
            {node: resolved(scene.nodes[node], changes) for node, changes in nodes.items()}
        )
        return posed if pose is None else posed.bent(pose)

    def sampled(self, state: FloatArray, count: int) -> Samples:
        """All node transforms and morph weights of a state of `count` times."""
        pose = self._samples(state, count)
        return self._solved(pose, state, count) if self.constraints else pose

    def _samples(self, state: FloatArray, count: int) -> Samples:
        """A state of `count` times, unsolved, as views of it."""
        nodes = len(self.parents)
        parts = [
            _block(state, first * nodes, (first + width) * nodes, count).reshape(count, nodes, width)
            for first, width in PARTS.values()
        ]
        return Samples(
            parts[0],
            parts[1],
            parts[2],
            {node: _block(state, first, end, count) for node, (first, end) in self.weights.items()},
            self.parents,
            self.fixed,
            {node: _numbers(state, names, count) for node, names in self.controls.items()},
            self.paths,
        )

    def _solved(self, pose: Samples, state: FloatArray, count: int) -> Samples:
        """A pose of `count` times with the constraints kept."""
        moved = {
            constraint: {
                name: _block(state, column, column + math.prod(shape), count).reshape(count, *shape)
                for name, (column, shape) in numbers.items()
            }
            for constraint, numbers in self.steered.items()
        }
        return solved(pose, self.constraints, moved)

    def _painted(self, scene: Scene, changes: Mapping[str, dict[str, Any]]) -> dict[int, Mesh]:
        """The meshes that wear materials with changes, by node; a mesh that stands twice is changed once."""
        materials: dict[int, Material] = {}
        meshes: dict[int, Mesh] = {}
        painted: dict[int, Mesh] = {}
        for node in {node for name in changes for node in self.painted[name]}:
            mesh = scene.nodes[node].mesh
            assert mesh is not None
            if id(mesh) not in meshes:
                for material in mesh.materials:
                    if id(material) not in materials:
                        materials[id(material)] = changed(material, changes.get(material.name, {}))
                worn = tuple(materials[id(material)] for material in mesh.materials)
                meshes[id(mesh)] = mesh.changed(materials=worn)
            painted[node] = meshes[id(mesh)]
        return painted


def address(track: Track, node: int) -> Address:
    """What a track moves in a scene."""
    return track.kind, node, track.name if node < 0 else "", track.property


def _block(state: FloatArray, first: int, end: int, count: int) -> FloatArray:
    """The columns first to end of a state of `count` times, as a view (count, end - first)."""
    return state[first * count : end * count].reshape(count, end - first)


def _numbers(state: FloatArray, names: Mapping[str, tuple[int, float]], count: int) -> dict[str, FloatArray]:
    """A node's controls (T,) by name, moved ones from their columns."""
    return {
        name: np.full(count, rest) if column < 0 else _block(state, column, column + 1, count)[:, 0]
        for name, (column, rest) in names.items()
    }


def _steered(led: Sequence[tuple[Track, int, int]]) -> dict[str, dict[str, tuple[int, tuple[int, ...]]]]:
    """Where the numbers of constraints stand that tracks move."""
    steered: dict[str, dict[str, tuple[int, tuple[int, ...]]]] = {}
    for track, _, column in led:
        if track.kind == "constraint":
            steered.setdefault(track.name, {})[track.property] = (column, track.curve.shape)
    return steered


def _controls(led: Sequence[tuple[Track, int, int]], scene: Scene) -> dict[int, dict[str, tuple[int, float]]]:
    """Every node's controls: the column of the track that moves one, -1 without, and its value at rest."""
    controls = {
        index: {name: (-1, float(value)) for name, value in node.controls.items()}
        for index, node in enumerate(scene.nodes)
        if node.controls
    }
    for track, node, column in led:
        first, *name = fields_of(track.property)
        if node >= 0 and first == "controls":
            controls[node][name[0]] = (column, 0.0)
    return controls


def _columns(
    tracks: Sequence[Track], nodes: Sequence[int], still: Samples
) -> tuple[dict[int, tuple[int, int]], list[tuple[int, int, int]], tuple[int, ...]]:
    """Each node's weights, each track's place as `Bundle.of` takes it, and where blocks begin and end."""
    count = len(still.parents)
    blocks = [0, 3 * count, 7 * count, 10 * count]
    weights = {}
    for node, values in still.weights.items():
        weights[node] = (blocks[-1], blocks[-1] + values.shape[1])
        blocks.append(weights[node][1])
    places = []
    for track, node in zip(tracks, nodes, strict=True):
        if track.property in PARTS:
            before, width = PARTS[track.property]
            places.append((before * count, width * count, width * node))
        elif track.property == "weights":
            places.append((weights[node][0], track.curve.width, 0))
        else:
            places.append((blocks[-1], track.curve.width, 0))
            blocks.append(blocks[-1] + track.curve.width)
    return weights, places, tuple(blocks)


def _materials(scene: Scene) -> tuple[dict[str, Material], dict[str, list[int]]]:
    """Materials by name, and the nodes whose meshes wear each."""
    materials: dict[str, Material] = {}
    wearers: dict[str, list[int]] = {}
    for index, node in enumerate(scene.nodes):
        for name, material in {one.name: one for one in (node.mesh.materials if node.mesh else ())}.items():
            materials.setdefault(name, material)
            wearers.setdefault(name, []).append(index)
    return materials, wearers


def _parts(still: Samples, node: int) -> dict[str, Any]:
    """What a node given as a matrix is given as instead."""
    return {
        "matrix": None,
        "translation": tuple(still.translation[0, node].tolist()),
        "rotation": tuple(still.rotation[0, node].tolist()),
        "scale": tuple(still.scale[0, node].tolist()),
    }
