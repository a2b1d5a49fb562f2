"""Errands that between them run every kernel, so that each is compiled and kept."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from eyeline.render.drawing import draw
from eyeline.render.frame import render
from eyeline.render.visible import visible
from eyeline.scene.camera import Camera

if TYPE_CHECKING:
    from eyeline.deform.run import Deformed
    from eyeline.drawing.sheet import Sheet
    from eyeline.geometry.rays import Hits
    from eyeline.scene.scene import Scene
    from eyeline.shapes.deviation import Deviation
    from eyeline.visibility.method import Visible
    from eyeline.visibility.visible_edges import VisibleEdges

SIZE = (64, 48)


def errands() -> list[Callable[[], object]]:
    """Small things to make: every sample in the default style, each style and method of one, moves."""
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
        partial(render, mirror(), size=SIZE, style="traced"),
        *(partial(edges, scene) for scene in scenes.values()),
        rays,
        *(partial(drawn, scene) for scene in scenes.values()),
        deformed,
        between,
        eased,
    ]


def recall(scene: Scene) -> Visible:
    """A scene seen again by the octree, with what it saw as its hint."""
    from eyeline.visibility.octree.octree import Octree

    seen = visible(scene, size=SIZE, method="octree")
    return Octree(hint=seen)(seen.projected)


def edges(scene: Scene) -> VisibleEdges | Visible:
    """What Roberts sees of a scene."""
    from eyeline.projection import project
    from eyeline.visibility import METHODS

    return METHODS["roberts"](project(scene, Camera.framing(scene.bounds), SIZE))


def mirror() -> Scene:
    """A polished ball, and something for it to show."""
    from eyeline.samples import sphere
    from eyeline.scene.material import Material
    from eyeline.scene.node import Node
    from eyeline.scene.scene import Scene

    ball = sphere().surfaces[0].mesh
    polished = ball.with_material(Material(metallic=1.0, roughness=0.0))
    return Scene.of(polished, Node("beside it", mesh=ball, translation=(1.1, 0, 0)))


def rays() -> Hits:
    """More rays than are cast in the order they come."""
    from eyeline.geometry.bvh import bvh_of
    from eyeline.geometry.rays import CHUNK, first_hits

    mesh = puppet().surfaces[0].mesh
    directions = np.full((CHUNK + 1, 3), -1, np.float32)
    return first_hits(bvh_of(mesh.points, mesh.faces), -directions, directions)


def deformed() -> Deformed:
    """Points that each deformer with a kernel of its own has moved, and what mixes and fades them."""
    from eyeline.deform.bend import Bend
    from eyeline.deform.composite import Composite, Mixture
    from eyeline.deform.inflate import Inflate
    from eyeline.deform.lattice import Lattice
    from eyeline.deform.rigid import Rotation
    from eyeline.deform.spherify import Spherify
    from eyeline.deform.stretch import Stretch
    from eyeline.deform.taper import Taper
    from eyeline.deform.twist import Twist
    from eyeline.deform.wave import Wave

    mesh = puppet().surfaces[0].mesh
    single = (
        *(one(0.5) for one in (Bend, Inflate, Spherify, Stretch, Taper, Twist, Wave)),
        Lattice(np.full((2, 2, 2, 3), 0.1)),
        Rotation(0.5),
    )
    tangents = np.tile(np.array([1, 0, 0, 1], np.float32), (len(mesh.points), 1))
    return Composite((Mixture(single), Composite(single, reach=1.0)))(mesh.points, mesh.normals, tangents)


def between() -> Deviation:
    """Half of the way from a ball to a cube by level sets, and how far it strays at the start."""
    from eyeline.samples import cube, sphere
    from eyeline.shapes.level_set import LevelSet

    way = LevelSet(sphere(), cube(), cells=16)
    way.at(0.5)
    return way.error[0]


def eased() -> Scene:
    """A node that goes by a curve of Bezier handles, and an easing by itself."""
    from eyeline.motion import Clip, Curve, Track, easing
    from eyeline.scene.node import Node
    from eyeline.scene.scene import Scene

    easing("ease_in")(np.array([0.5]))
    way = Curve.of({0.0: (0, 0, 0), 1.0: (1, 0, 0)}, ease="ease_out_back")
    clip = Clip("way", [Track("node", "ball", "translation", way)])
    return replace(Scene.of(Node("ball")), clips=(clip,)).at(0.5)


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
