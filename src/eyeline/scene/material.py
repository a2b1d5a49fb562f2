"""How a surface answers light: glTF's metallic-roughness model. [glTF 2.0, 3.9 and appendix B]"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from eyeline.errors import GeometryError
from eyeline.scene.texture import TextureSlot

Colour = tuple[float, float, float]

AlphaMode = Literal["opaque", "mask", "blend"]


@dataclass(frozen=True, eq=False)
class Material:
    """Metallic-roughness; colours are linear, Rec. 709 primaries. Factors multiply their textures."""

    name: str = ""
    base_color: tuple[float, float, float, float] = (0.8, 0.8, 0.8, 1.0)  # alpha last, 0..1
    metallic: float = 0.0  # 0 dielectric .. 1 metal
    roughness: float = 0.5  # 0 mirror .. 1 matt; perceptual, its square is the width of the highlight
    emissive: Colour = (0.0, 0.0, 0.0)  # >= 0, linear; above 1 with emissive_strength folded in
    normal_scale: float = 1.0
    occlusion_strength: float = 1.0  # 0..1
    base_color_texture: TextureSlot | None = None  # sRGB, alpha linear
    metallic_roughness_texture: TextureSlot | None = None  # green roughness, blue metallic
    normal_texture: TextureSlot | None = None  # tangent space, y up
    occlusion_texture: TextureSlot | None = None  # red
    emissive_texture: TextureSlot | None = None  # sRGB
    alpha_mode: AlphaMode = "opaque"
    alpha_cutoff: float = 0.5  # with "mask": less alpha is a hole
    double_sided: bool = True  # meshes made from arrays are; files say so themselves
    unlit: bool = False  # the base colour, whatever the light

    def __post_init__(self) -> None:
        """Refuse numbers outside their range."""
        for name in ("metallic", "roughness", "occlusion_strength"):
            if not 0 <= getattr(self, name) <= 1:
                raise GeometryError(
                    f"material {self.name!r}: {name} is {getattr(self, name)}; 0 to 1 is needed"
                )
        if len(self.base_color) != 4 or not all(channel >= 0 for channel in self.base_color):
            raise GeometryError(
                f"material {self.name!r}: base_color is {self.base_color}; four numbers from 0 are needed"
            )


# Of a mesh that says nothing: clay, darker than the studio's backdrop and warmer, so that its outline shows
DEFAULT = Material(base_color=(0.7, 0.68, 0.65, 1.0), roughness=0.45)
