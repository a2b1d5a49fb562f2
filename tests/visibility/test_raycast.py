"""Ray casting: the same bytes for everybody, instances and mirrors, and no disagreement with Embree."""

from __future__ import annotations

import gc
import math
import os
import subprocess
import sys
import weakref
from dataclasses import replace

import numpy as np
import pytest
import trimesh

import oracle
import soups
from data import PROJECT, data
from eyeline.projection import project
from eyeline.scene.camera import Camera
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS
from eyeline.visibility.raycast.casts import tree_of

RAYCAST, ZBUFFER = METHODS["raycast"], METHODS["zbuffer"]

PROGRAM = """
import hashlib
import soups
from eyeline.projection import project
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS
digest = hashlib.sha256()
pictures = [project(*soups.around_the_eye(seed, 600), (301, 200)) for seed in range(7)]
ball = Scene.of(Mesh(*soups.ball(60)))
pictures.append(project(ball, Camera.look_at((1, 2, 3), (0, 0, 0)), (301, 200)))
for picture in pictures:
    answer = METHODS["raycast"](picture)
    digest.update(answer.face.tobytes() + answer.depth.tobytes() + repr(sorted(answer.work.items())).encode())
print(digest.hexdigest())
"""


def digest_of(program: str = PROGRAM, **environment: str) -> str:
    """What another process sees, with these variables set."""
    path = os.pathsep.join([str(PROJECT / "tests"), str(PROJECT / "src")])
    run = subprocess.run(
        [sys.executable, "-c", program],
        env=os.environ | {"PYTHONPATH": path} | environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    return run.stdout.strip()


def test_one_thread_and_many_give_the_same_bytes() -> None:
    assert len({digest_of(NUMBA_NUM_THREADS=count) for count in ("1", "2", "5")}) == 1


def test_kernels_that_run_uncompiled_give_the_same_bytes() -> None:
    program = PROGRAM.replace("600", "6").replace("(301, 200)", "(9, 7)").replace("60)", "3)")
    assert digest_of(program, NUMBA_DISABLE_JIT="1") == digest_of(program)


@pytest.mark.slow
def test_any_processor_gives_the_same_bytes(tmp_path) -> None:
    """Compiled for none of this processor's own instructions."""
    plain = digest_of(
        NUMBA_CPU_NAME="generic",
        NUMBA_CPU_FEATURES="",
        OPENBLAS_CORETYPE="Prescott",
        EYELINE_CACHE_DIR=str(tmp_path),
    )
    assert plain == digest_of()


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


# --- an outside judge -------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["stanford-bunny.obj", "teapot.obj", "spot.obj"])
@pytest.mark.parametrize("turn", [0.0, 2.0, 4.0])
def test_embree_sees_the_same_wherever_a_pixel_is_decidable(name: str, turn: float) -> None:
    file = data(f"mesh/{name}")
    embree = pytest.importorskip("embreex.rtcore_scene")
    construction = pytest.importorskip("embreex.mesh_construction")
    mesh = trimesh.load(file, force="mesh", process=False)
    points, faces = np.asarray(mesh.vertices, np.float32), np.asarray(mesh.faces)
    scene, size, angle = Scene.of(Mesh(points, faces)), (640, 480), 0.9
    middle, radius = scene.bounds.centre, scene.bounds.diagonal / 2
    eye = middle + np.array([2 * math.sin(turn), 0.5, 2 * math.cos(turn)]) * radius
    camera = Camera.look_at(eye, middle, fov=angle, near=0.1 * radius)
    ours = RAYCAST(project(scene, camera, size)).face

    x, y = np.meshgrid(np.arange(size[0]) + 0.5, np.arange(size[1]) + 0.5)
    up = np.tan(angle / 2)
    through = [(2 * x / size[0] - 1) * up * size[0] / size[1], (1 - 2 * y / size[1]) * up, -np.ones_like(x)]
    directions = np.stack(through, axis=-1).reshape(-1, 3) @ camera.world_from_eye[:3, :3].T
    origins = np.tile(camera.world_from_eye[:3, 3].astype(np.float32), (len(directions), 1))
    world = embree.EmbreeScene()
    construction.TriangleMesh(world, points[faces])
    theirs = world.run(origins, directions.astype(np.float32)).reshape(size[1], size[0])

    different = np.argwhere(ours != theirs)
    assert (ours >= 0).mean() > 0.05
    assert len(different) < 0.01 * ours.size
    faces = oracle.screened(scene, camera, size)
    assert [place for place in different.tolist() if faces.is_decidable(place[1], place[0])] == []
