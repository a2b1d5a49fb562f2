"""The blocks of a mesh made alike, so that they can be joined: what one has and another lacks is filled.

Normals are as flat as the format asks; tangents are made where a normal texture needs them; UV 0, colour 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields

import numpy as np

from eyeline.files.gltf.blocks import Block, flat, with_tangents
from eyeline.scene.material import Material
from eyeline.scene.texture import TextureSlot

FILL: dict[str, tuple[float, ...]] = {
    "TANGENT": (1, 0, 0, 1),
    "TEXCOORD_0": (0, 0),
    "TEXCOORD_1": (0, 0),
    "COLOR_0": (1, 1, 1, 1),
}


def completed(blocks: Sequence[Block], materials: Sequence[Material]) -> list[Block]:
    """Blocks that all have the same attributes, and every UV set that a texture lies on."""
    wanted = {name for block in blocks for name in block.attributes if name in FILL}
    last_set = max(
        [uv_set for material in materials for uv_set in uv_sets(material)]
        + [int(name[-1]) for name in wanted if name.startswith("TEXCOORD")],
        default=-1,
    )
    wanted |= {f"TEXCOORD_{uv_set}" for uv_set in range(last_set + 1)}
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
    bumpy = [slot for slot, material in enumerate(materials) if material.normal_texture is not None]
    for slot in bumpy:
        texture = materials[slot].normal_texture if (block.materials == slot).any() else None
        if texture is not None and f"TEXCOORD_{texture.uv_set}" in block.attributes:
            return texture.uv_set
    return None


def uv_sets(material: Material) -> list[int]:
    """The UV sets that a material's textures lie on."""
    slots = (getattr(material, field.name) for field in fields(material))
    return [slot.uv_set for slot in slots if isinstance(slot, TextureSlot)]
