"""Built-in models, made by code: no file is needed to see something."""

from __future__ import annotations

from collections.abc import Callable

from eyeline.samples.bouncing_ball import bouncing_ball
from eyeline.samples.cornell_box import cornell_box
from eyeline.samples.demo_shot import demo_shot
from eyeline.samples.desk_lamp import desk_lamp
from eyeline.samples.flour_sack import flour_sack
from eyeline.samples.hard_cases import (
    HARD_CASES,
    concave_body,
    convex_body,
    coplanar_faces,
    cyclic_overlap,
    deep_stack,
    edge_on_faces,
    piercing_faces,
    t_junction,
)
from eyeline.samples.solids import cube, sphere, torus
from eyeline.samples.teapot import teapot
from eyeline.scene.scene import Scene

__all__ = [
    "CHARACTERS",
    "HARD_CASES",
    "SAMPLES",
    "bouncing_ball",
    "concave_body",
    "convex_body",
    "coplanar_faces",
    "cornell_box",
    "cube",
    "cyclic_overlap",
    "deep_stack",
    "demo_shot",
    "desk_lamp",
    "edge_on_faces",
    "flour_sack",
    "piercing_faces",
    "sphere",
    "t_junction",
    "teapot",
    "torus",
]

SAMPLES: dict[str, Callable[[], Scene]] = {
    make.__name__: make
    for make in (
        sphere, cube, torus, teapot, cornell_box, desk_lamp, bouncing_ball, demo_shot,
        flour_sack,
        cyclic_overlap, piercing_faces, coplanar_faces, edge_on_faces, t_junction, deep_stack,
        convex_body, concave_body,
    )
}  # fmt: skip

CHARACTERS = ("flour_sack",)  # those of them that act: rigged, with controls and constraints
