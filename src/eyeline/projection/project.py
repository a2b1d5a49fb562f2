"""A scene and a camera become a picture's geometry: placed, clipped, snapped, once for every method."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import accumulate
from typing import Any

import numpy as np

from eyeline.errors import GeometryError, OptionError
from eyeline.geometry.arrays import IntArray
from eyeline.geometry.fixedpoint import LARGEST_SIDE
from eyeline.geometry.memory import recycled
from eyeline.projection.cutting import with_pieces
from eyeline.projection.projected import Projected
from eyeline.projection.promised import Promised
from eyeline.projection.sides import checked_cull, joined, sides_of
from eyeline.projection.vertices import place
from eyeline.scene.camera import Camera
from eyeline.scene.scene import Scene
from eyeline.scene.surface import Surface

MOST_FACES = 2**31 - 1  # a face's number has 32 bits, one of which is the background's


def project(scene: Scene, camera: Camera, size: tuple[int, int], cull: str = "auto") -> Projected:
    """What `camera` sees of a posed scene in a picture of `size` (width, height) pixels.

    cull: "auto" drops back faces of single-sided materials, "back" drops all, "none" keeps all.
    A camera without near and far planes gets them from the scene's bounds. Vertices are placed and faces cut
    when somebody first asks for them.
    """
    checked_cull(cull)
    width, height = checked_size(size)
    surfaces = scene.surfaces
    if not all(map(math.isfinite, camera.world_from_eye.flat)):
        raise GeometryError(f"camera {camera.name!r} stands at a place that is not finite")
    if camera.near is None or (camera.far is None and camera.fov is None):
        camera = camera.fitted(scene.bounds)
    # Plain numbers: of few surfaces each call of NumPy would take longer than the rest
    face_counts = (len(surface.mesh.faces) for surface in surfaces)
    first_faces = np.array([*accumulate(face_counts, initial=0)], dtype=np.int64)
    if first_faces[-1] > MOST_FACES:
        raise GeometryError(f"the scene has {first_faces[-1]:,} faces; {MOST_FACES:,} can be numbered")
    known = {
        "face_count": int(first_faces[-1]),
        "first_faces": first_faces,
        "surfaces": surfaces,
        "camera": camera,
        "width": width,
        "height": height,
    }
    projected = Promised.of(lambda: whole(cull, known), cull, **known)
    finite = np.isfinite(projected.places).all(axis=(1, 2))
    if not finite.all():
        lost = surfaces[int(np.argmin(finite))]
        raise GeometryError(
            f"mesh {lost.mesh.name!r} of node {lost.node} stands at a place that is not finite"
        )
    return projected


def whole(cull: str, known: Mapping[str, Any]) -> Projected:
    """A picture with all its vertices and faces, of what is known about it without them."""
    surfaces = known["surfaces"]
    vertex_counts = [len(surface.mesh.points) for surface in surfaces]
    face_counts = [len(surface.mesh.faces) for surface in surfaces]
    projected = Projected(
        xy=recycled((sum(vertex_counts), 2), np.int32),
        depth=recycled((sum(vertex_counts),), np.float32),
        faces=shared_faces(surfaces, vertex_counts),
        sides=joined([sides_of(surface, cull) for surface in surfaces], face_counts),
        piece_source=np.empty(0, dtype=np.int32),
        **known,
    )
    unplaced = place_surfaces(projected)
    return with_pieces(projected, unplaced) if any(unplaced) else projected


def place_surfaces(projected: Projected) -> list[int]:
    """Fill the vertices of `projected`, surface after surface; how many of each could not be placed."""
    unplaced, begin = [], 0
    size = projected.width, projected.height
    for surface, clip_from_mesh in zip(projected.surfaces, projected.clip_from_meshes, strict=True):
        end = begin + len(surface.mesh.points)
        xy, depth = projected.xy[begin:end], projected.depth[begin:end]
        if surface.visible:
            unplaced.append(place(surface.mesh.points, clip_from_mesh, size, xy, depth))
        else:
            xy[:], depth[:] = 0, -np.inf
            unplaced.append(0)
        begin = end
    return unplaced


def shared_faces(surfaces: tuple[Surface, ...], vertex_counts: list[int]) -> IntArray:
    """(F, 3) the faces of all surfaces over one row of vertices; those of a single surface, as they are."""
    if len(surfaces) == 1:
        return surfaces[0].mesh.faces
    faces = np.empty((sum(len(surface.mesh.faces) for surface in surfaces), 3), dtype=np.int32)
    face, vertex = 0, 0
    for surface, count in zip(surfaces, vertex_counts, strict=True):
        end = face + len(surface.mesh.faces)
        np.add(surface.mesh.faces, np.int32(vertex), out=faces[face:end])
        face, vertex = end, vertex + count
    return faces


def checked_size(size: tuple[int, int]) -> tuple[int, int]:
    """(width, height), if a picture can have it."""
    try:
        width, height = (int(side) for side in size)
    except (TypeError, ValueError):
        raise OptionError(f"size is {size!r}; width and height are needed, as (1280, 720)") from None
    for name, side in (("width", width), ("height", height)):
        if not 1 <= side <= LARGEST_SIDE:
            raise OptionError(f"{name} is {side} pixels; 1 to {LARGEST_SIDE} is needed")
    return width, height
