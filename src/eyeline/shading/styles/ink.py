"""Where a draughtsman draws a line: around nodes, where one surface stands before another, and on creases.

Lines are found at every antialiasing sample on its own and become the nearest layer there, so they are as
smooth as the silhouettes they follow. [Saito90]
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.jit import helper, kernel
from eyeline.scene.material import Colour
from eyeline.shading.attributes import attributes_of
from eyeline.shading.frame import Strip
from eyeline.shading.lanes import GX, GY, GZ, NX, NY, NZ, X, Y, Z
from eyeline.shading.resolve import Layers
from eyeline.shading.styles.id import nodes_of_points

PICTURE_HEIGHT = 720  # pixels, at which `width` is meant; larger pictures have wider lines


@dataclass(frozen=True)
class Ink:
    """A pen: how wide its lines are, how dark, and what it draws.

    gap: how far, as a part of the scene's diagonal, one surface must stand before another. crease: degrees
    between normals, both of the faces and of the shading.
    """

    width: float = 2.0  # pixels in a picture 720 high
    color: Colour = (0.012, 0.012, 0.02)
    outline: float = 1.0  # opacity
    fold: float = 0.65  # opacity where one surface of a node stands before another, and on creases
    gap: float = 0.012
    crease: float = 38.0

    def layers(self, strip: Strip) -> Layers:
        """The lines of a strip, at most one fragment for each of its samples."""
        frame = strip.frame
        width, height = frame.size
        reach = max(1, round(self.width / 2 * height / PICTURE_HEIGHT))
        wide = Strip(frame, max(0, strip.top - reach), min(height, strip.bottom + reach))
        nodes = nodes_of_points(wide.points.face, frame.projected)
        strength = np.empty((len(frame.visibles), (strip.bottom - strip.top) * width), np.float32)
        draw_lines(
            wide.of_sample, nodes, attributes_of(frame, wide.points), width, strip.top - wide.top, reach,
            self.gap * frame.scene.bounds.diagonal, math.cos(math.radians(self.crease)),
            self.outline, self.fold, strength,
        )  # fmt: skip
        return self.of_strength(strength)

    def of_strength(self, strength: FloatArray) -> Layers:
        """One fragment wherever the strength (n, P) of the ink is above 0."""
        there = strength > 0
        ends = np.cumsum(there.reshape(-1), dtype=np.int64).reshape(there.shape)
        first = np.concatenate([ends[:, :1] - there[:, :1], ends], axis=1)
        colour = np.empty((int(there.sum()), 4), np.float32)
        colour[:, :3] = self.color
        colour[:, 3] = strength[there]
        return Layers(first, colour)


@kernel
def draw_lines(of_sample, node, lanes, width, skip, reach, gap, cosine, outline, fold, strength):
    """Fill strength (n, P) of the ink at each sample: the most that any sample `reach` away asks for.

    of_sample (n, rows * width) has `skip` rows, or fewer at the picture's border, above and below.
    """
    samples, total = of_sample.shape
    rows = total // width
    for s in range(samples):
        for p in range(strength.shape[1]):
            row, column = p // width + skip, p % width
            here = of_sample[s, row * width + column]
            most = np.float32(0)
            for way in range(4):
                y = row + (reach if way == 0 else -reach if way == 1 else 0)
                x = column + (reach if way == 2 else -reach if way == 3 else 0)
                if x < 0 or x >= width or y < 0 or y >= rows:
                    continue
                there = of_sample[s, y * width + x]
                if there == here:
                    continue
                if here < 0 or there < 0 or node[here] != node[there]:
                    most = max(most, np.float32(outline))
                elif differs(lanes, here, there, gap, cosine):
                    most = max(most, np.float32(fold))
            strength[s, p] = most


@helper
def differs(lanes, a, b, gap, cosine):
    """Whether a line runs between two points of a node: a crease, or a step from one surface to another."""
    shading = lanes[NX, a] * lanes[NX, b] + lanes[NY, a] * lanes[NY, b] + lanes[NZ, a] * lanes[NZ, b]
    faces = lanes[GX, a] * lanes[GX, b] + lanes[GY, a] * lanes[GY, b] + lanes[GZ, a] * lanes[GZ, b]
    if shading < cosine and faces < cosine:
        return True
    # Of a bent surface each point lies near the other's plane; a step is far from both
    x, y, z = lanes[X, b] - lanes[X, a], lanes[Y, b] - lanes[Y, a], lanes[Z, b] - lanes[Z, a]
    from_a = abs(x * lanes[GX, a] + y * lanes[GY, a] + z * lanes[GZ, a])
    from_b = abs(x * lanes[GX, b] + y * lanes[GY, b] + z * lanes[GZ, b])
    return min(from_a, from_b) > gap
