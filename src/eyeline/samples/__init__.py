"""Built-in models, made by code: no file is needed to see something."""

from __future__ import annotations

from collections.abc import Callable

from eyeline.samples.bouncing_ball import bouncing_ball
from eyeline.samples.cornell_box import cornell_box
from eyeline.samples.demo_shot import demo_shot
from eyeline.samples.desk_lamp import desk_lamp
from eyeline.samples.solids import cube, sphere, torus
from eyeline.samples.teapot import teapot
from eyeline.scene.scene import Scene

__all__ = [
    "SAMPLES",
    "bouncing_ball",
    "cornell_box",
    "cube",
    "demo_shot",
    "desk_lamp",
    "sphere",
    "teapot",
    "torus",
]

SAMPLES: dict[str, Callable[[], Scene]] = {
    make.__name__: make
    for make in (sphere, cube, torus, teapot, cornell_box, desk_lamp, bouncing_ball, demo_shot)
}
