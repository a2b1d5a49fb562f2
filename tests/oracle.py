"""Slow and obviously right: what is seen at every pixel, by trying every face there.

`seen` answers for snapped faces in whole numbers: a method must equal it bit for bit. `truth` answers for the
scene itself, unsnapped and unclipped, and says where snapping cannot matter: there every method must agree.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from eyeline.projection.projected import CLOCKWISE, COUNTER_CLOCKWISE, Projected
from eyeline.projection.sides import sides_of
from eyeline.scene.camera import Camera
from eyeline.scene.scene import Scene

SNAP = 1 / 256  # pixels: more than a corner moves, in any direction, when it is snapped
STEEP = 8  # how many times the snap distance along its slope a depth may be off


def seen(projected: Projected) -> tuple[npt.NDArray[np.int32], npt.NDArray[np.float32]]:
    """(face, depth), (H, W) each, of snapped faces."""
    shape = projected.height, projected.width
    face, depth = np.full(shape, -1, np.int32), np.zeros(shape, np.float32)
    sides = np.broadcast_to(projected.sides, len(projected.faces))
    order = np.argsort(projected.source, kind="stable")  # a tie goes to the lower scene face
    for number in order[sides[order] != 0]:
        corners = projected.faces[number]
        covered, own = one_face(projected.xy[corners], projected.depth[corners], int(sides[number]), shape)
        nearer = covered & (own > depth)
        face[nearer], depth[nearer] = projected.source[number], own[nearer]
    return face, depth


def one_face(xy, z, sides: int, shape: tuple[int, int]):
    """(covered, depth) of one face at every pixel."""
    (x0, y0), (x1, y1), (x2, y2) = xy.astype(object).tolist()  # Python's numbers: as long as they need to be
    area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    if area == 0 or not sides & (CLOCKWISE if area > 0 else COUNTER_CLOCKWISE):
        return np.zeros(shape, bool), np.zeros(shape, np.float32)
    corners = [(y0, x0, z[0]), (y1, x1, z[1]), (y2, x2, z[2])]
    if area < 0:
        corners = [corners[0], corners[2], corners[1]]
    # Clockwise from the topmost corner, of those the leftmost
    start = corners.index(min(corners, key=lambda corner: corner[:2]))
    corners = corners[start:] + corners[:start]
    rows, columns = np.mgrid[: shape[0], : shape[1]].astype(np.int64)
    covered = np.ones(shape, bool)
    for (ya, xa, _), (yb, xb, _) in zip(corners, corners[1:] + corners[:1], strict=True):
        edge = (ya - yb) * (columns * 256 + 128 - xa) + (xb - xa) * (rows * 256 + 128 - ya)
        left_or_top = ya > yb or (ya == yb and xb > xa)
        covered &= (edge > 0) | ((edge == 0) & left_or_top)
    return covered, plane_depth(corners, rows.astype(np.float64), columns.astype(np.float64))


def plane_depth(corners, y, x) -> npt.NDArray[np.float32]:
    """The house's formula for depth, in its order of operations."""
    (y0, x0, z0), (y1, x1, z1), (y2, x2, z2) = [(float(y), float(x), float(z)) for y, x, z in corners]
    ux, uy, vx, vy = x1 - x0, y1 - y0, x2 - x0, y2 - y0
    scale = 256.0 / (ux * vy - vx * uy)
    a = ((z1 - z0) * vy - (z2 - z0) * uy) * scale
    b = ((z2 - z0) * ux - (z1 - z0) * vx) * scale
    c = z0 - a * ((x0 - 128) / 256) - b * ((y0 - 128) / 256)
    return ((c + b * y) + a * x).astype(np.float32)


@dataclass(frozen=True, eq=False)
class Truth:
    """What a camera sees of a scene, and where that is beyond doubt."""

    face: npt.NDArray[np.int32]  # (H, W)
    decidable: npt.NDArray[np.bool_]  # (H, W) farther than SNAP from every edge, and the depths well apart


def truth(scene: Scene, camera: Camera, size: tuple[int, int], cull: str = "auto") -> Truth:
    """Every face of a scene at every pixel, in homogeneous coordinates: nothing is clipped. [Olano97]"""
    width, height = size
    camera = camera.fitted(scene.bounds)
    clip_from_world = camera.clip_from_eye(width / height) @ camera.eye_from_world
    best, margin = (
        np.zeros((height, width)),
        np.zeros((height, width)),
    )  # depth of the nearest face, and its slack
    doubt = np.full((height, width), -np.inf)  # greatest depth that something else may have
    face = np.full((height, width), -1, np.int32)
    number = 0
    for surface in scene.surfaces:
        matrix = clip_from_world @ surface.world_from_mesh
        points = np.concatenate(
            [surface.mesh.points.astype(float), np.ones((len(surface.mesh.points), 1))], axis=1
        )
        sides = np.broadcast_to(sides_of(surface, cull), len(surface.mesh.faces))
        for corners, side in zip(points[surface.mesh.faces] @ matrix.T, sides, strict=True):
            inside, maybe, depth, slack = against(corners, int(side), size)
            nearer = inside & (depth > best)
            # What the winner must clear: losers, and what may be there
            doubt = np.where(nearer & (face >= 0), np.maximum(doubt, best + margin), doubt)
            doubt = np.where(maybe & ~nearer, np.maximum(doubt, depth + slack), doubt)
            face, best = np.where(nearer, np.int32(number), face), np.where(nearer, depth, best)
            margin = np.where(nearer, slack, margin)
            number += 1
    return Truth(face, doubt < best - margin)


def against(corners, side: int, size: tuple[int, int]):
    """(certainly covered, possibly covered, depth, slack of the depth) of one face (3, 4) in clip space."""
    width, height = size
    nothing = np.zeros((height, width), bool)
    x, y, w = (
        (corners[:, 0] + corners[:, 3]) * width / 2,
        (corners[:, 3] - corners[:, 1]) * height / 2,
        corners[:, 3],
    )
    pixels = np.stack([x, y, w], axis=1)  # homogeneous, in pixels
    edges = np.stack([np.cross(pixels[k - 2], pixels[k - 1]) for k in range(3)])
    determinant = float(pixels[0] @ edges[0])
    clockwise = determinant > 0
    if determinant == 0 or not side & (CLOCKWISE if clockwise else COUNTER_CLOCKWISE):
        return nothing, nothing, nothing.astype(float), 0.0
    rows, columns = np.mgrid[:height, :width] + 0.5
    values = [(e[0] * columns + e[1] * rows + e[2]) * np.sign(determinant) for e in edges]
    steepness = [np.hypot(e[0], e[1]) or 1.0 for e in edges]
    certain = np.logical_and.reduce([value > SNAP * s for value, s in zip(values, steepness, strict=True)])
    possible = np.logical_and.reduce([value > -SNAP * s for value, s in zip(values, steepness, strict=True)])
    plane = corners[:, 2] @ edges / determinant  # depth = plane . (column, row, 1)
    depth = plane[0] * columns + plane[1] * rows + plane[2]
    slack = STEEP * SNAP * float(np.hypot(plane[0], plane[1])) + 1e-6
    possible &= (depth < 1 + slack) & (depth > -slack)
    inside = certain & (depth < 1 - slack) & (depth > slack)
    return inside, possible | inside, depth, slack
