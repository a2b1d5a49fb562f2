"""Nodes: the tree, what stands in it, skins and instances. [glTF 2.0, 3.5]"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, field

import numpy as np

from eyeline.files.gltf.writing.lenses import camera_of, light_number
from eyeline.files.gltf.writing.meshes import Meshes
from eyeline.files.gltf.writing.placing import is_sheared, parts_of, unsheared
from eyeline.files.gltf.writing.store import Store, Thing, named, numbers
from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene
from eyeline.scene.skin import Skin


@dataclass(frozen=True, eq=False)
class Nodes:
    """Writes the nodes of a scene; a node keeps its number, and those the format needs besides follow."""

    store: Store
    meshes: Meshes
    note: Callable[[str], None]
    scene: Scene
    placed: Collection[int]  # nodes whose translation, rotation or scale a clip moves
    hidden: Collection[int]  # nodes that a clip hides or shows
    bearers: dict[int, list[int]] = field(default_factory=dict)  # node -> nodes of the file with its mesh
    _skins: dict[int, int] = field(default_factory=dict)

    def __call__(self) -> list[int]:
        """The numbers of the roots."""
        holders = list(range(len(self.scene.nodes)))
        things = self.store.lists.setdefault("nodes", [])
        things.extend({} for _ in holders)
        roots: list[int] = []
        for index, node in enumerate(self.scene.nodes):
            thing = things[index] = named(node.name, {})
            below = roots if node.parent < 0 else things[holders[node.parent]].setdefault("children", [])
            below.append(index)
            if node.matrix is not None and index not in self.placed and is_sheared(node.matrix):
                holders[index] = self._split(index, node.matrix)
            else:
                thing |= parts_of(node, index in self.placed)
            self._fill(things[holders[index]], holders[index], index)
            if not node.visible or index in self.hidden:
                self._extend(thing, "KHR_node_visibility", {"visible": node.visible})
            if node.controls:
                thing["extras"] = dict(node.controls)
        return roots

    def _split(self, index: int, matrix: FloatArray) -> int:
        """The number of a node inside one that shears, so that both stand without shear."""
        path = self.scene.paths[index]
        self.note(f"node {path!r} shears, which glTF has no matrix for; a node is put inside it")
        outer, inner = unsheared(matrix)
        self.store.lists["nodes"][index] |= parts_of(Node(matrix=outer), moves=True)
        inside = self.store.add("nodes", {"name": "shear", **parts_of(Node(matrix=inner), moves=True)})
        self.store.lists["nodes"][index].setdefault("children", []).append(inside)
        return inside

    def _fill(self, thing: Thing, number: int, index: int) -> None:
        """Put a mesh, a camera and a light where they stand."""
        node = self.scene.nodes[index]
        if node.camera is not None:
            thing["camera"] = self.store.add("cameras", camera_of(node.camera, self.scene.bounds, self.note))
        if node.light is not None:
            light = light_number(self.store, node.light)
            self._extend(thing, "KHR_lights_punctual", {"light": light})
        mesh = None if node.mesh is None else self.meshes(node.mesh)
        if mesh is None or node.mesh is None:
            return
        worn: Thing = {"mesh": mesh}
        if node.weights is not None and node.mesh.targets:
            worn["weights"] = numbers(node.weights)
        if node.skin is not None and node.mesh.joints is not None and node.skin.joints:
            worn["skin"] = self._skin(node.skin)
        if node.instances is None or "skin" in worn:
            thing |= worn
            self.bearers[index] = [number]
        else:
            self._stand(thing, number, index, worn)

    def _stand(self, thing: Thing, number: int, index: int, worn: Thing) -> None:
        """Let a mesh stand many times; once for each node where an instance shears."""
        instances = self.scene.nodes[index].instances
        assert instances is not None
        path = self.scene.paths[index]
        if len(instances) and not any(map(is_sheared, instances)):
            parts = transform.decompose(instances)
            columns = zip(("TRANSLATION", "ROTATION", "SCALE"), parts, strict=True)
            attributes = {name: self.store.accessor(one.astype(np.float32)) for name, one in columns}
            thing |= worn
            self._extend(thing, "EXT_mesh_gpu_instancing", {"attributes": attributes})
            self.bearers[index] = [number]
            self.note(f"node {path!r} has instances; a player without EXT_mesh_gpu_instancing shows one")
            return
        self.note(f"the {len(instances)} instances of node {path!r} become nodes of their own")
        self.bearers[index] = []
        for place in instances:
            outer, inner = unsheared(place)
            inside = self.store.add("nodes", {**parts_of(Node(matrix=inner), moves=True), **worn})
            around = self.store.add(
                "nodes", {**parts_of(Node(matrix=outer), moves=True), "children": [inside]}
            )
            thing.setdefault("children", []).append(around)
            self.bearers[index].append(inside)

    def _skin(self, skin: Skin) -> int:
        if id(skin) not in self._skins:
            if skin.blending != "linear":
                self.note(f"skin {skin.name!r} blends by dual quaternions; glTF's skins blend linearly")
            matrices = np.asarray(skin.joint_from_mesh, dtype=np.float32)
            thing = {"joints": list(skin.joints), "inverseBindMatrices": self.store.accessor(matrices)}
            self._skins[id(skin)] = self.store.add("skins", named(skin.name, thing))
        return self._skins[id(skin)]

    def _extend(self, thing: Thing, name: str, values: Thing) -> None:
        thing.setdefault("extensions", {}).update(self.store.extended(name, values)["extensions"])
