"""Every method that answers alone: right where the answer is known, equal to the oracle elsewhere."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

import oracle
import scenes
import soups
from eyeline.projection import project
from eyeline.projection.projected import Projected
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS, Visible

SIZE = (scenes.WIDTH, scenes.HEIGHT)
SIZES = ((48, 32), (33, 17), (1, 1), (130, 5), (7, 50))
ANSWERING = [name for name, method in METHODS.items() if method.answers]

every_method = pytest.mark.parametrize("name", ANSWERING)
every_exact_method = pytest.mark.parametrize("name", [name for name in ANSWERING if METHODS[name].exact])
by_chance = settings(
    max_examples=60, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
seeds = st.integers(0, 10**6)


def assert_is_the_oracles(answer: Visible, projected: Projected) -> None:
    face, depth = oracle.seen(projected)
    assert np.argwhere(answer.face != face).tolist() == []
    assert np.argwhere(answer.depth.view(np.int32) != depth.view(np.int32)).tolist() == []


@pytest.mark.parametrize("known", scenes.KNOWN, ids=lambda known: known.name)
@every_method
def test_the_known_node_is_seen(name: str, known: scenes.Known) -> None:
    answer = METHODS[name](project(known.scene, known.camera, SIZE))
    wrong = known.certain & (answer.node != known.node)
    assert known.certain.mean() > 0.9
    assert not wrong.any(), f"{wrong.sum()} pixels, first at row, column {np.argwhere(wrong)[0]}"


# --- the oracle -------------------------------------------------------------------------------------------


@every_exact_method
@by_chance
@given(kind=st.sampled_from(soups.SNAPPED), seed=seeds, size=st.sampled_from(SIZES))
def test_snapped_faces_are_seen_as_the_oracle_sees_them(
    name: str, kind: str, seed: int, size: tuple[int, int]
) -> None:
    projected = soups.snapped(kind, seed, size)
    assert_is_the_oracles(METHODS[name](projected), projected)


@every_exact_method
@by_chance
@given(seed=seeds, cull=st.sampled_from(("auto", "back", "none")))
def test_pieces_of_faces_around_the_eye_are_seen_as_the_oracle_sees_them(
    name: str, seed: int, cull: str
) -> None:
    projected = project(*soups.around_the_eye(seed), SIZE, cull)
    assert_is_the_oracles(METHODS[name](projected), projected)


@every_method
@by_chance
@given(seed=seeds, cull=st.sampled_from(("auto", "back", "none")))
def test_faces_around_the_eye_are_cut_where_they_must_be(name: str, seed: int, cull: str) -> None:
    scene, camera = soups.around_the_eye(seed)
    answer = METHODS[name](project(scene, camera, SIZE, cull))
    truth = oracle.truth(scene, camera, SIZE, cull)
    assert truth.decidable.mean() > 0.5
    assert np.argwhere(truth.decidable & (answer.face != truth.face)).tolist() == []


# --- nothing changes when ---------------------------------------------------------------------------------


def mixed_scene(seed: int) -> tuple[Scene, Camera]:
    scene, camera = soups.around_the_eye(seed)
    return Scene.of(Mesh(*joined(scene))), camera


def joined(scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    """Points and faces of all meshes in one."""
    points = np.concatenate([surface.mesh.points for surface in scene.surfaces])
    return points, np.arange(len(points)).reshape(-1, 3)


@every_method
@by_chance
@given(seed=seeds)
def test_the_order_of_faces_does_not_matter(name: str, seed: int) -> None:
    scene, camera = mixed_scene(seed)
    mesh = scene.surfaces[0].mesh
    order = np.random.default_rng(seed).permutation(len(mesh.faces))
    first = METHODS[name](project(scene, camera, SIZE))
    second = METHODS[name](project(Scene.of(Mesh(mesh.points, mesh.faces[order])), camera, SIZE))
    decidable = oracle.truth(scene, camera, SIZE).decidable | METHODS[name].exact
    assert np.array_equal(first.depth[decidable], second.depth[decidable])
    renumbered = np.where(second.face < 0, -1, order[second.face])
    assert np.array_equal(first.face[decidable], renumbered[decidable])


@every_exact_method
@by_chance
@given(seed=seeds)
def test_where_a_face_begins_does_not_matter(name: str, seed: int) -> None:
    projected = soups.snapped("mixed", seed, SIZE)
    turn = np.random.default_rng(seed).integers(0, 3, (len(projected.faces), 1))
    turned = np.take_along_axis(projected.faces, (np.arange(3) + turn) % 3, axis=1)
    first, second = METHODS[name](projected), METHODS[name](replace(projected, faces=turned))
    assert np.array_equal(first.face, second.face)
    assert np.array_equal(first.depth, second.depth)


@every_method
@by_chance
@given(seed=seeds)
def test_a_face_cut_in_four_is_seen_as_one(name: str, seed: int) -> None:
    scene, camera = mixed_scene(seed)
    mesh = scene.surfaces[0].mesh
    a, b, c = (mesh.points[mesh.faces[:, k]].astype(float) for k in range(3))
    ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
    four = np.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], axis=1)
    cut = Mesh(four.reshape(-1, 3), np.arange(len(four) * 12).reshape(-1, 3))
    answer = METHODS[name](project(Scene.of(cut), camera, SIZE))
    truth = oracle.truth(scene, camera, SIZE)
    whole = np.where(answer.face < 0, -1, answer.face // 4)
    assert np.argwhere(truth.decidable & (whole != truth.face)).tolist() == []


@every_method
@by_chance
@given(seed=seeds, exponent=st.integers(-3, 9))
def test_scene_and_eye_moved_together_see_the_same(name: str, seed: int, exponent: int) -> None:
    scene, camera = mixed_scene(seed)
    place = np.eye(4)
    place[:3, :3] = np.roll(np.eye(3), seed % 3, axis=1)  # turned by whole right angles: exact
    place[:3, 3] = np.array([3, -5, 7]) * 2.0**exponent
    moved = Scene(tuple(replace(node, matrix=place) for node in scene.nodes))
    eye = camera.moved(place @ camera.world_from_eye)
    answer = METHODS[name](project(moved, eye, SIZE))
    truth = oracle.truth(scene, camera, SIZE)
    assert np.argwhere(truth.decidable & (answer.face != truth.face)).tolist() == []


# --- watertight -------------------------------------------------------------------------------------------


@every_method
@by_chance
@given(seed=seeds)
def test_a_closed_mesh_from_inside_shows_no_background(name: str, seed: int) -> None:
    random = np.random.default_rng(seed)
    points, faces = soups.ball(rings=int(random.integers(3, 16)))
    points = points * random.uniform(0.1, 30, 3)
    direction = random.normal(size=3)
    eye = points.mean(axis=0) + random.uniform(-0.5, 0.5, 3) * np.abs(points).max(axis=0) * 0.5
    # Near enough to cut no wall before the eye: only beside the picture
    near = float(10 ** random.uniform(-4, -1.2)) * float(np.abs(points).max(axis=0).min())
    camera = Camera.look_at(eye, eye + direction, fov=float(random.uniform(0.2, 2.6)), near=near)
    answer = METHODS[name](project(Scene.of(Mesh(points, faces)), camera, SIZE))
    assert np.argwhere(answer.face < 0).tolist() == []


@every_method
@by_chance
@given(seed=seeds)
def test_a_sheet_of_many_faces_through_the_near_plane_has_no_gap(name: str, seed: int) -> None:
    random = np.random.default_rng(seed)
    cells = int(random.integers(1, 12))
    u, v = np.meshgrid(*[np.sort(np.concatenate([[-1, 1], random.uniform(-1, 1, cells - 1)]))] * 2)
    at = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).reshape(-1)
    faces = np.concatenate(
        [np.stack([at, at + 1, at + cells + 2], 1), np.stack([at, at + cells + 2, at + cells + 1], 1)]
    )
    sides = random.normal(size=(2, 3)) * 10 ** random.uniform(0, 2, (2, 1))
    middle = np.array([0, 0, -1.0]) + random.uniform(-0.3, 0.3, 3)
    # Whole 64ths: the corners of the net lie exactly where they would on the single sheet
    many = (np.round(u * 64) / 64).reshape(-1, 1) * sides[0] + (np.round(v * 64) / 64).reshape(-1, 1) * sides[
        1
    ]
    one = np.array([-sides[0] - sides[1], sides[0] - sides[1], sides[0] + sides[1], sides[1] - sides[0]])
    camera = Camera(fov=float(random.uniform(0.3, 2.0)), near=0.5)
    truth = oracle.truth(Scene.of(Mesh(one + middle, [(0, 1, 2), (0, 2, 3)])), camera, SIZE)
    answer = METHODS[name](project(Scene.of(Mesh(many + middle, faces)), camera, SIZE))
    assert np.argwhere(truth.decidable & ((answer.face >= 0) != (truth.face >= 0))).tolist() == []


@every_exact_method
@by_chance
@given(seed=seeds)
def test_every_pixel_of_a_net_has_one_owner(name: str, seed: int) -> None:
    """Each face alone: together they own every pixel once; the border of the net lies outside the picture."""
    projected = soups.snapped("grid", seed, SIZE)
    p = projected.xy[projected.faces].astype(np.int64)
    across, down = p[:, 1:, 0] - p[:, :1, 0], p[:, 1:, 1] - p[:, :1, 1]
    area = across[:, 0] * down[:, 1] - across[:, 1] * down[:, 0]
    assume((area > 0).all())  # a shaken cell that is turned over lies on its neighbours
    owners = np.zeros(SIZE[::-1], dtype=int)
    for face in range(len(projected.faces)):
        owners += METHODS[name](projected.only(np.arange(len(projected.faces)) == face)).face >= 0
    assert np.argwhere(owners != 1).tolist() == []


# --- written twice ----------------------------------------------------------------------------------------


@every_exact_method
@by_chance
@given(kind=st.sampled_from(soups.SNAPPED), seed=seeds)
def test_steps_decide_as_the_kernel_does(name: str, kind: str, seed: int) -> None:
    assert_steps_are_the_kernels(name, soups.snapped(kind, seed, (31, 19), count=25))


@every_method
@settings(by_chance, max_examples=20)
@given(seed=seeds)
def test_steps_see_faces_around_the_eye_as_the_kernel_does(name: str, seed: int) -> None:
    assert_steps_are_the_kernels(name, project(*soups.around_the_eye(seed, count=24), (24, 16)))


@every_exact_method
@by_chance
@given(kind=st.sampled_from(soups.SNAPPED), seed=seeds)
def test_steps_count_what_the_kernel_counts(name: str, kind: str, seed: int) -> None:
    """In so small a picture, wherever a method parts larger ones."""
    projected = soups.snapped(kind, seed, (8, 8), count=12)
    *_, last = METHODS[name].steps(projected)
    assert dict(last.work) == dict(METHODS[name](projected).work)


def assert_steps_are_the_kernels(name: str, projected: Projected) -> None:
    answer = METHODS[name](projected)
    *_, last = METHODS[name].steps(projected)
    assert last.kind == "done"
    assert np.array_equal(last.data["face"], answer.face)
    assert np.array_equal(last.data["depth"], answer.depth)
    assert list(last.work) == list(answer.work)
