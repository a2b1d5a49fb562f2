"""What the corners of a face carry arrives at every point of it."""

from __future__ import annotations

import math

import numpy as np
import pytest

from eyeline.scene.camera import Camera
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene
from eyeline.scene.texture import Texture, TextureSlot
from eyeline.shading.lanes import ALPHA, BLUE, COVER, GREEN, NX, NY, NZ, OCCLUSION, RED, X, Y, Z
from frames import FRONT, frame_of, lanes_of, square

NARROW = Camera(fov=math.radians(60), near=0.01)
CHANNELS = [(0, 0, 0, 1), (1, 0, 0, 1), (1, 1, 0, 1), (0, 1, 0, 1)]
WHITE = Material(base_color=(1.0, 1.0, 1.0, 1.0))


def tilted(colors: object = CHANNELS) -> Mesh:
    """A floor that runs from the eye to the distance; its left near corner lies behind the eye."""
    points = [(-1, -0.5, 0.4), (1, -0.5, -0.5), (1.5, -0.5, -6), (-1.5, -0.5, -6)]
    return Mesh(points, [(0, 1, 2), (0, 2, 3)], colors=colors, material=WHITE)


def rays(x: np.ndarray, y: np.ndarray, width: int, height: int) -> np.ndarray:
    """(K, 3) through places in the picture of NARROW, z = -1."""
    half = math.tan(math.radians(30))
    return np.stack(
        [(2 * x / width - 1) * half * width / height, (1 - 2 * y / height) * half, -np.ones_like(x)], 1
    )


def test_places_lie_where_rays_meet_the_plane():
    frame = frame_of(Scene.of(tilted()), NARROW, (64, 48))
    lanes, x, y = lanes_of(frame)
    ray = rays(x.astype(float), y.astype(float), 64, 48)
    expected = ray * (-0.5 / ray[:, 1])[:, None]
    found = lanes[[X, Y, Z]].T
    assert len(found) > 500
    np.testing.assert_allclose(found, expected, rtol=2e-6, atol=1e-6)


def test_colours_are_right_in_perspective_even_with_a_corner_behind_the_eye():
    mesh = tilted()
    frame = frame_of(Scene.of(mesh), NARROW, (64, 48))
    lanes, x, y = lanes_of(frame)
    ray = rays(x.astype(float), y.astype(float), 64, 48)
    place = ray * (-0.5 / ray[:, 1])[:, None]
    expected = np.full((len(x), 2), np.nan)
    for face in mesh.faces:
        corners = mesh.points[face].astype(float)
        shares = np.linalg.solve(
            np.vstack([corners[:, [0, 2]].T, np.ones(3)]), np.vstack([place[:, [0, 2]].T, np.ones(len(x))])
        )
        inside = (shares >= -1e-9).all(axis=0)
        expected[inside] = (shares.T @ mesh.colors[face][:, :2])[inside]
    np.testing.assert_allclose(lanes[[RED, GREEN]].T, expected, atol=3e-6)


def test_normals_face_the_eye_from_either_side():
    normals = np.tile([0.6, 0.0, 0.8], (4, 1))
    front = frame_of(Scene.of(square(normals=normals)))
    back = frame_of(
        Scene.of(Node(rotation=(0, 1, 0, 0), translation=(0, 0, -4), mesh=square(normals=normals)))
    )
    for frame, expected in ((front, (0.6, 0, 0.8)), (back, (0.6, 0, 0.8))):
        lanes, _, _ = lanes_of(frame)
        np.testing.assert_allclose(lanes[[NX, NY, NZ]].T, np.tile(expected, (lanes.shape[1], 1)), atol=1e-6)


