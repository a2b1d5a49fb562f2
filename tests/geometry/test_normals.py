"""Vertex normals, creases and tangents, on shapes whose answer is known."""

from __future__ import annotations

import math

import numpy as np
import pytest

from eyeline.geometry import normals
from eyeline.geometry.weld import welded

CUBE = np.array([[(i >> k) & 1 for k in range(3)] for i in range(8)], dtype=np.float32)
# Two triangles a side, counter-clockwise from outside
CUBE_FACES = np.array(
    [[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
     [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]], dtype=np.int32
)  # fmt: skip


def ring(sides: int, height: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    """A tube around y without ends."""
    turn = np.arange(sides) * (2 * math.pi / sides)
    circle = np.stack([np.cos(turn), 0 * turn, -np.sin(turn)], axis=1)
    points = np.concatenate([circle, circle + np.array([0, height, 0])]).astype(np.float32)
    a, b = np.arange(sides), (np.arange(sides) + 1) % sides
    faces = np.concatenate([np.stack([a, b, b + sides], 1), np.stack([a, b + sides, a + sides], 1)])
    return points, faces.astype(np.int32)


def test_cube_corner_points_along_its_diagonal_however_its_sides_are_cut():
    found = normals.vertex_normals(CUBE, CUBE_FACES)
    np.testing.assert_allclose(found, (2 * CUBE - 1) / math.sqrt(3), atol=1e-6)


def test_face_normal_is_towards_the_counter_clockwise_side():
    found = normals.face_normals(CUBE, CUBE_FACES)
    centres = CUBE[CUBE_FACES].mean(axis=1) - 0.5
    assert ((found * centres).sum(axis=1) > 0.1).all()


def test_crease_splits_a_cube_into_sides():
    split = normals.creased(CUBE, CUBE_FACES, math.radians(40))
    assert len(split.source) == 24
    np.testing.assert_array_equal(split.source[split.faces], CUBE_FACES)
    np.testing.assert_allclose(
        split.normals[split.faces],
        np.repeat(normals.face_normals(CUBE, CUBE_FACES)[:, None], 3, axis=1),
        atol=1e-6,
    )


def test_crease_wider_than_the_edges_splits_nothing():
    split = normals.creased(CUBE, CUBE_FACES, math.radians(91))
    np.testing.assert_array_equal(split.faces, CUBE_FACES)
    np.testing.assert_array_equal(split.source, np.arange(8))


@pytest.mark.parametrize(("sides", "vertices"), [(8, 32), (12, 24)])
def test_tube_is_smooth_where_it_turns_less_than_the_crease(sides, vertices):
    points, faces = ring(sides)
    split = normals.creased(points, faces, math.radians(40))
    assert len(split.source) == vertices


def test_smooth_tube_has_radial_normals():
    points, faces = ring(48)
    split = normals.creased(points, faces, math.radians(40))
    np.testing.assert_allclose(split.normals, points[split.source] * (1, 0, 1), atol=1e-6)


def test_reversed_neighbour_does_not_cancel_a_normal():
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=np.float32)
    faces = np.array([[0, 1, 2], [0, 3, 2]], dtype=np.int32)
    split = normals.creased(points, faces, math.radians(40))
    np.testing.assert_allclose(split.normals[split.faces][0], [[0, 0, 1]] * 3)
    np.testing.assert_allclose(split.normals[split.faces][1], [[0, 0, -1]] * 3)


def test_faces_that_touch_only_in_a_point_are_not_smoothed_together():
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0.1], [0, -1, 0]], dtype=np.float32)
    faces = np.array([[0, 1, 2], [0, 3, 4]], dtype=np.int32)
    assert len(normals.creased(points, faces, math.radians(40)).source) == 6


def test_degenerate_faces_leave_their_neighbours_alone():
    spoiled = np.concatenate([CUBE_FACES, [[0, 0, 1], [2, 2, 2], [5, 7, 5]]]).astype(np.int32)
    np.testing.assert_allclose(
        normals.vertex_normals(CUBE, spoiled), normals.vertex_normals(CUBE, CUBE_FACES), atol=1e-6
    )
    split = normals.creased(CUBE, spoiled, math.radians(40))
    clean = normals.creased(CUBE, CUBE_FACES, math.radians(40))
    np.testing.assert_allclose(split.normals[split.faces[:12]], clean.normals[clean.faces], atol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(split.normals, axis=1), 1, atol=1e-6)


@pytest.mark.parametrize("size", [1e-30, 1e30])
def test_normals_do_not_depend_on_size(size):
    tiny = (CUBE * np.float32(size)).astype(np.float32)
    np.testing.assert_allclose(
        normals.vertex_normals(tiny, CUBE_FACES), normals.vertex_normals(CUBE, CUBE_FACES), atol=1e-6
    )


def test_nothing_has_no_normals():
    points, faces = np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32)
    assert normals.vertex_normals(points, faces).shape == (0, 3)
    assert normals.creased(points, faces, 0.7).faces.shape == (0, 3)
    assert normals.tangents(points, faces, points, np.zeros((0, 2), np.float32)).shape == (0, 4)


def test_permuting_faces_permutes_the_answer():
    points, faces = ring(12)
    order = np.random.default_rng(3).permutation(len(faces))
    plain, mixed = (normals.creased(points, one, math.radians(20)) for one in (faces, faces[order]))
    np.testing.assert_allclose(mixed.normals[mixed.faces], plain.normals[plain.faces[order]], atol=1e-6)


QUAD = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=np.float32)
QUAD_FACES = np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32)
UP = np.tile(np.float32([0, 0, 1]), (4, 1))


def test_tangent_runs_along_u_and_bitangent_up_the_image():
    uv = (QUAD[:, :2] * (1, -1) + (0, 1)).astype(np.float32)  # v = 0 is the image's top
    np.testing.assert_allclose(normals.tangents(QUAD, QUAD_FACES, UP, uv), [[1, 0, 0, 1]] * 4, atol=1e-7)


def test_mirrored_texture_turns_the_bitangent():
    uv = (QUAD[:, :2] * (-1, -1) + (1, 1)).astype(np.float32)
    np.testing.assert_allclose(normals.tangents(QUAD, QUAD_FACES, UP, uv), [[-1, 0, 0, -1]] * 4, atol=1e-7)


def test_tangent_is_perpendicular_to_a_leaning_normal():
    uv = (QUAD[:, :2] * (1, -1)).astype(np.float32)
    leaning = np.tile(np.float32([0.6, 0, 0.8]), (4, 1))
    found = normals.tangents(QUAD, QUAD_FACES, leaning, uv)
    np.testing.assert_allclose(found, [[0.8, 0, -0.6, 1]] * 4, atol=1e-6)


def test_texture_without_area_gives_some_perpendicular_tangent():
    found = normals.tangents(QUAD, QUAD_FACES, UP, np.zeros((4, 2), np.float32))
    np.testing.assert_allclose((found[:, :3] * UP).sum(axis=1), 0, atol=1e-7)
    np.testing.assert_allclose(np.linalg.norm(found[:, :3], axis=1), 1, atol=1e-6)


def test_weld_joins_equal_points_only_and_keeps_their_order():
    rows = np.array([[3, 0, 0], [1, 0, 0], [3, -0.0, 0], [1, 0, 1e-30], [1, 0, 0]], dtype=np.float32)
    first, index = welded(rows)
    np.testing.assert_array_equal(first, [0, 1, 3])
    np.testing.assert_array_equal(index, [0, 1, 0, 2, 1])
