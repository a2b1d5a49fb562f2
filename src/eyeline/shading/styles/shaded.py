"""The product photograph: materials under lights, with shadows, on a studio floor."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from eyeline.geometry.arrays import ByteArray
from eyeline.shading.ground import shaded_backdrop
from eyeline.shading.point_shading import colours_of
from eyeline.shading.stage import stage_of
from eyeline.shading.transparency import drawn_through

if TYPE_CHECKING:
    from eyeline.shading.frame import Frame


@dataclass(frozen=True)
class Shaded:
    """Metallic-roughness materials under the scene's lights, or the studio's."""

    name: str = "shaded"
    lit: bool = True
    see_through: bool = True
    faceted: bool = False  # each face by its own normal

    def __call__(self, frame: Frame) -> ByteArray:
        """The picture (H, W, 4)."""
        stage = stage_of(frame)
        return drawn_through(
            frame,
            lambda points: colours_of(frame, stage, points, self.faceted),
            lambda strip: shaded_backdrop(strip, stage),
        )
