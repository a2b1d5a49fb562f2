"""Materials: metallic-roughness, unlit, emissive strength. [glTF 2.0, 3.9]"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, fields

from eyeline.files.gltf.materials import DEFAULT_NAME
from eyeline.files.gltf.pointers import SLOTS
from eyeline.files.gltf.writing.store import Store, Thing, named, number, numbers
from eyeline.files.gltf.writing.textures import Textures
from eyeline.scene.material import Material

# The material of faces that name none
SILENT = Material(DEFAULT_NAME, (1.0, 1.0, 1.0, 1.0), 1.0, 1.0, double_sided=False)


@dataclass(frozen=True, eq=False)
class Materials:
    """Writes each material once."""

    store: Store
    textures: Textures
    note: Callable[[str], None]
    moving: Mapping[str, Collection[str]]  # material -> its properties that clips move
    glow: Mapping[str, float]  # material -> the greatest emission that clips reach
    _numbers: dict[int, int | None] = field(default_factory=dict)
    by_name: dict[str, list[int]] = field(default_factory=dict)  # material -> all that have its name

    def __call__(self, material: Material) -> int | None:
        """Its number; None for what faces are made of that name no material."""
        if id(material) not in self._numbers:
            moves = self.moving.get(material.name, ())
            if not moves and same(material, SILENT):
                self._numbers[id(material)] = None
            else:
                index = self.store.add("materials", self._made(material, moves))
                self._numbers[id(material)] = index
                self.by_name.setdefault(material.name, []).append(index)
        return self._numbers[id(material)]

    def strength(self, material: Material) -> float:
        """What the file's emissive colour, at most 1, is multiplied by."""
        return max(1.0, *material.emissive, self.glow.get(material.name, 0.0))

    def _made(self, material: Material, moves: Collection[str]) -> Thing:
        if max(material.base_color) > 1:
            self.note(f"material {material.name!r} is brighter than white; glTF ends there, and so does it")
        thing: Thing = {
            "pbrMetallicRoughness": {
                "baseColorFactor": numbers([min(channel, 1.0) for channel in material.base_color]),
                "metallicFactor": number(material.metallic),
                "roughnessFactor": number(material.roughness),
            }
        }
        strength = self.strength(material)
        if any(material.emissive) or "emissive" in moves:
            thing["emissiveFactor"] = numbers([channel / strength for channel in material.emissive])
        if material.alpha_mode != "opaque":
            thing["alphaMode"] = material.alpha_mode.upper()
        if material.alpha_mode == "mask":
            thing["alphaCutoff"] = number(material.alpha_cutoff)
        if material.double_sided:
            thing["doubleSided"] = True
        self._lay(thing, material, moves)
        extensions: Thing = {}
        if strength > 1:
            values = {"emissiveStrength": number(strength)}
            extensions |= self.store.extended("KHR_materials_emissive_strength", values)["extensions"]
        if material.unlit:
            extensions |= self.store.extended("KHR_materials_unlit", {})["extensions"]
        return named(material.name, {**thing, "extensions": extensions} if extensions else thing)

    def _lay(self, thing: Thing, material: Material, moves: Collection[str]) -> None:
        """Put the textures of all five slots in their places."""
        for address, ours in SLOTS.items():
            slot = getattr(material, ours)
            if slot is None:
                continue
            *outer, key = address.split("/")
            holder = thing[outer[0]] if outer else thing
            holder[key] = self.textures.slot(slot, any(one.startswith(f"{ours}.") for one in moves))
        if material.normal_texture is not None:
            thing["normalTexture"]["scale"] = number(material.normal_scale)
        if material.occlusion_texture is not None:
            thing["occlusionTexture"]["strength"] = number(material.occlusion_strength)


def same(one: Material, other: Material) -> bool:
    """Whether two materials are alike in all but their objects."""
    return all(getattr(one, part.name) == getattr(other, part.name) for part in fields(one))
