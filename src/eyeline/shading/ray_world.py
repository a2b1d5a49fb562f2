"""All solid faces of a picture in one tree, seen from the eye: what light rays meet."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.geometry.bvh import Bvh, bvh_of
from eyeline.projection.projected import Projected
from eyeline.shading.alpha import faces_of, has

LIFT_PART = 2.0**-13  # of the scene's diagonal: how far above its face a ray begins, not to meet it again


class RayWorld(NamedTuple):
    """Faces from the eye along the world's axes, and which scene faces they are."""

    tree: Bvh
    face: IntArray  # (F,) int32 scene face of each of the tree's
    lift: float  # metres
    picture: FloatArray  # (3, 4) float64: places from the eye to column w, row w, w


def ray_world(projected: Projected, diagonal: float) -> RayWorld:
    """The world of a picture, without what is hidden and without blended faces, which let light pass.

    diagonal: of the scene, metres.
    """
    eye = projected.camera.world_from_eye[:3, 3]
    points, faces, numbers, first = (
        [np.zeros((0, 3))],
        [np.zeros((0, 3), np.int32)],
        [np.zeros(0, np.int32)],
        0,
    )
    for surface in projected.surfaces:
        if not surface.visible:
            continue
        placed = transform.product(surface.mesh.points.astype(np.float64), surface.world_from_mesh[:3, :3].T)
        # The eye is taken off before rounding: far from the origin nothing trembles
        points.append(placed + (surface.world_from_mesh[:3, 3] - eye))
        faces.append(surface.mesh.faces + np.int32(first))
        numbers.append(surface.first_face + np.arange(len(surface.mesh.faces), dtype=np.int32))
        first += len(surface.mesh.points)
    corners, number = np.concatenate(faces), np.concatenate(numbers)
    if has(projected.surfaces, "blend"):
        solid = ~faces_of(projected.surfaces, "blend")[number]
        corners, number = corners[solid], number[solid]
    tree = bvh_of(np.concatenate(points).astype(np.float32), np.ascontiguousarray(corners))
    return RayWorld(tree, number, LIFT_PART * (diagonal or 1.0), picture_from_place(projected))


def picture_from_place(projected: Projected) -> FloatArray:
    """(3, 4): places from the eye, along the world's axes, to column w, row w, w."""
    from_eye = np.eye(4)
    from_eye[:3, 3] = projected.camera.world_from_eye[:3, 3]
    width, height = projected.width / 2, projected.height / 2
    half = np.array([[width, 0, 0, width], [0, -height, 0, height], [0, 0, 0, 1]])
    return transform.product(half, transform.product(projected.clip_from_world, from_eye))
