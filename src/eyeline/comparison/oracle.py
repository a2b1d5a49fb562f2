"""What is seen, by trying every face at every pixel, unsnapped and unclipped; and where that is beyond doubt.

Slow and plain: the judge of methods, not one of them. [Olano97]
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from eyeline.geometry.arrays import BoolArray, FloatArray, IntArray
from eyeline.projection.projected import CLOCKWISE, COUNTER_CLOCKWISE
from eyeline.projection.sides import sides_of
from eyeline.scene.camera import Camera
from eyeline.scene.scene import Scene

SNAP = 1 / 256  # pixels: more than a corner moves, in any direction, when it is snapped
STEEP = 8  # how many times the snap distance along its slope a depth may be off
ROUNDING = 1e-6  # of a depth

Verdict = tuple[BoolArray, BoolArray, FloatArray, FloatArray]


@dataclass(frozen=True, eq=False)
class Truth:
    """What a camera sees of a scene, and where that is beyond doubt."""

    face: IntArray  # (H, W)
    decidable: BoolArray  # (H, W) farther than SNAP from every edge, and the depths well apart


def truth(scene: Scene, camera: Camera, size: tuple[int, int], cull: str = "auto") -> Truth:
    """Every face of a posed scene at every pixel, in homogeneous coordinates: nothing is clipped."""
    rows, columns = np.mgrid[: size[1], : size[0]] + 0.5
    best, margin = np.zeros(rows.shape), np.zeros(rows.shape)  # depth of the nearest face, and its slack
    doubt = np.full(rows.shape, -np.inf)  # greatest depth that something else may have
    face = np.full(rows.shape, -1, np.int32)
    corners, sides = clip_corners(scene, camera, size, cull)
    for number, box in enumerate(boxes(corners, size)):
        if box is None:
            continue
        found = against(corners[number], sides[number], columns[box], rows[box], size)
        inside, maybe, depth, slack = found
        nearer = inside & (depth > best[box])
        # What the winner must clear: losers, and what may be there
        beaten = np.where(nearer & (face[box] >= 0), best[box] + margin[box], -np.inf)
        beside = np.where(maybe & ~nearer, depth + slack, -np.inf)
        doubt[box] = np.maximum(doubt[box], np.maximum(beaten, beside))
        face[box] = np.where(nearer, np.int32(number), face[box])
        best[box] = np.where(nearer, depth, best[box])
        margin[box] = np.where(nearer, slack, margin[box])
    return Truth(face, doubt < best - margin)


def boxes(corners: FloatArray, size: tuple[int, int]) -> list[tuple[slice, slice] | None]:
    """The rows and columns that each face (F, 3, 4) may touch; None for a face beside the picture.

    A face that reaches behind the eye may be anywhere.
    """
    x, y, w = corners[..., 0], corners[..., 1], corners[..., 3]
    before = np.min(w, axis=1) > 0
    safe = np.where(before[:, None], w, 1)
    ends = []
    for side, place in ((size[0], (x / safe + 1) / 2), (size[1], (1 - y / safe) / 2)):
        low = np.clip(np.floor(place.min(axis=1) * side) - 1, 0, side)
        high = np.clip(np.ceil(place.max(axis=1) * side) + 1, 0, side)
        ends.append((np.where(before, low, 0).astype(int), np.where(before, high, side).astype(int)))
    (left, right), (top, bottom) = ends
    return [
        (slice(a, b), slice(c, d)) if a < b and c < d else None
        for a, b, c, d in zip(top.tolist(), bottom.tolist(), left.tolist(), right.tolist(), strict=True)
    ]


def is_decidable(corners: FloatArray, sides: IntArray, size: tuple[int, int], column: int, row: int) -> bool:
    """`Truth.decidable` of one pixel: for scenes of more faces than `truth` can look at everywhere."""
    inside, maybe, depth, slack = against(corners, sides, column + 0.5, row + 0.5, size)
    if not inside.any():
        return not maybe.any()
    face = int(np.argmax(np.where(inside, depth, -np.inf)))
    maybe[face] = False
    return bool((depth + slack)[maybe].max(initial=-np.inf) < depth[face] - slack[face])


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


def against(corners: FloatArray, side: IntArray, columns: Any, rows: Any, size: tuple[int, int]) -> Verdict:
    """(certainly covered, possibly covered, depth, slack) of faces (..., 3, 4) in clip space at samples.

    One face at many samples, or many faces at one.
    """
    x, y, z, w = np.moveaxis(corners, -1, 0)
    pixels = np.stack([(x + w) * size[0] / 2, (w - y) * size[1] / 2, w], axis=-1)  # homogeneous
    edges = np.stack([np.cross(pixels[..., k - 2, :], pixels[..., k - 1, :]) for k in range(3)], axis=-2)
    determinant = (pixels[..., 0, :] * edges[..., 0, :]).sum(axis=-1)
    shown = (determinant != 0) & ((side & np.where(determinant > 0, CLOCKWISE, COUNTER_CLOCKWISE)) != 0)
    # Pixels from each edge to the sample, positive inside
    e = [edges[..., k, :] * np.sign(determinant)[..., None] for k in range(3)]
    steep = [np.hypot(one[..., 0], one[..., 1]) for one in e]
    reach = [
        (one[..., 0] * columns + one[..., 1] * rows + one[..., 2]) / np.where(s > 0, s, 1)
        for one, s in zip(e, steep, strict=True)
    ]
    certain = shown & np.logical_and.reduce([one > SNAP for one in reach])
    possible = shown & np.logical_and.reduce([one > -SNAP for one in reach])
    # Depth is linear on the screen: plane . (column, row, 1)
    plane = (z[..., None] * edges).sum(axis=-2) / np.where(determinant == 0, 1, determinant)[..., None]
    depth = plane[..., 0] * columns + plane[..., 1] * rows + plane[..., 2]
    slack = STEEP * SNAP * np.hypot(plane[..., 0], plane[..., 1]) + ROUNDING
    inside = certain & (depth < 1 - slack) & (depth > slack)
    return inside, inside | (possible & (depth < 1 + slack) & (depth > -slack)), depth, slack
