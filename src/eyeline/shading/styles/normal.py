"""Which way surfaces face: the normal's x, y, z as red, green, blue."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from eyeline.geometry.arrays import ByteArray, FloatArray
from eyeline.shading.attributes import attributes_of
from eyeline.shading.frame import Frame, Strip
from eyeline.shading.lanes import NX, NZ
from eyeline.shading.styles.plain import BLACK, before, exact


@dataclass(frozen=True)
class Normal:
    """Unit normals on the side the eye sees, normal maps and all: -1 is 1, 0 is 128, 1 is 255.

    space: "view" has x to the right, y up, z to the eye, so what faces the camera is (128, 128, 255);
    "world" has the axes of the scene.
    """

    name: str = "normal"
    lit: bool = False
    see_through: bool = False
    space: Literal["view", "world"] = "view"

    def __call__(self, frame: Frame) -> ByteArray:
        """The picture (H, W, 4)."""
        axes = np.eye(3) if self.space == "world" else frame.projected.camera.world_from_eye[:3, :3]

        def colour_of(strip: Strip) -> FloatArray:
            normals = attributes_of(frame, strip.points)[NX : NZ + 1, : len(strip.points)].T @ axes
            return exact((128 + 127 * normals) / 255)

        return before(frame, BLACK).drawn(colour_of)
