"""Light sources, in glTF's units. [KHR_lights_punctual]"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from eyeline.errors import GeometryError
from eyeline.scene.material import Colour

LightKind = Literal["directional", "point", "spot"]


@dataclass(frozen=True, eq=False)
class Light:
    """A source at its node's origin, shining along the node's -z."""

    kind: LightKind = "directional"
    color: Colour = (1.0, 1.0, 1.0)  # linear
    intensity: float = 1.0  # directional: lux; point and spot: candela
    range: float = math.inf  # metres; nothing is lit beyond
    inner_cone: float = 0.0  # radians from the axis: full light within
    outer_cone: float = math.pi / 4  # radians from the axis: none outside
    name: str = ""

    def __post_init__(self) -> None:
        """Refuse a light that cannot shine."""
        if self.kind not in ("directional", "point", "spot"):
            raise GeometryError(f"light {self.name!r} is {self.kind!r}; directional, point or spot is needed")
        if not (math.isfinite(self.intensity) and self.intensity >= 0):
            raise GeometryError(f"light {self.name!r}: intensity is {self.intensity}; 0 or more is needed")
        if not 0 <= self.inner_cone <= self.outer_cone <= math.pi / 2:
            raise GeometryError(
                f"light {self.name!r}: cones are {self.inner_cone} and {self.outer_cone} radians;"
                " 0 <= inner <= outer <= pi/2 is needed"
            )
