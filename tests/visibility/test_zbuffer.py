"""The depth buffer: the same bytes for everybody, and no disagreement with Embree where the eye can tell."""

from __future__ import annotations

import os
import subprocess
import sys
import threading

import numpy as np
import pytest
import trimesh

import oracle
import soups
from data import PROJECT, data
from eyeline.projection import project
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS
from eyeline.visibility.zbuffer import scratch
from eyeline.visibility.zbuffer.scratch import give_back, take

ZBUFFER = METHODS["zbuffer"]

PROGRAM = """
import hashlib
import soups
from eyeline.projection import project
from eyeline.visibility import METHODS
digest = hashlib.sha256()
pictures = [soups.snapped(kind, 5, (301, 200), 2000) for kind in soups.SNAPPED]
pictures += [project(*soups.around_the_eye(seed, 600), (301, 200)) for seed in range(6)]
for picture in pictures:
    answer = METHODS["zbuffer"](picture)
    digest.update(answer.face.tobytes() + answer.depth.tobytes() + repr(sorted(answer.work.items())).encode())
print(digest.hexdigest())
"""


def digest_of(**environment: str) -> str:
    """What another process sees, with these variables set."""
    path = os.pathsep.join([str(PROJECT / "tests"), str(PROJECT / "src")])
    run = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        env=os.environ | {"PYTHONPATH": path} | environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    return run.stdout.strip()


def test_one_thread_and_many_give_the_same_bytes() -> None:
    assert len({digest_of(NUMBA_NUM_THREADS=count) for count in ("1", "2", "5")}) == 1


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


def test_callers_side_by_side_get_their_own_answers() -> None:
    pictures = [soups.snapped("mixed", seed, (320, 200), 400) for seed in range(4)]
    wanted = [ZBUFFER(picture) for picture in pictures]
    wrong = []

    def call(k: int) -> None:
        for _ in range(20):
            answer = ZBUFFER(pictures[k])
            if not (
                np.array_equal(answer.face, wanted[k].face) and np.array_equal(answer.depth, wanted[k].depth)
            ):
                wrong.append(k)

    callers = [threading.Thread(target=call, args=(k,)) for k in range(4)]
    for caller in callers:
        caller.start()
    for caller in callers:
        caller.join()
    assert wrong == []


def test_bins_that_are_too_small_are_made_larger(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        "eyeline.visibility.zbuffer.zbuffer.shelf.take",
        lambda parts, size, _: scratch.made(parts, size, 2, 1),
    )
    projected = soups.snapped("mixed", 11, (130, 97), 3000)
    face, depth = oracle.seen(projected)
    answer = ZBUFFER(projected)
    assert np.array_equal(answer.face, face)
    assert np.array_equal(answer.depth, depth)


def test_a_scratch_is_lent_to_one_caller_at_a_time() -> None:
    first, second = take(1, (70, 200), 10), take(1, (70, 200), 10)
    assert first.ends is not second.ends
    give_back(first)
    assert take(1, (70, 200), 10).ends is first.ends


@pytest.mark.parametrize("size", [(16384, 60), (60, 16384)])
def test_the_longest_pictures_are_drawn_to_their_corners(size: tuple[int, int]) -> None:
    width, height = size
    aspect = width / height
    corner = [(aspect * 0.9, -1, -1), (aspect, -1, -1), (aspect, -0.9, -1)]
    camera = Camera(height=2.0, near=0.1, far=2.0)
    answer = ZBUFFER(project(Scene.of(Mesh(corner, [(0, 1, 2)])), camera, size))
    assert answer.face[-1, -1] == 0
    assert answer.face[0, 0] == -1
    assert int((answer.face == 0).sum()) == pytest.approx(width * height / 800, rel=0.1)


def test_a_large_picture_equals_the_oracle() -> None:
    """Faces of all sizes, up to the width of 16384 pixels, in rows that hold every lane of the kernels."""
    random = np.random.default_rng(3)
    xy = random.uniform(-2000, 18000, (40, 3, 2)) * (256, 1)
    xy[..., 1] = random.uniform(-30, 40, (40, 3)) * 256
    projected = soups.picture(
        np.round(xy).reshape(-1, 2),
        random.uniform(0, 1, 120),
        np.arange(120).reshape(-1, 3),
        np.array([3]),
        (16384, 9),
        0,
    )
    face, depth = oracle.seen(projected)
    answer = ZBUFFER(projected)
    assert np.array_equal(answer.face, face)
    assert np.array_equal(answer.depth, depth)


def test_long_faces_that_only_just_reach_into_the_picture_equal_the_oracle() -> None:
    random = np.random.default_rng(5)
    xy = random.uniform((-8000, -40), (0, 80), (60, 3, 2)) * 256
    xy[:, 0] = random.uniform((1, 0), (14, 40), (60, 2)) * 256
    projected = soups.picture(
        np.round(xy).reshape(-1, 2),
        random.uniform(0, 1, 180),
        np.arange(180).reshape(-1, 3),
        np.array([3]),
        (48, 40),
        0,
    )
    face, depth = oracle.seen(projected)
    assert len(np.unique(face)) > 5
    answer = ZBUFFER(projected)
    assert np.array_equal(answer.face, face)
    assert np.array_equal(answer.depth, depth)


def test_nothing_is_counted_twice() -> None:
    projected = soups.snapped("mixed", 2, (64, 48), 500)
    work = ZBUFFER(projected).work
    assert work["faces"] == 500
    assert work["depth tests"] == sum(
        oracle.one_face(projected.xy[corners], projected.depth[corners], int(side), (48, 64))[0].sum()
        for corners, side in zip(projected.faces, np.broadcast_to(projected.sides, 500), strict=True)
    )


# --- an outside judge -------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["stanford-bunny.obj", "teapot.obj", "spot.obj"])
def test_embree_sees_the_same_wherever_a_pixel_is_decidable(name: str) -> None:
    file = data(f"mesh/{name}")
    embree = pytest.importorskip("embreex.rtcore_scene")
    construction = pytest.importorskip("embreex.mesh_construction")
    mesh = trimesh.load(file, force="mesh", process=False)
    points, faces = np.asarray(mesh.vertices, np.float32), np.asarray(mesh.faces)
    scene, size, angle = Scene.of(Mesh(points, faces)), (640, 480), 0.9
    middle, radius = scene.bounds.centre, scene.bounds.diagonal / 2
    camera = Camera.look_at(middle + np.array([0.7, 0.5, 1.9]) * radius, middle, fov=angle, near=0.1 * radius)
    ours = ZBUFFER(project(scene, camera, size)).face

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
