"""Blocks of vertices: those that primitives of a mesh share, and what can be done to them together."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from eyeline.files.gltf.accessors import Numbers
from eyeline.files.gltf.primitives import Attributes, Primitive
from eyeline.geometry import normals
from eyeline.geometry.arrays import FloatArray, IntArray

SPARE = 2  # vertices are dropped where more than this many times the used ones are stored


@dataclass(frozen=True, eq=False)
class Block:
    """Vertices, the faces over them, and each face's material."""

    attributes: Attributes  # (V, width) float32
    targets: tuple[Attributes, ...]
    faces: IntArray  # (F, 3)
    materials: IntArray  # (F,) positions in the mesh's materials

    @property
    def count(self) -> int:
        """Vertices."""
        return len(self.attributes["POSITION"])

    def picked(self, source: IntArray, faces: IntArray) -> Block:
        """New faces over copies of the vertices that `source` (V',) names."""
        attributes = {name: values[source] for name, values in self.attributes.items()}
        targets = tuple({name: values[source] for name, values in target.items()} for target in self.targets)
        return replace(self, attributes=attributes, targets=targets, faces=faces)

    def with_attributes(self, attributes: Attributes) -> Block:
        """The same block with more or other attributes."""
        return replace(self, attributes={**self.attributes, **attributes})


def blocks_of(primitives: Sequence[Primitive], slots: Mapping[int | None, int]) -> list[Block]:
    """One block for all primitives that share their vertices; slots: where a material stands in the mesh."""
    shared: dict[int, list[Primitive]] = {}
    for one in primitives:
        shared.setdefault(id(one.vertices), []).append(one)
    blocks = []
    for group in shared.values():
        used = np.array([slots[one.material] for one in group], np.int32)
        materials = np.repeat(used, [len(one.faces) for one in group])
        faces = together([one.faces for one in group])
        vertices = group[0].vertices
        blocks.append(compact(Block(vertices.attributes, vertices.targets, faces, materials)))
    return blocks


def together(arrays: Sequence[Numbers]) -> Numbers:
    """Arrays one behind the other; one alone as it is."""
    return arrays[0] if len(arrays) == 1 else np.concatenate(arrays)


def compact(block: Block) -> Block:
    """The block without the vertices no face uses, where they are many."""
    used = np.zeros(block.count, dtype=bool)
    used[block.faces] = True
    if block.count <= SPARE * np.count_nonzero(used):
        return block
    number = np.cumsum(used, dtype=np.int32) - 1
    return block.picked(np.flatnonzero(used), number[block.faces])


def flat(block: Block) -> Block:
    """Every corner its own vertex, with the normal of its face. [glTF 2.0, 3.7.2.1]"""
    corners = block.faces.reshape(-1)
    block = block.picked(corners, np.arange(len(corners), dtype=np.int32).reshape(-1, 3))
    points = block.attributes["POSITION"]
    directions = normals.unit(normals.face_normals(points, block.faces), normals.SOMEWHERE)
    return block.with_attributes({"NORMAL": np.repeat(directions, 3, axis=0).astype(np.float32)})


def with_tangents(block: Block, uv_set: int) -> Block:
    """The block with tangents along a texture; a vertex where mirrored texture meets itself is split."""
    uv = block.attributes[f"TEXCOORD_{uv_set}"]
    block = split_mirrored(block, uv)
    points, directions = block.attributes["POSITION"], block.attributes["NORMAL"]
    along = normals.tangents(points, block.faces, directions, block.attributes[f"TEXCOORD_{uv_set}"])
    return block.with_attributes({"TANGENT": along})


def split_mirrored(block: Block, uv: FloatArray) -> Block:
    """Vertices between faces whose texture runs one way and the other become two. [Mikkelsen08]"""
    s, t, r = (uv[block.faces[:, k]].astype(np.float64) for k in range(3))
    mirrored = (t - s)[:, 0] * (r - s)[:, 1] < (t - s)[:, 1] * (r - s)[:, 0]
    if not mirrored.any() or mirrored.all():
        return block
    sided = 2 * block.faces.astype(np.int64) + mirrored[:, None]
    kept, faces = np.unique(sided, return_inverse=True)
    return block.picked(kept // 2, faces.reshape(-1, 3).astype(np.int32))
