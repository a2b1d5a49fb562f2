"""The lights of a scene, and the studio rig for a scene that has none."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray
from eyeline.scene.camera import Camera
from eyeline.scene.light import Light
from eyeline.scene.scene import Scene
from eyeline.shading.environment import environment
from eyeline.shading.light_table import PlacedLight

OWN_SIZE = 0.012  # of a file's lights, which have none: their shadows' outlines are a little soft


@dataclass(frozen=True, eq=False)
class Lighting:
    """Everything that shines."""

    lights: tuple[PlacedLight, ...]
    environment: FloatArray  # (12,), see environment.py
    studio: bool  # whether it is our own rig


def lighting_of(scene: Scene, camera: Camera) -> Lighting:
    """The scene's own lights with a modest glow around them, or the studio rig."""
    own = tuple(PlacedLight(light, matrix, OWN_SIZE) for light, matrix in scene.lights)
    if not own:
        return studio_rig(camera)
    glow = np.array([0.055, 0.06, 0.066])
    return Lighting(own, environment(glow, glow * 0.6, np.zeros(3), np.array([0.0, 1.0, 0.0])), False)


def studio_rig(camera: Camera) -> Lighting:
    """Key from the upper left front, fill from the right, rim from behind; it turns with the camera about y.

    Like a photographer's lights it stands around the camera, upright, whatever the camera's height.
    """
    level = _level_axes(camera)
    lights = tuple(
        PlacedLight(
            Light("directional", color, intensity),
            transform.look_at(level @ np.array(place), (0, 0, 0)),
            size,
        )
        for place, color, intensity, size in (
            ((-0.62, 1.0, 0.68), (1.0, 0.985, 0.96), 2.25, 0.14),
            ((0.95, 0.28, 0.55), (0.93, 0.965, 1.0), 0.2, 0.30),
            ((0.45, 0.75, -0.95), (1.0, 1.0, 1.0), 0.8, 0.15),
        )
    )
    box_axis = level @ np.array([-0.25, 0.95, 0.2])
    parts = environment(
        np.array([0.26, 0.267, 0.278]), np.array([0.144, 0.142, 0.137]), np.full(3, 0.4),
        box_axis / np.sqrt((box_axis**2).sum()),
    )  # fmt: skip
    return Lighting(lights, parts, True)


def _level_axes(camera: Camera) -> FloatArray:
    """(3, 3) columns right, up, back of a camera that is held level."""
    right = camera.world_from_eye[:3, 0] * np.array([1.0, 0.0, 1.0])
    length = np.sqrt((right**2).sum())
    right = right / length if length > 0 else np.array([1.0, 0.0, 0.0])
    up = np.array([0.0, 1.0, 0.0])
    return np.stack([right, up, np.cross(right, up)], axis=-1)
