"""A scene and a camera become a picture's geometry: placed, clipped, snapped, once for every method."""

from __future__ import annotations

import numpy as np

from eyeline.errors import GeometryError, OptionError
from eyeline.geometry import transform
from eyeline.geometry.arrays import IntArray
from eyeline.geometry.fixedpoint import LARGEST_SIDE
from eyeline.geometry.memory import recycled
from eyeline.projection.cutting import with_pieces
from eyeline.projection.projected import Projected
from eyeline.projection.sides import checked_cull, joined, sides_of
from eyeline.projection.vertices import place
from eyeline.scene.camera import Camera
from eyeline.scene.scene import Scene
from eyeline.scene.surface import Surface


def project(scene: Scene, camera: Camera, size: tuple[int, int], cull: str = "auto") -> Projected:
    """What `camera` sees of a posed scene in a picture of `size` (width, height) pixels.

    cull: "auto" drops back faces of single-sided materials, "back" drops all, "none" keeps all.
    A camera without near and far planes gets them from the scene's bounds.
    """
    checked_cull(cull)
    width, height = checked_size(size)
    surfaces = scene.surfaces
    if not np.isfinite(camera.world_from_eye).all():
        raise GeometryError(f"camera {camera.name!r} stands at a place that is not finite")
    if camera.near is None or (camera.far is None and camera.fov is None):
        camera = camera.fitted(scene.bounds)
    vertex_counts = [len(surface.mesh.points) for surface in surfaces]
    face_counts = [len(surface.mesh.faces) for surface in surfaces]
    first_faces = np.concatenate([[0], np.cumsum(face_counts, dtype=np.int64)]).astype(np.int64)
    projected = Projected(
        xy=recycled((sum(vertex_counts), 2), np.int32),
        depth=recycled((sum(vertex_counts),), np.float32),
        faces=shared_faces(surfaces, vertex_counts),
        sides=joined([sides_of(surface, cull) for surface in surfaces], face_counts),
        face_count=sum(face_counts),
        piece_source=np.empty(0, dtype=np.int32),
        first_faces=first_faces,
        surfaces=surfaces,
        camera=camera,
        width=width,
        height=height,
    )
    unplaced = place_surfaces(projected)
    return with_pieces(projected, unplaced) if any(unplaced) else projected


def place_surfaces(projected: Projected) -> list[int]:
    """Fill the vertices of `projected`, surface after surface; how many of each could not be placed."""
    unplaced, begin = [], 0
    for surface in projected.surfaces:
        end = begin + len(surface.mesh.points)
        xy, depth = projected.xy[begin:end], projected.depth[begin:end]
        if not np.isfinite(surface.world_from_mesh).all():
            raise GeometryError(
                f"mesh {surface.mesh.name!r} of node {surface.node} stands at a place that is not finite"
            )
        clip_from_mesh = transform.product(projected.clip_from_world, surface.world_from_mesh)
        if surface.visible:
            unplaced.append(
                place(surface.mesh.points, clip_from_mesh, (projected.width, projected.height), xy, depth)
            )
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
