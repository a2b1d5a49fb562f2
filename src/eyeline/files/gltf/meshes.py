"""Meshes: all primitives of one joined, with morph targets and influences. [glTF 2.0, 3.7.2]"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import accumulate

from eyeline.files.gltf.attributes import UV_SETS
from eyeline.files.gltf.blocks import Block, blocks_of, together
from eyeline.files.gltf.completion import completed
from eyeline.files.gltf.directions import straightened
from eyeline.files.gltf.document import Document
from eyeline.files.gltf.influences import influences_of
from eyeline.files.gltf.materials import Materials
from eyeline.files.gltf.part import Part, spoken
from eyeline.files.gltf.primitives import Primitives
from eyeline.files.gltf.targets import target_names, targets_of, weights_of
from eyeline.geometry.arrays import FloatArray
from eyeline.scene.mesh import Mesh


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
            self.document.notes.add(f"mesh {spoken(name)} has no faces")
            return None
        used = tuple(dict.fromkeys(one.material for one in drawn))
        materials = [self.materials(number, part.place) for number in used]
        blocks = blocks_of(drawn, {number: slot for slot, number in enumerate(used)})
        blocks = completed([straightened(block, name, self.document.notes) for block in blocks], materials)
        width = sum(values.shape[1] for values in blocks[0].attributes.values())
        self.document.numbers.spend(sum(block.count for block in blocks) * width, part.place)
        joints, influences = influences_of(blocks, name, self.document.notes)
        targets = targets_of(blocks, target_names(part))
        uv = (joined(blocks, f"TEXCOORD_{number}") for number in range(UV_SETS))
        first = accumulate((block.count for block in blocks), initial=0)
        return Mesh(
            together([block.attributes["POSITION"] for block in blocks]),
            together([block.faces + start for block, start in zip(blocks, first, strict=False)]),
            joined(blocks, "NORMAL"),
            joined(blocks, "TANGENT"),
            [one for one in uv if one is not None],
            joined(blocks, "COLOR_0"),
            materials=materials,
            face_material=together([block.materials for block in blocks]) if len(used) > 1 else None,
            targets=targets,
            weights=weights_of(part, len(targets)) or (0.0,) * len(targets),
            joints=joints,
            influences=influences,
            name=name,
        )


def joined(blocks: Sequence[Block], name: str) -> FloatArray | None:
    """(V, width) an attribute of all blocks; None where they have none of it."""
    if name not in blocks[0].attributes:
        return None
    return together([block.attributes[name] for block in blocks])
