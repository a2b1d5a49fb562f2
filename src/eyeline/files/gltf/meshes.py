"""Meshes: all primitives of one joined, with morph targets and influences. [glTF 2.0, 3.7.2]"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from eyeline.errors import FileError
from eyeline.files.gltf.blocks import Block, blocks_of, flat, with_tangents
from eyeline.files.gltf.directions import straightened
from eyeline.files.gltf.document import Document
from eyeline.files.gltf.influences import influences_of
from eyeline.files.gltf.materials import Materials
from eyeline.files.gltf.part import Part
from eyeline.files.gltf.primitives import UV_SETS, Primitives
from eyeline.geometry.arrays import FloatArray
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh, MorphTarget

FILL: dict[str, tuple[float, ...]] = {
    "TANGENT": (1, 0, 0, 1),
    "TEXCOORD_0": (0, 0),
    "TEXCOORD_1": (0, 0),
    "COLOR_0": (1, 1, 1, 1),
}
TARGET_WIDTHS = {"POSITION": 3, "NORMAL": 3, "TANGENT": 3, "TEXCOORD_0": 2, "TEXCOORD_1": 2, "COLOR_0": 4}


@dataclass(frozen=True, eq=False)
class Meshes:
    """The meshes of a document, each made once."""

    document: Document
    primitives: Primitives
    materials: Materials
    _meshes: dict[int, Mesh | None] = field(default_factory=dict)

    def __call__(self, index: int, place: str) -> Mesh | None:
        """The mesh that `place` names; None if none of it is drawn."""
        if index not in self._meshes:
            part = self.document.one("meshes", index, place)
            self._meshes[index] = self._made(part, part.name(f"mesh {index}"))
        return self._meshes[index]

    def _made(self, part: Part, name: str) -> Mesh | None:
        read = (self.primitives(one, name) for one in part.parts("primitives"))
        drawn = [one for one in read if one is not None and len(one.faces)]
        if not drawn:
            self.document.notes.add(f"mesh {name!r} has no faces")
            return None
        used = tuple(dict.fromkeys(one.material for one in drawn))
        materials = [self.materials(number, part.place) for number in used]
        blocks = blocks_of(drawn, {number: slot for slot, number in enumerate(used)})
        blocks = completed([straightened(block, name, self.document.notes) for block in blocks], materials)
        counts = [block.count for block in blocks]
        width = sum(values.shape[1] for values in blocks[0].attributes.values())
        self.document.numbers.spend(sum(counts) * width, part.place)
        first = np.cumsum([0, *counts[:-1]])
        joints, influences = influences_of(blocks, name, self.document.notes)
        targets = targets_of(blocks, target_names(part))
        return Mesh(
            joined(blocks, "POSITION"),
            np.concatenate([block.faces + start for block, start in zip(blocks, first, strict=True)]),
            joined(blocks, "NORMAL") if "NORMAL" in blocks[0].attributes else None,
            joined(blocks, "TANGENT") if "TANGENT" in blocks[0].attributes else None,
            tuple(
                joined(blocks, f"TEXCOORD_{k}")
                for k in range(UV_SETS)
                if f"TEXCOORD_{k}" in blocks[0].attributes
            ),
            joined(blocks, "COLOR_0") if "COLOR_0" in blocks[0].attributes else None,
            materials=materials,
            face_material=np.concatenate([block.materials for block in blocks])
            if len(materials) > 1
            else None,
            targets=targets,
            weights=weights_of(part, len(targets)) or (0.0,) * len(targets),
            joints=joints,
            influences=influences,
            name=name,
        )


def completed(blocks: Sequence[Block], materials: Sequence[Material]) -> list[Block]:
    """Blocks that all have the same attributes."""
    wanted = {name for block in blocks for name in block.attributes if name in FILL}
    if "TEXCOORD_1" in wanted:
        wanted.add("TEXCOORD_0")
    normal_sets = [normal_uv_set(block, materials) for block in blocks]
    shaded = any("NORMAL" in block.attributes for block in blocks) or any(
        one is not None for one in normal_sets
    )
    made = []
    for block, uv_set in zip(blocks, normal_sets, strict=True):
        if shaded and "NORMAL" not in block.attributes:
            block = flat(block)
        if uv_set is not None and "TANGENT" not in block.attributes:
            block = with_tangents(block, uv_set)
            wanted.add("TANGENT")
        made.append(block)
    missing = [wanted - block.attributes.keys() for block in made]
    return [
        block.with_attributes(
            {name: np.tile(np.array(FILL[name], np.float32), (block.count, 1)) for name in names}
        )
        for block, names in zip(made, missing, strict=True)
    ]


def normal_uv_set(block: Block, materials: Sequence[Material]) -> int | None:
    """The UV set along which a block needs tangents; None if no normal texture lies on it."""
    for slot in np.unique(block.materials):
        texture = materials[int(slot)].normal_texture
        if texture is not None and f"TEXCOORD_{texture.uv_set}" in block.attributes:
            return texture.uv_set
    return None


def joined(blocks: Sequence[Block], name: str) -> FloatArray:
    """(V, width) an attribute of all blocks."""
    return np.concatenate([block.attributes[name] for block in blocks])


def targets_of(blocks: Sequence[Block], names: Sequence[str]) -> tuple[MorphTarget, ...]:
    """The morph targets of all blocks; no difference where a block says none."""
    count = max(len(block.targets) for block in blocks)
    targets = []
    for number in range(count):
        parts = [block.targets[number] if number < len(block.targets) else {} for block in blocks]
        whole: dict[str, FloatArray] = {}
        for name, width in TARGET_WIDTHS.items():
            if any(name in part for part in parts):
                pieces = [
                    part[name] if name in part else np.zeros((block.count, width), np.float32)
                    for part, block in zip(parts, blocks, strict=True)
                ]
                whole[name] = np.concatenate(pieces)
        vertices = sum(block.count for block in blocks)
        uv = [whole.get(f"TEXCOORD_{k}") for k in range(UV_SETS)]
        while uv and uv[-1] is None:
            uv.pop()
        targets.append(
            MorphTarget(
                whole.get("POSITION"),
                whole.get("NORMAL"),
                whole.get("TANGENT"),
                tuple(np.zeros((vertices, 2), np.float32) if one is None else one for one in uv),
                whole.get("COLOR_0"),
                names[number] if number < len(names) else f"target {number}",
            )
        )
    return tuple(targets)


def target_names(part: Part) -> list[str]:
    """What the morph targets are called: a custom that most exporters follow, so never refused."""
    extras = part.values.get("extras")
    names = extras.get("targetNames") if isinstance(extras, dict) else None
    if not isinstance(names, list):
        return []
    return [name if isinstance(name, str) else f"target {number}" for number, name in enumerate(names)]


def weights_of(part: Part, count: int) -> tuple[float, ...] | None:
    """The weights of the morph targets that a mesh or a node gives; None where it gives none."""
    if not part.has("weights"):
        return None
    weights = part.listed("weights")
    if len(weights) != count:
        raise FileError(f"{part.at('weights')} has {len(weights)} numbers for {count} morph targets")
    return part.numbers("weights", (0.0,) * count)
