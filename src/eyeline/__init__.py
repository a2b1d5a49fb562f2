"""3D animation that knows what the viewer sees: exact visibility, films and data on plain CPUs.

Names are imported when they are first used, so that `import eyeline` stays quick.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from eyeline.version import __version__

if TYPE_CHECKING:
    from eyeline import deform, errors, samples
    from eyeline.comparison import Comparison, compare
    from eyeline.drawn import ExposureSheet, exposure_sheet
    from eyeline.explanation import Explanation, explain
    from eyeline.files import load
    from eyeline.geometry.quaternion import turn
    from eyeline.motion import (
        EASINGS,
        Clip,
        Curve,
        Easing,
        Key,
        Layer,
        Layers,
        Path,
        Shot,
        Track,
        constraints,
        easing,
        face,
        in_turn,
        together,
    )
    from eyeline.render.drawing import Drawing, draw
    from eyeline.render.film import Film, film
    from eyeline.render.frame import render
    from eyeline.render.image import Image
    from eyeline.render.reel import Reel
    from eyeline.render.visible import visible
    from eyeline.rigging import bind, skeleton
    from eyeline.scene.camera import Camera
    from eyeline.scene.light import Light
    from eyeline.scene.material import Material
    from eyeline.scene.mesh import Mesh, MorphTarget
    from eyeline.scene.node import Node
    from eyeline.scene.scene import Scene
    from eyeline.scene.skin import Skin
    from eyeline.scene.texture import Texture, TextureSlot
    from eyeline.shading.styles import STYLES
    from eyeline.shapes import inbetween
    from eyeline.visibility import METHODS

_HOMES = {
    "EASINGS": "eyeline.motion",
    "METHODS": "eyeline.visibility",
    "STYLES": "eyeline.shading.styles",
    "Camera": "eyeline.scene.camera",
    "Clip": "eyeline.motion",
    "Comparison": "eyeline.comparison",
    "Curve": "eyeline.motion",
    "Drawing": "eyeline.render.drawing",
    "Easing": "eyeline.motion",
    "Explanation": "eyeline.explanation",
    "ExposureSheet": "eyeline.drawn",
    "Film": "eyeline.render.film",
    "Image": "eyeline.render.image",
    "Key": "eyeline.motion",
    "Layer": "eyeline.motion",
    "Layers": "eyeline.motion",
    "Light": "eyeline.scene.light",
    "Material": "eyeline.scene.material",
    "Mesh": "eyeline.scene.mesh",
    "MorphTarget": "eyeline.scene.mesh",
    "Node": "eyeline.scene.node",
    "Path": "eyeline.motion",
    "Reel": "eyeline.render.reel",
    "Scene": "eyeline.scene.scene",
    "Shot": "eyeline.motion",
    "Skin": "eyeline.scene.skin",
    "Texture": "eyeline.scene.texture",
    "TextureSlot": "eyeline.scene.texture",
    "Track": "eyeline.motion",
    "bind": "eyeline.rigging",
    "compare": "eyeline.comparison",
    "constraints": "eyeline.motion.constraints",
    "deform": "eyeline.deform",
    "draw": "eyeline.render.drawing",
    "easing": "eyeline.motion",
    "errors": "eyeline.errors",
    "explain": "eyeline.explanation",
    "exposure_sheet": "eyeline.drawn",
    "face": "eyeline.motion.face",
    "film": "eyeline.render.film",
    "in_turn": "eyeline.motion",
    "inbetween": "eyeline.shapes",
    "load": "eyeline.files",
    "render": "eyeline.render",
    "samples": "eyeline.samples",
    "skeleton": "eyeline.rigging",
    "together": "eyeline.motion",
    "turn": "eyeline.geometry.quaternion",
    "visible": "eyeline.render.visible",
}  # public name -> the module that holds it
_MODULES = (
    "constraints",
    "deform",
    "errors",
    "face",
    "render",
    "samples",
)  # are modules themselves; `render` is one that can be called

__all__ = [
    "EASINGS",
    "METHODS",
    "STYLES",
    "Camera",
    "Clip",
    "Comparison",
    "Curve",
    "Drawing",
    "Easing",
    "Explanation",
    "ExposureSheet",
    "Film",
    "Image",
    "Key",
    "Layer",
    "Layers",
    "Light",
    "Material",
    "Mesh",
    "MorphTarget",
    "Node",
    "Path",
    "Reel",
    "Scene",
    "Shot",
    "Skin",
    "Texture",
    "TextureSlot",
    "Track",
    "__version__",
    "bind",
    "compare",
    "constraints",
    "deform",
    "draw",
    "easing",
    "errors",
    "explain",
    "exposure_sheet",
    "face",
    "film",
    "in_turn",
    "inbetween",
    "load",
    "render",
    "samples",
    "skeleton",
    "together",
    "turn",
    "visible",
]


def __getattr__(name: str) -> Any:
    """A public name, imported at its first use."""
    if name not in _HOMES:
        raise AttributeError(f"module 'eyeline' has no attribute {name!r}")
    home = importlib.import_module(_HOMES[name])
    value = home if name in _MODULES else getattr(home, name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
