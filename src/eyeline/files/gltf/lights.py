"""Lights: directional, point and spot. [KHR_lights_punctual]"""

from __future__ import annotations

import math
from typing import cast

from eyeline.errors import FileError
from eyeline.files.gltf.document import Document
from eyeline.files.gltf.part import Part
from eyeline.scene.light import Light, LightKind

QUARTER = math.pi / 4


def light_parts(document: Document) -> tuple[Part, ...]:
    """The lights of a document, as they are written."""
    extension = document.root.extension("KHR_lights_punctual")
    return () if extension is None else extension.parts("lights")


def light_of(document: Document, index: int, place: str) -> Light:
    """The light that `place` names."""
    parts = light_parts(document)
    if index >= len(parts):
        raise FileError(f"{place} names light {index}; the file has {len(parts)} of them")
    part = parts[index]
    kind = part.choice("type", ("directional", "point", "spot"))
    color = part.numbers("color", (1.0, 1.0, 1.0))
    if min(color) < 0:
        raise part.refuse("color", "three numbers from 0 are needed")
    spot = part.part("spot")
    outer = spot.ranged("outerConeAngle", QUARTER, 0, math.pi / 2)
    return Light(
        cast(LightKind, kind),
        (color[0], color[1], color[2]),
        part.ranged("intensity", 1.0, 0),
        part.distance("range") or math.inf,
        spot.ranged("innerConeAngle", 0.0, 0, outer),
        outer,
        part.name(),
    )
