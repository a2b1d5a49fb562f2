"""A colour for every face of a scene, light where it faces the light, so that neighbours differ."""

from __future__ import annotations

import numpy as np

from eyeline.geometry import transform
from eyeline.geometry.arrays import ByteArray, FloatArray
from eyeline.scene.camera import Camera
from eyeline.scene.colour import srgb_from_linear
from eyeline.scene.scene import Scene
from eyeline.shading.styles.id import id_colours

LIGHT = (-0.45, 0.7, 0.55)  # to the light, in the eye's axes
AMBIENT = 0.35
GOLDEN = (5**0.5 - 1) / 2
MIXED = 0.45  # how much of a colour of its own a face has, where all are of one material
VARIETY = 0.16  # how far the lightness of faces of one colour is spread


def face_colours(scene: Scene, camera: Camera) -> ByteArray:
    """(F, 3) sRGB, a row for each face of a posed scene: its material's colour in a lamp beside the eye."""
    rows = [np.empty((0, 3))]
    to_light = camera.world_from_eye[:3, :3] @ (np.array(LIGHT) / np.sqrt(np.dot(LIGHT, LIGHT)))
    for surface in scene.surfaces:
        mesh = surface.mesh
        points = transform.apply(surface.world_from_mesh, mesh.points.astype(np.float64))
        of_material = np.array([material.base_color[:3] for material in mesh.materials])
        chosen = np.zeros(len(mesh.faces), int) if mesh.face_material is None else mesh.face_material
        rows.append(of_material[chosen] * lit(points[mesh.faces], to_light)[:, None])
    linear = np.concatenate(rows)
    if len({material.base_color for surface in scene.surfaces for material in surface.mesh.materials}) < 2:
        # One colour for all would not tell a face from the next
        linear = MIXED * id_colours(np.arange(len(linear)))[:, :3] + (1 - MIXED) * linear
    spread = 1 + VARIETY * (np.arange(len(linear)) * GOLDEN % 1.0 - 0.5)
    shown: FloatArray = srgb_from_linear(np.clip(linear * spread[:, None], 0, 1))
    return (shown * 255 + 0.5).astype(np.uint8)


def lit(corners: FloatArray, to_light: FloatArray) -> FloatArray:
    """(F,) how bright faces (F, 3, 3) are, whichever side the light falls on."""
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.sqrt((normal**2).sum(axis=1))
    cosine = np.abs(normal @ to_light) / np.where(length > 0, length, 1)
    bright: FloatArray = AMBIENT + (1 - AMBIENT) * cosine
    return bright
