"""A scene and a camera become a picture's geometry."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import soups
from eyeline.errors import EyelineError, OptionError
from eyeline.geometry.fixedpoint import GUARD
from eyeline.projection import CLOCKWISE, COUNTER_CLOCKWISE, project
from eyeline.scene.camera import Camera
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

CAMERA = Camera(fov=math.radians(90), near=1.0)
BOTH = CLOCKWISE | COUNTER_CLOCKWISE
SQUARE = [(-1, -1, -2), (1, -1, -2), (1, 1, -2), (-1, 1, -2)], [(0, 1, 2), (0, 2, 3)]
ONE_SIDED = Material(double_sided=False)


def test_points_lie_where_the_lens_puts_them() -> None:
    projected = project(Scene.of(Mesh(*SQUARE)), CAMERA, (200, 100))
    assert projected.xy.tolist() == [[19200, 19200], [32000, 19200], [32000, 6400], [19200, 6400]]
    assert np.allclose(projected.depth, 0.5)


def test_an_orthographic_picture_has_the_same_size_at_every_distance() -> None:
    camera = Camera(height=4.0, near=-1.0, far=9.0)
    near, far = (
        project(Scene.of(Mesh(np.add(SQUARE[0], (0, 0, z)), SQUARE[1])), camera, (64, 64)) for z in (0, -6)
    )
    assert np.array_equal(near.xy, far.xy)
    assert np.allclose([near.depth[0], far.depth[0]], [0.7, 0.1])


def test_the_faces_of_a_single_surface_are_not_copied() -> None:
    mesh = Mesh(*SQUARE)
    assert project(Scene.of(mesh), CAMERA, (64, 64)).faces is mesh.faces


def test_faces_of_many_surfaces_share_one_row_of_vertices() -> None:
    projected = project(Scene.of(Mesh(*SQUARE), Mesh(*SQUARE), Mesh(*SQUARE)), CAMERA, (64, 64))
    assert projected.faces.tolist() == [
        [a + 4 * k, b + 4 * k, c + 4 * k] for k in range(3) for a, b, c in SQUARE[1]
    ]
    assert projected.first_faces.tolist() == [0, 2, 4, 6]
    assert projected.face_count == 6


def test_an_empty_scene_is_an_empty_picture() -> None:
    for scene in (Scene(), Scene.of(Mesh(np.empty((0, 3)), np.empty((0, 3), int)))):
        projected = project(scene, Camera(fov=1.0), (8, 8))
        assert (len(projected.faces), projected.face_count, len(projected.xy)) == (0, 0, 0)


# --- sides ------------------------------------------------------------------------------------------------


def sides(*meshes: Mesh | Node, cull: str = "auto") -> list[int]:
    return project(Scene.of(*meshes), CAMERA, (8, 8), cull).sides.tolist()


def test_one_number_serves_where_all_faces_are_alike() -> None:
    assert sides(Mesh(*SQUARE), Mesh(*SQUARE)) == [BOTH]
    assert sides(Mesh(*SQUARE), cull="back") == [COUNTER_CLOCKWISE]
    assert sides(Mesh(*SQUARE, material=ONE_SIDED)) == [COUNTER_CLOCKWISE]
    assert sides(Mesh(*SQUARE, material=ONE_SIDED), cull="none") == [BOTH]


def test_materials_decide_face_by_face() -> None:
    mesh = Mesh(*SQUARE, materials=(ONE_SIDED, Material()), face_material=[1, 0])
    assert sides(mesh) == [BOTH, COUNTER_CLOCKWISE]
    assert sides(mesh, cull="back") == [COUNTER_CLOCKWISE]


def test_a_mirror_turns_the_front_clockwise() -> None:
    mirrored = Node("mirrored", mesh=Mesh(*SQUARE, material=ONE_SIDED), scale=(-1, 1, 1))
    assert sides(mirrored) == [CLOCKWISE]
    assert sides(mirrored, Mesh(*SQUARE)) == [CLOCKWISE, CLOCKWISE, BOTH, BOTH]


def test_a_hidden_surface_has_no_side_and_keeps_its_numbers() -> None:
    assert sides(Node("hidden", mesh=Mesh(*SQUARE), visible=False), Mesh(*SQUARE)) == [0, 0, BOTH, BOTH]


# --- clipping ---------------------------------------------------------------------------------------------


def test_a_face_through_the_near_plane_is_replaced_by_its_pieces() -> None:
    floor = Mesh([(-3, -1, -9), (3, -1, -9), (0, -1, 4)], [(0, 1, 2)])
    projected = project(Scene.of(floor), CAMERA, (64, 64))
    assert projected.sides.tolist() == [0, BOTH, BOTH]
    assert projected.source.tolist() == [0, 0, 0]
    assert projected.face_count == 1
    used = np.unique(projected.faces[1:])
    assert np.isclose(projected.depth[used].max(), 1)
    assert np.isfinite(projected.depth[used]).all()


def test_a_face_behind_the_eye_or_beside_the_picture_has_no_pieces() -> None:
    behind = Mesh([(-3, -1, 9), (3, -1, 9), (0, -1, 4)], [(0, 1, 2)])
    beside = Mesh([(1e6, 0, -2), (1e6, 1, -2), (1e7, 0, -2)], [(0, 1, 2)])
    projected = project(Scene.of(behind, beside), CAMERA, (64, 64))
    assert projected.sides.tolist() == [0, 0]
    assert len(projected.piece_source) == 0


def test_no_drawn_corner_leaves_the_guard_band() -> None:
    for seed in range(20):
        scene, camera = soups.around_the_eye(seed)
        projected = project(scene, replace(camera, near=1e-4), (640, 480))
        drawn = projected.faces[np.broadcast_to(projected.sides, len(projected.faces)) != 0]
        assert np.abs(projected.xy[drawn]).max() <= GUARD
        assert np.isfinite(projected.depth[drawn]).all()


def test_cutting_many_faces_is_cutting_each(monkeypatch: pytest.MonkeyPatch) -> None:
    scene, camera = soups.around_the_eye(3)
    whole = project(scene, camera, (64, 48))
    monkeypatch.setattr("eyeline.projection.cutting.BATCH", 5)
    parts = project(scene, camera, (64, 48))
    for name in ("xy", "depth", "sides", "piece_source"):
        assert np.array_equal(np.sort(getattr(whole, name), axis=0), np.sort(getattr(parts, name), axis=0))


# --- what is refused --------------------------------------------------------------------------------------


@pytest.mark.parametrize("size", [(0, 4), (4, -1), (16385, 4), (4, 16385), (4,), "large", None, (1, 2, 3)])
def test_impossible_sizes_are_refused(size: object) -> None:
    with pytest.raises(OptionError, match="needed"):
        project(Scene(), CAMERA, size)  # type: ignore[arg-type]


@pytest.mark.parametrize("size", [(1, 1), (16384, 1), (1, 16384), (16384, 16384)])
def test_all_other_sizes_are_taken(size: tuple[int, int]) -> None:
    projected = project(Scene.of(Mesh(*SQUARE)), CAMERA, size)
    assert (projected.width, projected.height) == size


def test_an_unknown_cull_is_refused() -> None:
    with pytest.raises(OptionError, match="'front'; there is 'auto', 'back', 'none'"):
        project(Scene(), CAMERA, (8, 8), "front")


@pytest.mark.parametrize("number", [np.nan, np.inf])
def test_a_placing_that_is_not_finite_is_refused(number: float) -> None:
    node = Node("broken", mesh=Mesh(*SQUARE), translation=(0, number, 0))
    with pytest.raises(EyelineError, match="finite"):
        project(Scene.of(node), CAMERA, (8, 8))


# --- the same picture elsewhere ---------------------------------------------------------------------------


def test_shifted_moves_samples_not_depths() -> None:
    projected = project(Scene.of(Mesh(*SQUARE)), CAMERA, (64, 64))
    moved = projected.shifted(-32, 96)
    assert (moved.xy - projected.xy).tolist() == [[32, -96]] * 4
    assert moved.depth is projected.depth


def test_only_keeps_numbers() -> None:
    projected = project(Scene.of(Mesh(*SQUARE)), CAMERA, (64, 64))
    assert projected.only(np.array([False, True])).sides.tolist() == [0, BOTH]
