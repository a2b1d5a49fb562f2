"""Which camera takes the picture."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from eyeline.errors import SceneError, suggestion
from eyeline.geometry import transform
from eyeline.geometry.bounds import Bounds
from eyeline.scene.camera import Camera
from eyeline.scene.scene import Scene

CameraChoice = Camera | str | int | None


def chosen_camera(scene: Scene, choice: CameraChoice, aspect: float, bounds: Bounds | None = None) -> Camera:
    """The camera of a posed scene by name or number, or the one that is given.

    None is the scene's first camera; where the scene has none, a view that frames `bounds` (the scene's own
    if left out) in a picture of this width / height.
    """
    if isinstance(choice, Camera):
        return choice
    cameras = scene.cameras
    if choice is None:
        return cameras[0] if cameras else Camera.framing(scene.bounds if bounds is None else bounds, aspect)
    names = [camera.name for camera in cameras]
    if choice in names:
        return cameras[names.index(str(choice))]
    number = int(choice) if isinstance(choice, int) or (choice.isdecimal() and choice.isascii()) else -1
    if 0 <= number < len(cameras):
        return cameras[number]
    raise SceneError(f"there is no camera {choice!r}{suggestion(str(choice), names)}")


def orbited(camera: Camera, bounds: Bounds, turn: float) -> Camera:
    """`camera` carried by `turn` radians around the vertical axis through the middle of `bounds`."""
    half = turn / 2
    spin = transform.compose((0, 0, 0), (0, np.sin(half), 0, np.cos(half)), (1, 1, 1))
    there, back = transform.identity(), transform.identity()
    there[:3, 3], back[:3, 3] = bounds.centre, -bounds.centre
    return replace(camera, world_from_eye=there @ spin @ back @ camera.world_from_eye)