@pytest.mark.parametrize("scale", [(-1.0, 1.0, 1.0), (2.0, 2.0, 0.01), (1e-3, 1e-3, 1e-3)])
def test_normals_survive_mirrors_and_uneven_scales(scale):
    slanted = Mesh([(-1, -1, 0), (1, -1, 0), (0, 1, -1)], [(0, 1, 2)])
    node = Node(mesh=slanted, scale=scale, translation=(0, 0, -3))
    lanes, _, _ = lanes_of(frame_of(Scene.of(node), Camera(height=2.0 * abs(scale[1]), near=0.5, far=100.0)))
    points = slanted.points * np.array(scale)
    normal = np.cross(points[1] - points[0], points[2] - points[0])
    normal *= np.sign(normal[2]) / np.linalg.norm(normal)
    np.testing.assert_allclose(lanes[[NX, NY, NZ]].T, np.tile(normal, (lanes.shape[1], 1)), atol=1e-5)


def test_each_face_has_its_own_material_and_each_instance_its_place():
    red, blue = Material(base_color=(1.0, 0.0, 0.0, 1.0)), Material(base_color=(0.0, 0.0, 1.0, 1.0))
    mesh = square(0.5, materials=(red, blue), face_material=[0, 1])
    placings = np.stack([np.eye(4), np.eye(4)])
    placings[0, 0, 3], placings[1, 0, 3] = -0.5, 0.5
    frame = frame_of(Scene.of(Node(mesh=mesh, instances=placings)))
    lanes, x, _ = lanes_of(frame)
    left, right = x < 24, x > 24
    assert left.any()
    assert right.any()
    for half in (left, right):
        assert {tuple(row) for row in lanes[[RED, BLUE]][:, half].T} == {(1.0, 0.0), (0.0, 1.0)}


def test_alpha_follows_the_mode_and_cover_the_numbers():
    for mode, alpha in (("opaque", 1.0), ("blend", 0.25)):
        material = Material(base_color=(1.0, 1.0, 1.0, 0.25), alpha_mode=mode)
        lanes, _, _ = lanes_of(frame_of(Scene.of(square(material=material))))
        assert (lanes[ALPHA] == np.float32(alpha)).all()
        assert (lanes[COVER] == np.float32(0.25)).all()


def normal_mapped(texel: tuple[int, int, int], **attributes: object) -> Mesh:
    pixels = np.full((4, 4, 4), 255, np.uint8)
    pixels[..., :3] = texel
    slot = TextureSlot(Texture(pixels))
    return square(material=Material(normal_texture=slot), **attributes)


@pytest.mark.parametrize("tangents", [None, np.tile([1.0, 0.0, 0.0, 1.0], (4, 1))])
def test_a_normal_map_leans_right_along_u_and_up_against_v(tangents):
    for texel, axis in (((255, 128, 128), NX), ((128, 255, 128), NY)):
        lanes, _, _ = lanes_of(frame_of(Scene.of(normal_mapped(texel, tangents=tangents))))
        assert lanes[axis].min() > 0.99
        assert abs(lanes[NZ]).max() < 0.01


def test_a_flat_normal_map_changes_nothing_much():
    lanes, _, _ = lanes_of(frame_of(Scene.of(normal_mapped((128, 128, 255)))))
    assert lanes[NZ].min() > 0.9999


def test_a_texture_lies_where_its_coordinates_say():
    ramp = np.zeros((1, 256, 4), np.uint8)
    ramp[0, :, 0] = np.arange(256)
    ramp[..., 3] = 255
    # A slot that holds plain numbers: green roughness stays 0, alpha is not looked at; red is occlusion
    slot = TextureSlot(Texture(ramp, wrap=("clamp", "clamp"), mipmaps=False))
    mesh = square(2.0, material=Material(occlusion_texture=slot))
    frame = frame_of(Scene.of(mesh), FRONT, (48, 32))
    lanes, x, _ = lanes_of(frame)
    u = (x / 48 * 3 - 1.5) / 2 + 0.5  # the picture is three metres wide, the square two
    np.testing.assert_allclose(lanes[OCCLUSION], np.clip((u * 256 - 0.5) / 255, 0, 1), atol=1e-5)
