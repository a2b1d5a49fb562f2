"""The octree: equal to the depth buffer wherever it leaves nodes out, and never doing more than it must."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import oracle
import soups
from eyeline.projection import project
from eyeline.projection.projected import Projected
from eyeline.scene.camera import Camera
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS, Visible
from eyeline.visibility.octree.forest import of_surfaces, tree_of
from eyeline.visibility.octree.octree import Octree

OCTREE, ZBUFFER = METHODS["octree"], METHODS["zbuffer"]
SIZE = (300, 280)  # more than one tile each way
ONE_SIDED = Material(double_sided=False)

by_chance = settings(
    max_examples=40, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
seeds = st.integers(0, 10**6)
culls = st.sampled_from(("auto", "back", "none"))


def assert_same(ours: Visible, theirs: Visible) -> None:
    assert np.argwhere(ours.face != theirs.face).tolist() == []
    assert np.argwhere(ours.depth.view(np.int32) != theirs.depth.view(np.int32)).tolist() == []


def bumpy(seed: int, rings: int) -> tuple[np.ndarray, np.ndarray]:
    """A ball whose vertices are shaken."""
    points, faces = soups.ball(rings)
    return points * np.random.default_rng(seed).uniform(0.7, 1.3, (len(points), 1)), faces


def crowd(seed: int, count: int = 40) -> tuple[Scene, Camera]:
    """Instances of three meshes around the eye, some mirrored, hidden, flat, or through the near plane."""
    random = np.random.default_rng(seed)
    points, faces = bumpy(seed, 8)
    mixed = Mesh(points, faces, materials=(ONE_SIDED, Material()), face_material=np.arange(len(faces)) % 2)
    nodes = []
    for mesh in (mixed, Mesh(points, faces, material=ONE_SIDED), Mesh(*soups.ball(3))):
        places = np.tile(np.eye(4), (count // 3, 1, 1))
        places[:, :3, :3] = random.normal(size=(count // 3, 3, 3)) * 10 ** random.uniform(
            -1.5, 1, (count // 3, 1, 1)
        )
        places[::5, 2] = 0
        places[:, :3, 3] = random.uniform(-6, 6, (count // 3, 3))
        nodes += [Node("some", mesh=mesh, instances=places), Node("hidden", mesh=mesh, visible=False)]
    lens = {"height": 8.0, "near": -2.0, "far": 30.0} if seed % 4 == 3 else {"fov": 1.2, "near": 0.3}
    return Scene.of(*nodes), Camera.look_at((0.3, 0.2, 4), (0, 0, -1), **lens)


# --- instances --------------------------------------------------------------------------------------------


@by_chance
@given(seed=seeds, cull=culls)
def test_instances_are_seen_as_the_depth_buffer_sees_them(seed: int, cull: str) -> None:
    scene, camera = crowd(seed)
    assert_same(OCTREE(project(scene, camera, SIZE, cull)), ZBUFFER(project(scene, camera, SIZE, cull)))


@by_chance
@given(seed=seeds, cull=culls)
def test_a_fine_mesh_around_the_eye_is_seen_as_the_depth_buffer_sees_it(seed: int, cull: str) -> None:
    random = np.random.default_rng(seed)
    points, faces = bumpy(seed, int(random.integers(8, 40)))
    scene = Scene.of(Mesh(points * random.uniform(0.2, 20, 3), faces, material=ONE_SIDED))
    eye = random.normal(size=3) * 10 ** random.uniform(-1, 1)
    camera = Camera.look_at(
        eye, eye + random.normal(size=3), fov=1.5, near=float(10 ** random.uniform(-3, 0))
    )
    projected = project(scene, camera, SIZE, cull)
    assert_same(OCTREE(projected), ZBUFFER(projected))


@by_chance
@given(seed=seeds, dx=st.integers(-128, 127), dy=st.integers(-128, 127))
def test_samples_beside_the_centres_are_seen_as_the_depth_buffer_sees_them(
    seed: int, dx: int, dy: int
) -> None:
    scene, camera = crowd(seed, 20)
    projected = project(scene, camera, SIZE).shifted(dx, dy)
    assert_same(OCTREE(projected), ZBUFFER(projected))


@pytest.mark.parametrize("seed", range(4))
def test_steps_walk_instances_as_the_kernel_does(seed: int) -> None:
    scene, camera = crowd(seed, 6)
    projected = project(scene, camera, (40, 30))
    answer = OCTREE(projected)
    *_, last = OCTREE.steps(projected)
    assert np.array_equal(last.data["face"], answer.face)
    assert np.array_equal(last.data["depth"], answer.depth)
    assert dict(last.work) == dict(answer.work)


def test_a_mesh_has_one_tree_however_often_it_stands() -> None:
    mesh = Mesh(*soups.ball(12))
    nodes = [Node("one", mesh=mesh), Node("two", mesh=mesh, translation=(3, 0, 0))]
    projected = project(Scene.of(*nodes), Camera.look_at((0, 0, 9), (0, 0, 0)), SIZE)
    forest = of_surfaces(projected, "auto")
    assert tree_of(mesh) is tree_of(mesh)
    assert len(forest.numbers) == len(mesh.faces)
    assert forest.roots.tolist() == [0, 0]


def test_no_vertex_is_placed_that_nobody_asks_for() -> None:
    projected = project(*crowd(1), SIZE)
    OCTREE(projected)
    assert "xy" not in vars(projected)
    assert len(projected.xy) >= sum(len(surface.mesh.points) for surface in projected.surfaces)
    assert "xy" in vars(projected)


# --- what is left out -------------------------------------------------------------------------------------


def wall_and(count: int) -> tuple[Scene, Camera]:
    """A wall that fills the picture, and so many balls behind it."""
    wall = Mesh([(-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0)], [(0, 1, 2), (0, 2, 3)])
    places = np.tile(np.eye(4), (count, 1, 1))
    places[:, 2, 3] = -3 - np.arange(count)
    balls = Node("balls", mesh=Mesh(*soups.ball(20)), instances=places)
    return Scene.of(balls, wall), Camera.look_at((0, 0, 4), (0, 0, 0), fov=1.0, near=0.1)


def test_work_does_not_grow_with_what_is_hidden() -> None:
    few, many = (OCTREE(project(*wall_and(count), SIZE)).work for count in (1, 200))
    assert many["faces"] > 100 * few["faces"]
    assert many["faces drawn"] == few["faces drawn"]
    assert many["depth tests"] == few["depth tests"] == SIZE[0] * SIZE[1]


def test_of_equal_depths_the_lower_number_is_seen_whichever_comes_first() -> None:
    sheet = Mesh([(-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0)], [(0, 1, 2), (0, 2, 3)])
    camera = Camera.look_at((0, 0, 4), (0, 0, 0), height=4.0)
    projected = project(Scene.of(*[sheet] * 50), camera, (32, 32))
    answer = OCTREE(projected)
    assert set(np.unique(answer.face)) == {0, 1}
    assert answer.work["nodes hidden"] == 49


def test_a_million_coincident_faces_are_one() -> None:
    mesh = Mesh([(-9, -9, 0), (9, -9, 0), (0, 9, 0)], np.tile([(0, 1, 2)], (1_000_000, 1)))
    answer = OCTREE(
        project(Scene.of(mesh), Camera.look_at((0, 0, 4), (0, 0, 0), fov=1.0, near=0.1), (64, 64))
    )
    assert set(np.unique(answer.face)) <= {-1, 0}
    assert answer.work["faces drawn"] <= 64


def test_a_large_picture_equals_the_oracle() -> None:
    random = np.random.default_rng(3)
    xy = random.uniform(-2000, 18000, (40, 3, 2)) * (256, 1)
    xy[..., 1] = random.uniform(-30, 40, (40, 3)) * 256
    projected = soups.picture(
        np.round(xy).reshape(-1, 2), random.uniform(0, 1, 120), np.arange(120).reshape(-1, 3), np.array([3]),
        (16384, 9), 0,
    )  # fmt: skip
    face, depth = oracle.seen(projected)
    answer = OCTREE(projected)
    assert np.array_equal(answer.face, face)
    assert np.array_equal(answer.depth, depth)


# --- the hint ---------------------------------------------------------------------------------------------


@by_chance
@given(seed=seeds, other=seeds)
def test_a_hint_never_changes_the_answer(seed: int, other: int) -> None:
    projected = project(*crowd(seed), SIZE)
    answer = OCTREE(projected)
    for hint in (answer, OCTREE(project(*crowd(other), (70, 50))), junk(projected)):
        assert_same(Octree(hint=hint)(projected), answer)


def junk(projected: Projected) -> Visible:
    """An answer that is none: numbers of faces that are not there."""
    face = np.random.default_rng(0).integers(-1, 2**31 - 1, (20, 30)).astype(np.int32)
    return Visible(face, np.zeros((20, 30), np.float32), projected, OCTREE, {})


def test_what_is_recalled_hides_what_came_before_it() -> None:
    """Balls whose boxes begin before the wall, and which lie behind it."""
    wall = Mesh([(-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0)], [(0, 1, 2), (0, 2, 3)])
    points = np.array([(x, y, -1e-3) for x, y in np.random.default_rng(1).uniform(-2, 2, (3000, 2))])
    points[::30, 2] = 1e-3
    cloud = Mesh(points, np.arange(3000).reshape(-1, 3))
    camera = Camera.look_at((0, 0, 4), (0, 0, 0), fov=1.0, near=0.1)
    projected = project(Scene.of(cloud, wall), camera, SIZE)
    first = OCTREE(projected)
    again = Octree(hint=first)(projected)
    assert_same(again, first)
    assert again.work["depth tests"] <= first.work["depth tests"]


@pytest.mark.parametrize("seed", range(3))
def test_steps_recall_as_the_kernel_does(seed: int) -> None:
    projected = project(*crowd(seed, 6), (40, 30))
    method = Octree(hint=OCTREE(projected))
    answer = method(projected)
    *_, last = method.steps(projected)
    assert np.array_equal(last.data["face"], answer.face)
    assert dict(last.work) == dict(answer.work)
