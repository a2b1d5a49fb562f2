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
    rows, columns = np.mgrid[: size[1], : size[0]] + 0.5
    best, margin = np.zeros(rows.shape), np.zeros(rows.shape)  # depth of the nearest face, and its slack
    doubt = np.full(rows.shape, -np.inf)  # greatest depth that something else may have
    face = np.full(rows.shape, -1, np.int32)
    for number, (corners, side) in enumerate(zip(*clip_corners(scene, camera, size, cull), strict=True)):
        inside, maybe, depth, slack = against(corners, side, columns, rows, size)
        nearer = inside & (depth > best)
        # What the winner must clear: losers, and what may be there
        doubt = np.where(nearer & (face >= 0), np.maximum(doubt, best + margin), doubt)
        doubt = np.where(maybe & ~nearer, np.maximum(doubt, depth + slack), doubt)
        face, best = np.where(nearer, np.int32(number), face), np.where(nearer, depth, best)
        margin = np.where(nearer, slack, margin)
    return Truth(face, doubt < best - margin)


def is_decidable(corners, sides, size: tuple[int, int], column: int, row: int) -> bool:
    """`Truth.decidable` of one pixel: for scenes of more faces than `truth` can look at everywhere."""
    inside, maybe, depth, slack = against(corners, sides, column + 0.5, row + 0.5, size)
    if not inside.any():
        return not maybe.any()
    face = np.argmax(np.where(inside, depth, -np.inf))
    maybe[face] = False
    return bool((depth + slack)[maybe].max(initial=-np.inf) < depth[face] - slack[face])


def clip_corners(scene: Scene, camera: Camera, size: tuple[int, int], cull: str):
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


def against(corners, side, columns, rows, size: tuple[int, int]):
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
    slack = STEEP * SNAP * np.hypot(plane[..., 0], plane[..., 1]) + 1e-6
    inside = certain & (depth < 1 - slack) & (depth > slack)
    return inside, inside | (possible & (depth < 1 + slack) & (depth > -slack)), depth, slack
