"""What a camera sees of a scene, as data."""

from __future__ import annotations

from typing import TYPE_CHECKING

from eyeline.projection.project import checked_size, project
from eyeline.render.staging import Staged, staged
from eyeline.render.viewpoint import CameraChoice, chosen_camera
from eyeline.shading.cutout import see
from eyeline.visibility import method_named

if TYPE_CHECKING:
    from eyeline.visibility.method import Visible


def visible(
    scene: Staged,
    camera: CameraChoice = None,
    size: tuple[int, int] = (1280, 720),
    time: float = 0.0,
    *,
    method: str = "zbuffer",
    cull: str = "auto",
    clip: str | int | None = None,
) -> Visible:
    """Which face is seen at every pixel, how far away, and of which node.

    Transparent surfaces count as solid; the holes of cut-out ones (alpha_mode "mask") are open.
    """
    answer = method_named(method)
    width, height = checked_size(size)
    posed = staged(scene).at(time, clip)
    projected = project(posed, chosen_camera(posed, camera, width / height), (width, height), cull)
    ((seen, _, _),) = see(posed, projected, answer)
    return seen
