"""What a pointer of an animation moves, in our words. [KHR_animation_pointer; glTF 2.0 Asset Object Model]"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from eyeline.geometry.arrays import FloatArray

Owner = Literal["nodes", "meshes", "cameras", "lights", "materials"]


@dataclass(frozen=True)
class Moved:
    """A property of one thing in the file; None in `property`: there is one, and it changes no picture."""

    owner: Owner
    index: int
    property: str
    change: Callable[[FloatArray], FloatArray] | None = None  # from the file's values to ours


NODE = {
    "translation": "translation",
    "rotation": "rotation",
    "scale": "scale",
    "weights": "weights",
    "extensions/KHR_node_visibility/visible": "visible",
}
LIGHT = {
    "color": "light.color",
    "intensity": "light.intensity",
    "range": "light.range",
    "spot/innerConeAngle": "light.inner_cone",
    "spot/outerConeAngle": "light.outer_cone",
}
CAMERA = {
    "perspective/yfov": "camera.fov",
    "perspective/znear": "camera.near",
    "perspective/zfar": "camera.far",
    "orthographic/ymag": "camera.height",
    "orthographic/znear": "camera.near",
    "orthographic/zfar": "camera.far",
}
STRENGTH = "extensions/KHR_materials_emissive_strength/emissiveStrength"
MATERIAL = {
    "pbrMetallicRoughness/baseColorFactor": "base_color",
    "pbrMetallicRoughness/metallicFactor": "metallic",
    "pbrMetallicRoughness/roughnessFactor": "roughness",
    "emissiveFactor": "emissive",
    STRENGTH: "emissive_strength",
    "alphaCutoff": "alpha_cutoff",
    "normalTexture/scale": "normal_scale",
    "occlusionTexture/strength": "occlusion_strength",
}
SLOTS = {
    "pbrMetallicRoughness/baseColorTexture": "base_color_texture",
    "pbrMetallicRoughness/metallicRoughnessTexture": "metallic_roughness_texture",
    "normalTexture": "normal_texture",
    "occlusionTexture": "occlusion_texture",
    "emissiveTexture": "emissive_texture",
}
MATERIAL |= {
    f"{slot}/extensions/KHR_texture_transform/{key}": f"{ours}.{key}"
    for slot, ours in SLOTS.items()
    for key in ("offset", "rotation", "scale")
}

TABLES: tuple[tuple[str, Owner, dict[str, str]], ...] = (
    ("nodes", "nodes", NODE),
    ("meshes", "meshes", {"weights": "weights"}),
    ("cameras", "cameras", CAMERA),
    ("materials", "materials", MATERIAL),
    ("extensions/KHR_lights_punctual/lights", "lights", LIGHT),
)


def moved(pointer: str) -> Moved | None:
    """What a pointer moves; None for what is not drawn or not known."""
    for root, owner, table in TABLES:
        match = re.fullmatch(rf"/{root}/(0|[1-9][0-9]{{0,8}})/(.+)", pointer)
        if match and (name := table.get(match[2])):
            # An orthographic lens is given by half of what it sees
            change = _doubled if name == "camera.height" else None
            return Moved(owner, int(match[1]), name, change)
    return None


def _doubled(values: FloatArray) -> FloatArray:
    return 2 * values
