"""What rays are cast upon: the tree of every surface, how rays come to it, and the tiles it may be in."""

from __future__ import annotations

import threading
import weakref
from typing import NamedTuple

import numpy as np

from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray
from eyeline.geometry.bvh import Bvh, bvh_of
from eyeline.geometry.fixedpoint import UNITS
from eyeline.projection.projected import Projected
from eyeline.scene.mesh import Mesh
from eyeline.visibility.raycast.tiles import TILE

CORNERS = np.array([[x, y, z, 1] for x in (0, 1) for y in (0, 1) for z in (0, 1)], np.float64)

Place = tuple[int, int, int, int, int]  # first face; first and last column of tiles, first and last row

_trees: weakref.WeakKeyDictionary[Mesh, Bvh] = weakref.WeakKeyDictionary()
_keeping = threading.Lock()


class Cast(NamedTuple):
    """One surface before the rays."""

    tree: Bvh
    view: FloatArray  # (12,) float64: x w, y w and distance of the mesh's points, pixel (c, r) at c, r
    place: Place
    nearest: float  # metres along the view; nothing of it is nearer


def tree_of(mesh: Mesh) -> Bvh:
    """The tree over a mesh, made once."""
    with _keeping:
        tree = _trees.get(mesh)
    if tree is None:
        tree = bvh_of(mesh.points, mesh.faces)
        with _keeping:
            tree = _trees.setdefault(mesh, tree)
    return tree


def lens_of(projected: Projected) -> tuple[float, float, float, float]:
    """(w0, w1, near, far): w is w0 + w1 distance, and what is nearer or not before far does not count."""
    camera = projected.camera
    flat = camera.fov is None
    assert camera.near is not None
    far = float("inf") if camera.far is None else float(camera.far)
    return float(flat), float(not flat), float(camera.near), far


def casts_of(projected: Projected) -> list[Cast]:
    """Every surface that may be seen, the nearest first."""
    found = []
    for number, surface in enumerate(projected.surfaces):
        if surface.visible and len(surface.mesh.faces):
            tree = tree_of(surface.mesh)
            view = view_of(projected, surface.world_from_mesh)
            one = placed(projected, tree, view, int(projected.first_faces[number]))
            if one is not None:
                found.append(one)
    return sorted(found, key=lambda one: one.nearest)


def view_of(projected: Projected, world_from_mesh: FloatArray) -> FloatArray:
    """(3, 4): x w, y w and distance of a mesh's points; a sample of pixel (c, r) sees what is at c, r."""
    clip = transform.product(projected.clip_from_world, world_from_mesh)
    eye = transform.product(projected.camera.eye_from_world, world_from_mesh)
    dx, dy = (0.5 + part / UNITS for part in projected.shift)
    half_width, half_height = projected.width / 2, projected.height / 2
    across = clip[0] * half_width + clip[3] * (half_width - dx)
    down = clip[3] * (half_height - dy) - clip[1] * half_height
    return np.stack([across, down, -eye[2]])


def placed(projected: Projected, tree: Bvh, view: FloatArray, first_face: int) -> Cast | None:
    """A tree with the tiles that its box may be seen in; None where it cannot be seen."""
    w0, w1, near, far = lens_of(projected)
    size = np.append(tree.high - tree.low, 1.0)
    corners = transform.product(CORNERS * size + np.append(tree.low, 0.0), view.T)
    distance = corners[:, 2]
    last = [(projected.width - 1) // TILE, (projected.height - 1) // TILE]
    bounds = [(0, last[0]), (0, last[1])]
    if distance.max() < near or distance.min() > far:
        return None
    if distance.min() >= near:
        tiles = corners[:, :2] / (w0 + w1 * distance)[:, None] / TILE
        for axis in range(2):
            # A pixel more on either side than where it ends
            low = max(np.floor(tiles[:, axis].min() - 1 / TILE), 0)
            high = min(np.floor(tiles[:, axis].max() + 1 / TILE), last[axis])
            if low > high:
                return None
            bounds[axis] = int(low), int(high)
    place = first_face, *bounds[0], *bounds[1]
    nearest = np.nextafter(np.float32(distance.min()), np.float32(-np.inf))
    return Cast(tree, view.reshape(-1), place, float(nearest))
