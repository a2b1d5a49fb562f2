"""One mesh of whatever has a shape, and looks between two looks."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from eyeline.errors import GeometryError
from eyeline.geometry import transform
from eyeline.geometry.arrays import IntArray
from eyeline.scene.colour import mix
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.scene.surface import Surface


def mesh_of(shape: Mesh | Scene) -> Mesh:
    """A mesh as it is; of a scene, all visible surfaces where they stand, in one: points, faces, materials.

    Refused: a shape without faces.
    """
    if isinstance(shape, Mesh):
        mesh = shape
    else:
        surfaces = [one for one in shape.surfaces if one.visible]
        if not surfaces:
            raise GeometryError(f"scene {shape.name!r} has no visible mesh; a shape needs one")
        mesh = surfaces[0].mesh if is_plain(surfaces) else joined(surfaces)
    if len(mesh.faces) == 0:
        raise GeometryError(f"mesh {mesh.name!r} has no faces; a shape needs some")
    return mesh


def is_plain(surfaces: list[Surface]) -> bool:
    """Whether it is one mesh that stands where it was made."""
    return len(surfaces) == 1 and bool((surfaces[0].world_from_mesh == transform.identity()).all())


def joined(surfaces: list[Surface]) -> Mesh:
    """All surfaces in the world; mirrored ones keep their outside."""
    points = [transform.apply(one.world_from_mesh, one.mesh.points.astype(np.float64)) for one in surfaces]
    faces = [one.mesh.faces[:, ::-1] if one.mirrored else one.mesh.faces for one in surfaces]
    starts = np.cumsum([0, *map(len, points)])
    material_starts = np.cumsum([0, *(len(one.mesh.materials) for one in surfaces)])
    return Mesh(
        np.concatenate(points),
        np.concatenate([one + start for one, start in zip(faces, starts, strict=False)]),
        materials=[material for one in surfaces for material in one.mesh.materials],
        face_material=np.concatenate(
            [face_materials(one.mesh) + first for one, first in zip(surfaces, material_starts, strict=False)]
        ),
    )


def face_materials(mesh: Mesh) -> IntArray:
    """(F,) which material each face has."""
    if mesh.face_material is None:
        return np.zeros(len(mesh.faces), np.int64)
    return mesh.face_material


def material_between(start: Material, end: Material, part: float) -> Material:
    """Colours in even steps for the eye, roughness and the rest straight; textures are those of the start."""
    if start is end or part == 0:
        return start
    part = min(1.0, max(0.0, part))
    base = mix(start.base_color[:3], end.base_color[:3], part).tolist()
    alpha = straight(start.base_color[3], end.base_color[3], part)
    red, green, blue = mix(start.emissive, end.emissive, part, "linear").tolist()
    return replace(
        start,
        base_color=(base[0], base[1], base[2], alpha),
        emissive=(red, green, blue),
        metallic=straight(start.metallic, end.metallic, part),
        roughness=straight(start.roughness, end.roughness, part),
    )


def straight(start: float, end: float, part: float) -> float:
    """The number at a part of the way."""
    return (1 - part) * start + part * end
