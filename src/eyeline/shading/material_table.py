"""Materials as rows of numbers for kernels."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.texture import Texture, TextureSlot
from eyeline.shading.texture_table import Textures, textures_of

# Columns of `factors`
BASE, METAL, ROUGH, EMISSION, NORMAL_SCALE, OCCLUSION_STRENGTH = 0, 4, 5, 6, 9, 10
BLENDED, NO_LIGHT = 11, 12  # 1 where so
# Slots, in this order in the table
SLOTS = (
    ("base_color_texture", True),
    ("metallic_roughness_texture", False),
    ("normal_texture", False),
    ("occlusion_texture", False),
    ("emissive_texture", True),
)
BASE_SLOT, METAL_SLOT, NORMAL_SLOT, OCCLUSION_SLOT, EMISSION_SLOT = range(5)


class Materials(NamedTuple):
    """M materials, and the textures in their slots."""

    factors: FloatArray  # (M, 13) float32
    slots: IntArray  # (M, 5, 2) int64: which texture, -1 none; which UV set
    moves: FloatArray  # (M, 5, 6) float64 texture_from_uv, row by row
    textures: Textures


def materials_of(meshes: Sequence[Mesh]) -> tuple[Materials, list[int]]:
    """The table of all materials of all meshes, and the row of each mesh's first."""
    rows: dict[tuple[int, ...], int] = {}
    materials: list[Material] = []
    firsts = []
    for mesh in meshes:
        key = tuple(map(id, mesh.materials))
        if key not in rows:
            rows[key] = len(materials)
            materials.extend(mesh.materials)
        firsts.append(rows[key])
    factors = np.array([_factors(material) for material in materials], np.float32).reshape(-1, 13)
    slots = np.full((max(len(materials), 1), len(SLOTS), 2), -1, np.int64)
    moves = np.zeros((max(len(materials), 1), len(SLOTS), 6))
    used: dict[tuple[object, ...], tuple[int, Texture, bool]] = {}
    for row, material in enumerate(materials):
        for column, (name, srgb) in enumerate(SLOTS):
            slot: TextureSlot | None = getattr(material, name)
            if slot is not None:
                texture = slot.texture
                key_of = (id(texture.pixels), texture.wrap, texture.nearest, texture.mipmaps, srgb)
                index = used.setdefault(key_of, (len(used), texture, srgb))[0]
                slots[row, column] = index, slot.uv_set
                moves[row, column] = slot.texture_from_uv.reshape(-1)
    textures = textures_of([(texture, srgb) for _, texture, srgb in used.values()])
    return Materials(factors, slots, moves, textures), firsts


def _factors(material: Material) -> list[float]:
    return [
        *material.base_color, material.metallic, material.roughness, *material.emissive,
        material.normal_scale, material.occlusion_strength, material.alpha_mode == "blend", material.unlit,
    ]  # fmt: skip
