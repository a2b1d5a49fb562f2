"""Light followed by rays: soft shadows, closed corners, and mirrors that show what stands around them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from eyeline.geometry.arrays import ByteArray
from eyeline.shading.ground import darkened_backdrop
from eyeline.shading.region import on_floor, region_of
from eyeline.shading.studio import lighting_of
from eyeline.shading.tracing import RayCounts, tracer_of
from eyeline.shading.transparency import drawn_through

if TYPE_CHECKING:
    from eyeline.shading.frame import Frame

REACH_PART = 0.25  # of the scene's diagonal: how far something can be and still close the sky
EDGE = 8  # pixels around what can darken the floor, for the softness of its outline


@dataclass(frozen=True)
class Traced:
    """Metallic-roughness materials; what light meets on its way is found by rays through a tree."""

    name: str = "traced"
    lit: bool = True
    see_through: bool = True
    rays: RayCounts = field(default_factory=RayCounts)
    seed: int = 0

    def __call__(self, frame: Frame) -> ByteArray:
        """The picture (H, W, 4)."""
        tracer = tracer_of(frame, self.rays, self.seed, REACH_PART)
        camera, bounds = frame.projected.camera, frame.scene.bounds
        lighting = lighting_of(frame.scene, camera)
        key = lighting.lights[0].world_from_light[:3, 2] if lighting.studio else None
        region = region_of(on_floor(bounds, key, tracer.reach), frame.projected, EDGE)
        return drawn_through(
            frame,
            tracer.colours,
            lambda strip: darkened_backdrop(strip, region, tracer.light_floor),
        )
