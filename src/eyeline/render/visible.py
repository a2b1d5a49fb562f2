"""What a camera sees of a scene, as data."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from eyeline.render.shot import SIZE, Shot
from eyeline.render.viewpoint import CameraChoice, chosen_camera

if TYPE_CHECKING:
    from eyeline.scene.scene import Scene
    from eyeline.visibility.method import Visible


def visible(
    scene: Scene,
    camera: CameraChoice = None,
    size: tuple[int, int] = SIZE,
    time: float = 0.0,
    *,
    method: str = "zbuffer",
    cull: str = "auto",
    clip: str | int | None = None,
) -> Visible:
    """Which face is seen at every pixel, how far away, and of which node.

    Transparent surfaces count as solid; the holes of cut-out ones (alpha_mode "mask") are open.
    """
    from eyeline.projection import project
    from eyeline.visibility import METHODS

    shot = Shot(camera, size, clip, method, 1, cull)
    posed = scene.at(time, clip)
    width, height = shot.size
    projected = project(posed, chosen_camera(posed, camera, width / height), shot.size, cull)
    return replace(METHODS[method](projected), scene=posed)
