"""Everything as thin glass: each surface, seen or hidden, adds a veil, denser where it is seen edge-on."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from eyeline.geometry.arrays import ByteArray, FloatArray
from eyeline.projection.projected import CLOCKWISE, COUNTER_CLOCKWISE, Projected
from eyeline.scene.material import Colour
from eyeline.shading.attributes import attributes_of
from eyeline.shading.frame import Frame, Strip
from eyeline.shading.lanes import NX, NY, NZ, VX, VY, VZ
from eyeline.shading.resolve import Layers
from eyeline.shading.surface_points import SurfacePoints
from eyeline.shading.transparency import layers, stacked
from eyeline.visibility.method import Visible


@dataclass(frozen=True)
class XRay:
    """All fragments of all faces over the backdrop: light glass on a dark one, blue glass on a light one.

    A veil's opacity goes from `veil`, seen from the front, to `rim`, seen edge-on, by the power `sharpness`.
    All veils have one colour, so their order makes no difference.
    """

    name: str = "xray"
    lit: bool = False
    see_through: bool = True
    veil: float = 0.07
    rim: float = 0.75
    sharpness: float = 2.5
    on_light: Colour = (0.012, 0.085, 0.26)
    on_dark: Colour = (0.42, 0.74, 1.0)

    def __call__(self, frame: Frame) -> ByteArray:
        """The picture (H, W, 4)."""
        every = np.ones(frame.projected.face_count, bool)
        stack = stacked(replace(frame, projected=both_sides(frame.projected)), every, through=True)
        empty = replace(frame, visibles=[(nothing_of(visible), dx, dy) for visible, dx, dy in frame.visibles])
        colour = self.on_light if is_light(frame.backdrop) else self.on_dark

        def shader(points: SurfacePoints) -> FloatArray:
            return np.column_stack(
                [np.tile(np.array(colour, np.float32), (len(points), 1)), self.opacity(frame, points)]
            )

        def colour_of(strip: Strip) -> tuple[FloatArray, Layers]:
            return np.empty((0, 4), np.float32), layers(strip, stack, shader)

        return empty.drawn(colour_of)

    def opacity(self, frame: Frame, points: SurfacePoints) -> FloatArray:
        """(K,) float32 of the veil at each point."""
        lanes = attributes_of(frame, points)[:, : len(points)]
        facing = np.abs(lanes[NX] * lanes[VX] + lanes[NY] * lanes[VY] + lanes[NZ] * lanes[VZ])
        edge_on = 1 - np.minimum(facing, 1)
        opacity: FloatArray = self.veil + (self.rim - self.veil) * edge_on**self.sharpness
        return opacity.astype(np.float32)


def both_sides(projected: Projected) -> Projected:
    """The same picture, its faces drawn from behind too: glass has a far wall."""
    sides = np.where(projected.sides > 0, COUNTER_CLOCKWISE | CLOCKWISE, 0)
    return replace(projected, sides=sides.astype(np.uint8))


def nothing_of(visible: Visible) -> Visible:
    """The answer to a scene in which nothing stands."""
    return replace(visible, face=np.full_like(visible.face, -1), depth=np.zeros_like(visible.depth))


def is_light(backdrop: ByteArray) -> bool:
    """Whether dark glass stands out better; before nothing at all it does."""
    return bool(backdrop[..., :3].mean() > 127 or not backdrop[..., 3].any())
