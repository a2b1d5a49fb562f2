"""The mesh itself: edges of the visible faces as thin lines on pale paper, hidden ones removed."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import ByteArray, FloatArray
from eyeline.jit import kernel
from eyeline.scene.material import Colour
from eyeline.shading.attributes import attributes_of
from eyeline.shading.barycentric import corners_of, edges_of, shares_at, surface_of
from eyeline.shading.frame import Frame, Strip
from eyeline.shading.geometry_table import FACES, POINTS
from eyeline.shading.lanes import NX, NY, NZ, VX, VY, VZ


@dataclass(frozen=True)
class Wire:
    """Lines of constant width over a surface shaded by how it faces the eye.

    A line's place is exact: it is the distance on the screen to the edge of the face that is seen, so hidden
    lines need no test of their own. Where the heights of a face are less than `fading` pixels in the mean its
    lines pale, so that a dense mesh stays a surface.
    """

    name: str = "wire"
    lit: bool = False
    see_through: bool = False
    width: float = 1.0  # pixels
    fading: float = 6.0  # pixels
    ink: Colour = (0.018, 0.04, 0.085)
    paper: Colour = (0.86, 0.90, 0.95)
    shade: float = 0.45  # of the paper where it is seen edge-on

    def __call__(self, frame: Frame) -> ByteArray:
        """The picture (H, W, 4)."""

        def colour_of(strip: Strip) -> FloatArray:
            points = strip.points
            cover = np.empty(len(points), np.float32)
            edge_cover(frame.geometry, points.face, points.x, points.y, self.width / 2, self.fading, cover)
            lanes = attributes_of(frame, points)[:, : len(points)]
            facing = np.clip(lanes[NX] * lanes[VX] + lanes[NY] * lanes[VY] + lanes[NZ] * lanes[VZ], 0, 1)
            light = self.shade + (1 - self.shade) * facing
            colour = np.ones((len(points), 4), np.float32)
            # Mixed in square roots, nearly as we see, so that a line between pixels is as dark as one on them
            for k in range(3):
                paper = np.sqrt(light * self.paper[k])
                colour[:, k] = (paper + (math.sqrt(self.ink[k]) - paper) * cover) ** 2
            return colour

        return frame.drawn(colour_of)


@kernel
def edge_cover(geometry, faces, xs, ys, half, fading, cover):
    """Fill cover (K,): how much of a pixel around each point the lines along its face's edges take, 0..1."""
    surface, current = 0, -1
    for point in range(faces.shape[0]):
        if faces[point] != current:
            current = faces[point]
            surface = surface_of(geometry.first_faces, current, surface)
            row = geometry.places[surface, FACES] + current - geometry.first_faces[surface]
            corners = corners_of(geometry.faces, row)
            first = geometry.places[surface, POINTS]
            edges, _ = edges_of(geometry.matrices, surface, geometry.points, first, corners)
        shares, scale = shares_at(edges, float(xs[point]), float(ys[point]))
        nearest, total = np.inf, 0.0
        for k in range(3):
            # One over the steepness of a share is how far it is, here, from its edge to its corner
            height = 1.0 / (abs(scale) * math.sqrt(edges[k][0] * edges[k][0] + edges[k][1] * edges[k][1]))
            nearest = min(nearest, abs(shares[k]) * height)
            total += height
        pale = min(total / (3.0 * fading), 1.0)
        cover[point] = min(max(half + 0.5 - nearest, 0.0), 1.0) * pale * pale
