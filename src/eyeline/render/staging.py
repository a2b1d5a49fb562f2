"""What can be looked at: a scene, or a shot, which has written one."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from eyeline.errors import SceneError
from eyeline.scene.scene import Scene

if TYPE_CHECKING:
    from eyeline.motion.shot import Shot

Staged: TypeAlias = "Scene | Shot"


def staged(given: object) -> Scene:
    """The scene itself, or a shot's; anything else is refused, with the way to make a scene of it."""
    if isinstance(given, Scene):
        return given
    from eyeline.motion.shot import Shot  # who has none needs none of its modules
    from eyeline.scene.mesh import Mesh

    if isinstance(given, Shot):
        return given.scene
    way = "Scene.of(mesh) makes one" if isinstance(given, Mesh) else "eyeline.load reads one from a file"
    raise SceneError(f"a scene or a shot is needed, not a {type(given).__name__}; {way}")
