"""Materials: metallic-roughness, unlit, emissive strength. [glTF 2.0, 3.9]"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import cast

from eyeline.cached import cached_property
from eyeline.files.gltf.document import Document
from eyeline.files.gltf.names import unique
from eyeline.files.gltf.part import Part
from eyeline.files.gltf.textures import Textures
from eyeline.scene.material import AlphaMode, Material

DEFAULT_NAME = "default material"


@dataclass(frozen=True, eq=False)
class Materials:
    """The materials of a document, each made once; None is the one of faces that name none."""

    document: Document
    textures: Textures
    _materials: dict[int | None, Material] = field(default_factory=dict)

    def __call__(self, index: int | None, place: str) -> Material:
        """The material that `place` names."""
        if index not in self._materials:
            part = Part("", {}) if index is None else self.document.one("materials", index, place)
            name = DEFAULT_NAME if index is None else self.names[index]
            self._materials[index] = self._made(part, name)
        return self._materials[index]

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Every material's name; a doubled one gets '.1', '.2' ..., so that clips can name materials."""
        own = (part.name(f"material {index}") for index, part in enumerate(self.document.all("materials")))
        return unique(own, taken=(DEFAULT_NAME,))

    def _made(self, part: Part, name: str) -> Material:
        surface = part.part("pbrMetallicRoughness")
        base_color = surface.numbers("baseColorFactor", (1.0, 1.0, 1.0, 1.0))
        if not all(0 <= channel <= 1 for channel in base_color):
            raise surface.refuse("baseColorFactor", "four numbers from 0 to 1 are needed")
        emissive = emissive_of(part)
        return Material(
            name=name,
            base_color=(base_color[0], base_color[1], base_color[2], base_color[3]),
            metallic=surface.ranged("metallicFactor", 1.0, 0, 1),
            roughness=surface.ranged("roughnessFactor", 1.0, 0, 1),
            emissive=(emissive[0], emissive[1], emissive[2]),
            normal_scale=part.part("normalTexture").number("scale", 1.0),
            occlusion_strength=part.part("occlusionTexture").ranged("strength", 1.0, 0, 1),
            base_color_texture=self.textures.slot(surface, "baseColorTexture"),
            metallic_roughness_texture=self.textures.slot(surface, "metallicRoughnessTexture"),
            normal_texture=self.textures.slot(part, "normalTexture"),
            occlusion_texture=self.textures.slot(part, "occlusionTexture"),
            emissive_texture=self.textures.slot(part, "emissiveTexture"),
            alpha_mode=cast(
                AlphaMode, part.choice("alphaMode", ("OPAQUE", "MASK", "BLEND"), "OPAQUE").lower()
            ),
            alpha_cutoff=part.ranged("alphaCutoff", 0.5, 0),
            double_sided=part.flag("doubleSided"),
            unlit=part.extension("KHR_materials_unlit") is not None,
        )


def emissive_of(part: Part) -> tuple[float, ...]:
    """The emissive colour with its strength folded in. [KHR_materials_emissive_strength]"""
    factor = part.numbers("emissiveFactor", (0.0, 0.0, 0.0))
    if not all(0 <= channel <= 1 for channel in factor):
        raise part.refuse("emissiveFactor", "three numbers from 0 to 1 are needed")
    return tuple(channel * emissive_strength(part) for channel in factor)


def emissive_strength(part: Part) -> float:
    """What the emissive colour is multiplied by."""
    strength = part.extension("KHR_materials_emissive_strength")
    return 1.0 if strength is None else strength.ranged("emissiveStrength", 1.0, 0)
