"""Nodes: where things stand, and what stands there. [glTF 2.0, 3.5]"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from eyeline.errors import FileError
from eyeline.files.gltf.accessors import Accessors
from eyeline.files.gltf.cameras import camera_of
from eyeline.files.gltf.document import Document
from eyeline.files.gltf.instances import instances_of
from eyeline.files.gltf.lights import light_of
from eyeline.files.gltf.meshes import Meshes
from eyeline.files.gltf.part import Part, spoken
from eyeline.files.gltf.skins import check_fit, skin_of
from eyeline.files.gltf.targets import weights_of
from eyeline.files.gltf.tree import Tree
from eyeline.files.limits import FACES, INSTANCES, LARGEST
from eyeline.geometry import quaternion, transform
from eyeline.geometry.arrays import FloatArray
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.skin import Skin

TURN = 1e-2  # how far from one the length of a rotation may be before it is reported


@dataclass(frozen=True, eq=False)
class Nodes:
    """Makes the nodes of a scene."""

    document: Document
    accessors: Accessors
    meshes: Meshes
    tree: Tree
    _skins: dict[int, Skin] = field(default_factory=dict)

    def __call__(self) -> tuple[Node, ...]:
        """The nodes in the tree's order; names that files leave out are their numbers in the file."""
        every = self.document.all("nodes")
        pairs = zip(self.tree.order, self.tree.parents, strict=True)
        nodes = tuple(self._made(every[number], number, parent) for number, parent in pairs)
        standing = [
            (1 if node.instances is None else len(node.instances), node.mesh) for node in nodes if node.mesh
        ]
        faces = sum(count * len(mesh.faces) for count, mesh in standing)
        if faces > FACES:
            raise FileError(
                f"its nodes have {faces:,} faces, instances counted; at most {FACES:,} can be numbered"
            )
        if sum(count for count, _ in standing) - len(standing) > INSTANCES:
            raise FileError(f"its nodes have more than {INSTANCES:,} instances; use fewer")
        check_reach(nodes)
        return nodes

    def _made(self, part: Part, number: int, parent: int) -> Node:
        mesh = self.meshes(part.whole("mesh"), part.at("mesh")) if part.has("mesh") else None
        camera = (
            camera_of(self.document, part.whole("camera"), part.at("camera")) if part.has("camera") else None
        )
        light = part.extension("KHR_lights_punctual")
        shown = part.extension("KHR_node_visibility")
        translation = part.numbers("translation", (0.0, 0.0, 0.0))
        rotation = self._rotation(part)
        scale = part.numbers("scale", (1.0, 1.0, 1.0))
        return Node(
            part.name(f"node {number}"),
            parent,
            (translation[0], translation[1], translation[2]),
            rotation,
            (scale[0], scale[1], scale[2]),
            matrix_of(part),
            mesh,
            self._skin(part, mesh),
            None if mesh is None else weights_of(part, len(mesh.targets)),
            camera,
            None if light is None else light_of(self.document, light.whole("light"), light.at("light")),
            None if mesh is None else instances_of(self.accessors, part),
            shown is None or not shown.has("visible") or shown.flag("visible"),
        )

    def _rotation(self, part: Part) -> tuple[float, float, float, float]:
        given = part.numbers("rotation", quaternion.IDENTITY)
        length = float(np.sqrt(np.square(given).sum()))
        if abs(length - 1) > TURN:
            self.document.notes.add(f"{part.at('rotation')} has length {length:.3g}; it is scaled to 1")
        x, y, z, w = quaternion.normalized(given).tolist()
        return (x, y, z, w)

    def _skin(self, part: Part, mesh: Mesh | None) -> Skin | None:
        """The skin of a node; none if its mesh has no joints to follow it with."""
        if not part.has("skin") or mesh is None:
            return None
        index = part.whole("skin")
        skin = self.document.one("skins", index, part.at("skin"))
        if mesh.joints is None:
            self.document.notes.add(
                f"{part.place} has a skin, and mesh {spoken(mesh.name)} has no joints; it stays rigid"
            )
            return None
        if index not in self._skins:
            self._skins[index] = skin_of(self.accessors, skin, self.tree.node_of)
        check_fit(mesh, self._skins[index], part.place)
        return self._skins[index]


def check_reach(nodes: Sequence[Node]) -> None:
    """Refuse nodes that stand farther out, or are larger, than anything is."""
    # Reading a file must not wait for kernels to compile: Scene.world would
    placed: list[FloatArray] = []
    with np.errstate(over="ignore", invalid="ignore"):
        for node in nodes:
            matrix = node.parent_from_node
            placed.append(matrix if node.parent < 0 else placed[node.parent] @ matrix)
            if not (np.abs(placed[-1]) <= LARGEST).all():
                raise FileError(
                    f"node {spoken(node.name)} is moved or scaled beyond {LARGEST:g} metres; shrink it"
                )


def matrix_of(part: Part) -> FloatArray | None:
    """(4, 4) the matrix of a node, which the file gives column by column; None without."""
    if not part.has("matrix"):
        return None
    matrix = np.reshape(part.numbers("matrix", tuple(transform.identity().reshape(-1))), (4, 4)).T.copy()
    if (matrix[3] != (0, 0, 0, 1)).any():
        raise FileError(f"{part.at('matrix')} has last row {matrix[3].tolist()}; 0 0 0 1 is needed")
    return matrix
