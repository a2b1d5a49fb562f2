"""Ray casting: instances and mirrors, eyes within meshes, and no work for what is hidden."""

from __future__ import annotations

import gc
import math
import weakref
from dataclasses import replace

import numpy as np
import pytest

import oracle
import soups
from eyeline.projection import project
from eyeline.scene.camera import Camera
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS
from eyeline.visibility.raycast.casts import tree_of

RAYCAST, ZBUFFER = METHODS["raycast"], METHODS["zbuffer"]


def balls(*matrices: np.ndarray, material: Material | None = None) -> Scene:
    """One mesh that stands in many places."""
    mesh = Mesh(*soups.ball(20), material=material or Material())
    return Scene(tuple(Node(str(k), mesh=mesh, matrix=matrix) for k, matrix in enumerate(matrices)))


def placed(x: float, y: float, z: float, *scale: float) -> np.ndarray:
    matrix = np.diag([*(scale or (1, 1, 1)), 1.0])
    matrix[:3, 3] = x, y, z
    return matrix


def assert_decidable_pixels_are_true(scene: Scene, camera: Camera, size: tuple[int, int], cull: str) -> None:
    answer, truth = RAYCAST(project(scene, camera, size, cull)), oracle.truth(scene, camera, size, cull)
    assert truth.decidable.mean() > 0.6
    assert np.argwhere(truth.decidable & (answer.face != truth.face)).tolist() == []


@pytest.mark.parametrize("cull", ["auto", "back", "none"])
def test_mirrored_and_stretched_copies_of_a_mesh_show_their_fronts(cull: str) -> None:
    camera = Camera.look_at((2, 1, 7), (0, 0, 0), fov=0.7)
    copies = (placed(-1.2, 0, 0), placed(1.1, 0, 0.5, -1, 1, 0.4), placed(0, 0, 2, 0.3, -0.3, -0.3))
    scene = balls(*copies, material=Material(double_sided=False))
    assert_decidable_pixels_are_true(scene, camera, (120, 70), cull)
    assert set(np.unique(RAYCAST(project(scene, camera, (120, 70), cull)).node)) == {-1, 0, 1, 2}


@pytest.mark.parametrize("lens", [{"fov": 2.0, "near": 0.05}, {"height": 1.5, "near": -0.6, "far": 0.8}])
def test_an_eye_within_a_mesh_sees_its_inside(lens: dict[str, float]) -> None:
    camera = Camera.look_at((0.1, 0.2, -0.1), (1, 0.3, 0.2), **lens)
    assert_decidable_pixels_are_true(balls(np.eye(4)), camera, (90, 70), "none")


def test_samples_beside_the_centres_see_what_a_finer_picture_sees() -> None:
    camera, scene = Camera.look_at((1, 1, 4), (0, 0, 0)), balls(np.eye(4))
    coarse, fine = project(scene, camera, (60, 40)), RAYCAST(project(scene, camera, (240, 160)))
    for row, column in ((0, 1), (2, 3)):
        # Sample (column, row) of 4x4: its centre, 1/256 pixel beside that of the coarse pixel
        shift = 64 * column + 32 - 128, 64 * row + 32 - 128
        answer = RAYCAST(coarse.shifted(*shift))
        same = answer.face == fine.face[row::4, column::4]
        assert same.mean() > 0.999


def test_faces_that_are_not_wanted_are_not_met() -> None:
    scene, camera = soups.around_the_eye(5)
    projected = project(scene, camera, (64, 48))
    wanted = np.arange(projected.face_count) % 3 > 0
    answer = RAYCAST(projected.only(wanted))
    assert wanted[answer.face[answer.face >= 0]].all()
    assert (answer.face != RAYCAST(projected).face).any()


def test_depth_and_distance_are_those_of_the_depth_buffer() -> None:
    for seed in range(7):
        projected = project(*soups.around_the_eye(seed), (64, 48))
        ours, theirs = RAYCAST(projected), ZBUFFER(projected)
        truth = oracle.truth(*soups.around_the_eye(seed), (64, 48))
        both = truth.decidable & (truth.face >= 0)
        # Snapped corners tilt a face a little; steep faces the most
        assert np.median(np.abs(ours.depth[both] - theirs.depth[both])) < 1e-4
        assert np.median(np.abs(ours.distance[both] - theirs.distance[both])) < 1e-3
        assert np.array_equal(ours.depth > 0, ours.face >= 0)


@pytest.mark.parametrize(
    "scene",
    [
        Scene(),
        Scene.of(Mesh(np.zeros((0, 3)), np.zeros((0, 3), int))),
        Scene.of(Mesh([(0, 0, 9), (1, 0, 9), (0, 1, 9)], [(0, 1, 2)])),
        Scene.of(Mesh([(0, 0, 0), (0, 0, 0), (1, 1, 1)], [(0, 1, 2), (0, 2, 2)])),
        Scene((Node("hidden", mesh=Mesh(*soups.ball()), visible=False),)),
    ],
    ids=["empty", "no faces", "behind the eye", "flat faces", "hidden"],
)
def test_where_nothing_can_be_seen_nothing_is(scene: Scene) -> None:
    answer = RAYCAST(project(scene, Camera.look_at((0, 0, 5), (0, 0, 0), near=0.1), (40, 30)))
    assert (answer.face == -1).all()
    assert (answer.depth == 0).all()
    assert answer.work["rays"] == 1200


def test_a_tree_is_made_once_and_lives_as_long_as_its_mesh() -> None:
    mesh = Mesh(*soups.ball())
    assert tree_of(mesh) is tree_of(mesh)
    alive = weakref.ref(tree_of(mesh).nodes)
    del mesh
    gc.collect()
    assert alive() is None


def test_hidden_faces_cost_no_tests() -> None:
    """Behind a wall that fills the picture nothing is opened, however much stands there."""
    wall = Mesh([(-99, -99, 3), (99, -99, 3), (0, 99, 3)], [(0, 1, 2)])
    camera = Camera.look_at((0, 0, 5), (0, 0, 0), fov=math.radians(60), near=0.1)
    alone = RAYCAST(project(Scene.of(wall), camera, (64, 64)))
    crowd = balls(*(placed(0, 0, -float(k)) for k in range(50)))
    both = RAYCAST(project(replace(crowd, nodes=(Node("wall", mesh=wall), *crowd.nodes)), camera, (64, 64)))
    assert (both.face == 0).all()
    assert both.work == alone.work
