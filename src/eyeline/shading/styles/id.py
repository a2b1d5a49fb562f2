"""Which node is which: one flat colour for each, far from those of its neighbours."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from eyeline.geometry.arrays import ByteArray, FloatArray, IntArray
from eyeline.projection.projected import Projected
from eyeline.scene.colour import srgb_from_linear
from eyeline.shading.frame import Frame, Strip
from eyeline.shading.styles.plain import BLACK, before, exact

GOLDEN = (5**0.5 - 1) / 2  # of a full turn: whatever the count, hues spread evenly
FIRST_HUE, FIRST_LIGHTNESS = 0.08, 0.55
PLASTIC = 0.5698402909980533  # the like for lightness: one over the square of the plastic number. [Roberts18]
DARKEST, LIGHTEST = 0.58, 0.85
CHROMA = 0.13


@dataclass(frozen=True)
class Id:
    """A colour for each node, or for each face.

    It follows from the number alone, so it is the same in every frame and from every side. Silhouettes are
    antialiased, so that there colours mix; `eyeline.visible` gives the numbers themselves.
    """

    name: str = "id"
    lit: bool = False
    see_through: bool = False
    of: Literal["node", "face"] = "node"

    def __call__(self, frame: Frame) -> ByteArray:
        """The picture (H, W, 4)."""

        def colour_of(strip: Strip) -> FloatArray:
            face = strip.points.face
            return id_colours(face if self.of == "face" else nodes_of_points(face, frame.projected))

        return before(frame, BLACK).drawn(colour_of)


def nodes_of_points(face: IntArray, projected: Projected) -> IntArray:
    """(K,) the node of each scene face; on the caller's thread alone, so that strips may ask."""
    nodes = np.array([surface.node for surface in projected.surfaces], np.int64)
    return nodes[np.searchsorted(projected.first_faces, face, side="right") - 1]


def id_colours(numbers: IntArray) -> FloatArray:
    """(K, 4) float32 linear, opaque: the colour of each number."""
    turn = 2 * np.pi * ((FIRST_HUE + numbers * GOLDEN) % 1.0)
    lightness = DARKEST + (LIGHTEST - DARKEST) * ((FIRST_LIGHTNESS + numbers * PLASTIC) % 1.0)
    return exact(srgb_from_linear(linear_from_oklab(lightness, CHROMA * np.cos(turn), CHROMA * np.sin(turn))))


def linear_from_oklab(lightness: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    """(K, 3) linear Rec. 709, cut to 0..1, of a perceptual colour. [Ottosson20]"""
    cones = np.stack(
        [
            lightness + 0.3963377774 * a + 0.2158037573 * b,
            lightness - 0.1055613458 * a - 0.0638541728 * b,
            lightness - 0.0894841775 * a - 1.2914855480 * b,
        ],
        axis=-1,
    )
    mix = np.array(
        [
            [4.0767416621, -3.3077115913, 0.2309699292],
            [-1.2684380046, 2.6097574011, -0.3413193965],
            [-0.0041960863, -0.7034186147, 1.7076147010],
        ]
    )
    linear: FloatArray = np.clip(cones**3 @ mix.T, 0, 1)
    return linear
