"""What is seen, by trying every face at every pixel, unsnapped and unclipped; and where that is beyond doubt.

Slow and plain: the judge of methods, not one of them. [Olano97]
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import BoolArray, FloatArray, IntArray
from eyeline.projection.projected import CLOCKWISE, COUNTER_CLOCKWISE
from eyeline.projection.sides import sides_of
from eyeline.scene.camera import Camera
from eyeline.scene.scene import Scene

SNAP = 1 / 256  # pixels: more than a corner moves, in any direction, when it is snapped
STEEP = 8  # how many times the snap distance along its slope a depth may be off
ROUNDING = 1e-6  # of a depth
BLOCK = 1 << 15  # pixels of faces that are looked at together: as many as a cache holds

Verdict = tuple[BoolArray, BoolArray, FloatArray, FloatArray]


@dataclass(frozen=True, eq=False)
class Truth:
    """What a camera sees of a scene, and where that is beyond doubt."""

    face: IntArray  # (H, W)
    decidable: BoolArray  # (H, W) farther than SNAP from every edge, and the depths well apart


def truth(scene: Scene, camera: Camera, size: tuple[int, int], cull: str = "auto") -> Truth:
    """Every face of a posed scene at every pixel, in homogeneous coordinates: nothing is clipped."""
    faces = screened(scene, camera, size, cull)
    count = size[0] * size[1]
    best, margin = np.zeros(count), np.zeros(count)  # depth of the nearest face, and its slack
    doubt = np.full(count, -np.inf)  # greatest depth that something else may have
    face = np.full(count, -1, np.int32)
    for number, column, row in places(faces.boxes):
        inside, maybe, depth, slack = faces.at(column + 0.5, row + 0.5, number)
        pixel = row * size[0] + column
        before = best[pixel]
        np.maximum.at(best, pixel[inside], depth[inside])
        # Of equal depths the first face wins: it is written last
        won = np.flatnonzero(inside & (depth == best[pixel]) & (depth > before))[::-1]
        place = pixel[won]
        # What the winner must clear: whom it beats, and what may be there
        beaten = np.where(face[place] >= 0, before[won] + margin[place], -np.inf)
        doubt[place] = np.maximum(doubt[place], beaten)
        face[place], margin[place] = number[won], slack[won]
        beside = maybe & (number != face[pixel])
        np.maximum.at(doubt, pixel[beside], (depth + slack)[beside])
    shape = size[1], size[0]
    return Truth(face.reshape(shape), (doubt < best - margin).reshape(shape))


def places(boxes: IntArray) -> Iterator[tuple[IntArray, IntArray, IntArray]]:
    """(face, column, row), each (K,), of all pixels in boxes (F, 4), face after face, in blocks."""
    left, top, right, bottom = boxes.T
    wide, count = right - left, (right - left) * (bottom - top)
    ends = np.cumsum(count)
    for begin in range(0, int(count.sum()), BLOCK):
        place = np.arange(begin, min(begin + BLOCK, int(ends[-1])))
        face = np.searchsorted(ends, place, side="right")
        down, across = np.divmod(place - (ends - count)[face], wide[face])
        yield face, left[face] + across, top[face] + down


@dataclass(frozen=True, eq=False)
class Screened:
    """Faces on the screen, nothing rounded: the lines along their edges, the planes of their depths."""

    shown: BoolArray  # (F,) whether a face shows a side that counts
    edges: FloatArray  # (3, 3, F): a, b, c of each edge; a column + b row + c pixels inside it lies a sample
    depth: FloatArray  # (3, F): a, b, c alike
    slack: FloatArray  # (F,) by how much a depth may be off
    boxes: IntArray  # (F, 4): left, top, right, bottom of the pixels it may touch

    def at(
        self, columns: FloatArray | float, rows: FloatArray | float, faces: IntArray | None = None
    ) -> Verdict:
        """(certainly covered, possibly covered, depth, slack) of faces, each at a sample.

        faces: (K,) rising; all if left out.
        """
        chosen = slice(None) if faces is None else faces if faces[0] < faces[-1] else faces[:1]
        reach = along(self.edges[..., chosen], columns, rows).min(axis=0)
        depth, slack = along(self.depth[:, chosen], columns, rows), self.slack[chosen]
        inside = self.shown[chosen] & (reach > SNAP) & (depth < 1 - slack) & (depth > slack)
        beside = self.shown[chosen] & (reach > -SNAP) & (depth < 1 + slack) & (depth > -slack)
        return inside, inside | beside, depth, np.broadcast_to(slack, depth.shape)

    def is_decidable(self, column: int, row: int) -> bool:
        """`Truth.decidable` of one pixel: for scenes of more faces than `truth` can look at everywhere."""
        inside, maybe, depth, slack = self.at(column + 0.5, row + 0.5)
        if not inside.any():
            return not maybe.any()
        face = int(np.argmax(np.where(inside, depth, -np.inf)))
        maybe[face] = False
        return bool((depth + slack)[maybe].max(initial=-np.inf) < depth[face] - slack[face])


def along(lines: FloatArray, columns: FloatArray | float, rows: FloatArray | float) -> FloatArray:
    """a column + b row + c, for lines (..., 3, K)."""
    return lines[..., 0, :] * columns + lines[..., 1, :] * rows + lines[..., 2, :]


def screened(scene: Scene, camera: Camera, size: tuple[int, int], cull: str = "auto") -> Screened:
    """All faces of a posed scene as a camera sees them, hidden and culled ones too."""
    corners, sides = clip_corners(scene, camera, size, cull)
    x, y, z, w = corners.transpose(2, 1, 0)  # (3, F) each
    pixels = np.stack([(x + w) * size[0] / 2, (w - y) * size[1] / 2, w], axis=1)  # (3, 3, F) homogeneous
    edges = np.cross(pixels[[1, 2, 0]], pixels[[2, 0, 1]], axis=1)
    determinant = (pixels[0] * edges[0]).sum(axis=0)
    shown = (determinant != 0) & ((sides & np.where(determinant > 0, CLOCKWISE, COUNTER_CLOCKWISE)) != 0)
    # Depth is linear on the screen
    depth = (z[:, None] * edges).sum(axis=0) / np.where(determinant == 0, 1, determinant)
    slack = STEEP * SNAP * np.hypot(depth[0], depth[1]) + ROUNDING
    steep = np.hypot(edges[:, 0], edges[:, 1])[:, None]
    inwards = edges * np.sign(determinant) / np.where(steep > 0, steep, 1)
    return Screened(shown, inwards, depth, slack, boxes_of(corners, size))


def boxes_of(corners: FloatArray, size: tuple[int, int]) -> IntArray:
    """(F, 4) left, top, right, bottom of the pixels that faces (F, 3, 4) in clip space may touch.

    A face that reaches behind the eye may be anywhere.
    """
    x, y, w = corners[..., 0], corners[..., 1], corners[..., 3]
    before = w.min(axis=1) > 0
    safe = np.where(before[:, None], w, 1)
    ends = []
    for side, place in ((size[0], (x / safe + 1) / 2), (size[1], (1 - y / safe) / 2)):
        low = np.clip(np.floor(place.min(axis=1) * side) - 1, 0, side)
        high = np.clip(np.ceil(place.max(axis=1) * side) + 1, 0, side)
        ends.append((np.where(before, low, 0), np.where(before, high, side)))
    (left, right), (top, bottom) = ends
    return np.stack([left, top, right, bottom], axis=1).astype(np.int64)


def clip_corners(
    scene: Scene, camera: Camera, size: tuple[int, int], cull: str
) -> tuple[FloatArray, IntArray]:
    """Corners (F, 3, 4) of all faces in clip space, float64, and their sides (F,)."""
    camera = camera.fitted(scene.bounds)
    clip_from_world = camera.clip_from_eye(size[0] / size[1]) @ camera.eye_from_world
    corners, sides = [np.empty((0, 3, 4))], [np.empty(0, int)]
    for surface in scene.surfaces:
        matrix, mesh = clip_from_world @ surface.world_from_mesh, surface.mesh
        points = np.concatenate([mesh.points.astype(float), np.ones((len(mesh.points), 1))], axis=1)
        corners.append((points @ matrix.T)[mesh.faces])
        sides.append(np.broadcast_to(sides_of(surface, cull), len(mesh.faces)))
    return np.concatenate(corners), np.concatenate(sides)
