"""Shadows fall where straight lines say."""

from __future__ import annotations

import math

import numpy as np
import pytest

from eyeline.geometry import transform
from eyeline.samples import sphere
from eyeline.scene.camera import Camera
from eyeline.scene.light import Light
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene
from eyeline.shading.lanes import LIT, X, Z
from eyeline.shading.look import Look
from eyeline.shading.shadow import arrive
from eyeline.shading.stage import stage_of
from frames import frame_of, lanes_of, picture_of

# From above the floor fills the picture: x to the right, z downwards, 20 pixels a metre
ABOVE = Camera.look_at((0, 8, 0), (0, 0, 0), (0, 0, -1), height=4.8)
SIZE = (96, 96)
ABOUT_A_TEXEL = 0.15  # metres, and the softness of the outline with it


def floor_and_lid(height: float = 1.0, material: Material | None = None) -> tuple[Mesh, Mesh]:
    """A floor of 8 x 8 m at y = 0, and a lid of 1 x 1 m over its middle."""
    corners = np.array([(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)], float)
    faces = [(0, 1, 2), (0, 2, 3)]
    lid = Mesh(corners / 2 + (0, height, 0), faces, material=material or Material())
    return Mesh(corners * 4, faces), lid


def lit_floor(light: Node, lid: Mesh, floor: Mesh) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """LIT of the floor's points, and their x and z."""
    frame = frame_of(Scene.of(light, floor, lid), ABOVE, SIZE)
    lanes, _, _ = lanes_of(frame)
    stage = stage_of(frame)
    arrive(lanes, lanes.shape[1], stage.shadows, stage.lights, 0)
    on_floor = lanes[1] < -7.5
    return lanes[LIT, on_floor], lanes[X, on_floor], lanes[Z, on_floor]


def shining(
    kind: str, at: tuple[float, float, float], to: tuple[float, float, float], **light: float
) -> Node:
    return Node(
        "lamp", matrix=transform.look_at(at, to, (0, 0, -1)), light=Light(kind, intensity=5.0, **light)
    )


@pytest.mark.parametrize("kind", ["directional", "spot", "point"])
def test_the_shadow_of_a_square_is_where_geometry_says(kind):
    at = np.array([1.5, 3.0, 0.0])
    lit, x, z = lit_floor(
        shining(kind, tuple(at), (0, 1, 0), **({"outer_cone": 1.0} if kind == "spot" else {})),
        *floor_and_lid()[::-1],
    )
    corners = np.array([(-0.5, 1, -0.5), (0.5, 1, 0.5)])
    if kind == "directional":
        shadow = corners - (at - (0, 1, 0)) / 2.0
    else:
        shadow = at + (corners - at) * 1.5
    inside = np.minimum(
        np.minimum(x - shadow[0, 0], shadow[1, 0] - x), np.minimum(z - shadow[0, 2], shadow[1, 2] - z)
    )
    assert (inside > ABOUT_A_TEXEL).sum() > 50
    assert (lit[inside > ABOUT_A_TEXEL] < 1e-6).all()
    assert (lit[inside < -ABOUT_A_TEXEL] == 1).all()


def test_a_floor_does_not_shade_itself_however_flat_the_light_falls():
    floor, _ = floor_and_lid()
    for height in (3.0, 0.5, 0.1):
        lit, _, _ = lit_floor(shining("directional", (3, height, 1), (0, 0, 0)), floor_and_lid(7.9)[1], floor)
        assert lit.mean() > 0.9


def test_a_ball_does_not_shade_its_lit_side():
    frame = frame_of(sphere(), Camera.look_at((0, 0, 5), (0, 0, 0), height=3.0), (64, 64))
    lanes, _, _ = lanes_of(frame)
    stage = stage_of(frame)
    arrive(lanes, lanes.shape[1], stage.shadows, stage.lights, 0)
    facing = (lanes[3:6].T @ stage.lights[0, 3:6]) > 0.2
    assert facing.sum() > 200
    assert (lanes[LIT, facing] == 1).all()


def test_a_blended_lid_casts_no_shadow_and_a_solid_one_does():
    lamp = shining("directional", (0, 3, 0.1), (0, 0, 0))
    glass = Material(base_color=(1, 1, 1, 0.5), alpha_mode="blend")
    for material, some in ((glass, False), (Material(), True)):
        floor, lid = floor_and_lid(1.0, material)
        # The lid hides the floor right under it, so look at its shadow from a lamp that stands aside
        lamp = shining("directional", (3, 2, 0), (0, 0, 0))
        lit, _, _ = lit_floor(lamp, lid, floor)
        assert (lit < 0.5).any() == some


def test_the_shadow_of_what_is_far_is_softer():
    widths = []
    for height in (0.4, 3.0):
        floor, lid = floor_and_lid(height)
        frame = frame_of(Scene.of(floor, lid), Camera.look_at((0, 4, 7), (0, 0, 0), fov=0.7), (96, 64))
        lanes, _, _ = lanes_of(frame)
        stage = stage_of(frame)
        arrive(lanes, lanes.shape[1], stage.shadows, stage.lights, 0)
        widths.append(((lanes[LIT] > 0.05) & (lanes[LIT] < 0.95)).sum())
    assert widths[1] > 1.5 * widths[0] > 0


def test_the_shadow_of_a_bar_as_thin_as_a_texel_is_not_broken():
    floor, _ = floor_and_lid()
    texel = 8 * math.sqrt(2) / 256
    bar = Mesh(np.array([(-1, 1, 0), (1, 1, 0), (1, 1, -texel), (-1, 1, -texel)]), [(0, 1, 2), (0, 2, 3)])
    lit, x, _ = lit_floor(shining("directional", (0.3, 3, 2), (0, 0, 0)), bar, floor)
    columns = np.floor(x * 20).astype(int)
    taken = [(1 - lit[columns == column]).sum() for column in range(-12, 13)]
    assert min(taken) > 0.5 * max(taken)


def test_the_studio_floor_takes_a_shadow_and_leaves_the_rest_of_the_backdrop():
    camera = Camera.look_at((0, 2, 6), (0, 0, 0), fov=math.radians(40))
    on = frame_of(sphere(), camera, SIZE)
    off = frame_of(sphere(), camera, SIZE, look=Look(ground="off"))
    shaded, plain = picture_of(on).astype(int), picture_of(off).astype(int)
    bare = on.visibles[0][0].face < 0
    darker = (plain - shaded)[bare].max(axis=1)
    assert darker.max() > 25
    assert (darker >= 0).all()
    assert (darker == 0).mean() > 0.5


def test_no_shadows_when_the_look_says_so():
    stage = stage_of(frame_of(sphere(), look=Look(shadows=False)))
    assert len(stage.shadows.rows) == 0
