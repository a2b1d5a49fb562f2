"""Frames to shade, in one line: what tests of shading share."""

from __future__ import annotations

import numpy as np

from eyeline.geometry.arrays import ByteArray, FloatArray
from eyeline.projection import project
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.shading.attributes import attributes_of
from eyeline.shading.frame import Frame, Strip
from eyeline.shading.look import Look
from eyeline.shading.picture import shade
from eyeline.visibility import METHODS

FOUR = ((-32, -96), (96, -32), (32, 96), (-96, 32))
FRONT = Camera(height=2.0, near=0.5, far=100.0)  # at the origin, looks along -z


def frame_of(
    scene: Scene,
    camera: Camera = FRONT,
    size: tuple[int, int] = (48, 32),
    shifts: tuple[tuple[int, int], ...] = ((0, 0),),
    look: Look | None = None,
) -> Frame:
    """What a camera sees of a scene, by the depth buffer."""
    projected = project(scene, camera, size, "none")
    visibles = [(METHODS["zbuffer"](projected.shifted(dx, dy)), dx, dy) for dx, dy in shifts]
    return Frame(scene, projected, visibles, look or Look())


def picture_of(frame: Frame) -> ByteArray:
    """(H, W, 4)."""
    return shade(frame.scene, frame.projected, frame.visibles, frame.look)


def lanes_of(frame: Frame) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The attributes (ROWS, K) of every point of a frame, and its column and row in the picture."""
    points = Strip(frame, 0, frame.projected.height).points
    return attributes_of(frame, points), points.x, points.y


def square(size: float = 1.0, z: float = -2.0, **attributes: object) -> Mesh:
    """Two faces towards +z, counter-clockwise from the lower left, where uv is (0, 1)."""
    points = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], float) * size / 2 + (0, 0, z)
    values: dict[str, object] = {"uv": [[(0, 1), (1, 1), (1, 0), (0, 0)]]} | attributes
    return Mesh(points, [(0, 1, 2), (0, 2, 3)], **values)  # type: ignore[arg-type]
