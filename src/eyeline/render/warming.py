"""Errands that between them run every kernel, so that each is compiled and kept."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from eyeline.render.drawing import draw
from eyeline.render.frame import render
from eyeline.render.visible import visible

if TYPE_CHECKING:
    from eyeline.drawing.sheet import Sheet
    from eyeline.scene.scene import Scene
    from eyeline.visibility.method import Visible

SIZE = (64, 48)


def errands() -> list[Callable[[], object]]:
    """Small things to make: every sample in the default style, every style and method of one, drawings."""
    from eyeline.samples import SAMPLES
    from eyeline.shading.styles import STYLES
    from eyeline.visibility import METHODS

    scenes = {name: make() for name, make in SAMPLES.items()}
    first = next(iter(scenes.values()))
    answering = [name for name, method in METHODS.items() if method.answers]
    return [
        *(partial(render, scene, size=SIZE) for scene in (*scenes.values(), puppet())),
        *(partial(render, first, size=SIZE, style=style) for style in STYLES),
        *(partial(render, first, size=SIZE, samples=1, method=method) for method in answering),
        lambda: visible(first, size=SIZE).node,
        partial(recall, first),
        *(partial(drawn, scene) for scene in scenes.values()),
    ]


def recall(scene: Scene) -> Visible:
    """A scene seen again by the octree, with what it saw as its hint."""
    from eyeline.visibility.octree import Octree

    seen = visible(scene, size=SIZE, method="octree")
    return Octree(hint=seen)(seen.projected)


def drawn(scene: Scene) -> Sheet:
    """All lines of a scene, chained."""
    return draw(scene, size=SIZE, hidden="dashed").sheet


def puppet() -> Scene:
    """A triangle with all that files bring and samples do not: a texture, a skin and a morph target."""
    from eyeline.scene.material import Material
    from eyeline.scene.mesh import Mesh, MorphTarget
    from eyeline.scene.node import Node
    from eyeline.scene.scene import Scene
    from eyeline.scene.skin import Skin
    from eyeline.scene.texture import Texture, TextureSlot

    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
    texture = TextureSlot(Texture(np.full((4, 4, 4), 200, np.uint8)))
    mesh = Mesh(
        points, [[0, 1, 2]], uv=[points[:, :2]], material=Material(base_color_texture=texture),
        targets=[MorphTarget(points)], weights=[0.5],
        joints=np.zeros((3, 1)), influences=np.ones((3, 1)),
    )  # fmt: skip
    return Scene.of(Node("joint"), Node("puppet", mesh=mesh, skin=Skin((0,), np.eye(4)[None])))
