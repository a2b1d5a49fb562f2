"""One picture of a scene."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from eyeline.render.sampling import sample_positions
from eyeline.render.shot import SIZE, Shot, shot_of
from eyeline.render.staging import Staged, staged
from eyeline.render.viewpoint import CameraChoice, chosen_camera

if TYPE_CHECKING:
    from eyeline.render.image import Image
    from eyeline.scene.camera import Camera
    from eyeline.scene.scene import Scene


def render(
    scene: Staged,
    camera: CameraChoice = None,
    size: tuple[int, int] = SIZE,
    time: float = 0.0,
    method: str = "zbuffer",
    style: str = "shaded",
    samples: int = 4,
    **options: Any,
) -> Image:
    """What a camera sees of a scene at a time (seconds), as a picture.

    camera: a Camera, or the name or number of one in the scene; None is the scene's first, or a view that
    frames the scene. size: (width, height), pixels. samples: a pixel: 1, 2, 4, 8 or 16. options: clip,
    cull="auto", and what eyeline.shading.look.Look takes: background, ground, exposure, tone, shadows ...
    """
    shot = shot_of(style, camera=camera, size=size, method=method, samples=samples, **options)
    posed = staged(scene).at(time, shot.clip)
    width, height = shot.size
    return picture(posed, chosen_camera(posed, camera, width / height), shot)


def picture(posed: Scene, camera: Camera, shot: Shot) -> Image:
    """A posed scene through a camera."""
    from eyeline.projection import project
    from eyeline.render.image import Image
    from eyeline.shading import STYLES, shade
    from eyeline.shading.cutout import see
    from eyeline.visibility import method_named

    projected = project(posed, camera, shot.size, shot.cull)
    method, shifts = method_named(shot.method), sample_positions(shot.samples)
    visibles = see(posed, projected, method, shifts, see_through=STYLES[shot.look.style].see_through)
    return Image(shade(posed, projected, visibles, shot.look))
