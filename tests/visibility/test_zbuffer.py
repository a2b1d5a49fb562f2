"""The depth buffer: every size of picture and of face, and callers side by side."""

from __future__ import annotations

import threading

import numpy as np
import pytest

import oracle
import soups
from eyeline.projection import project
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS
from eyeline.visibility.zbuffer import scratch
from eyeline.visibility.zbuffer.scratch import give_back, take

ZBUFFER = METHODS["zbuffer"]


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


def test_faces_binned_by_one_thread_and_by_several_give_the_same_picture(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """In turn, on one scratch: what several leave in their bins is nothing to the one after them."""
    monkeypatch.setattr("eyeline.visibility.zbuffer.zbuffer.threads", lambda: 3)
    for seed, few in enumerate((0, 3000, 0, 3000)):
        monkeypatch.setattr("eyeline.visibility.zbuffer.zbuffer.FEW", few)
        projected = soups.snapped("mixed", seed, (131, 97), 3000)
        face, depth = oracle.seen(projected)
        answer = ZBUFFER(projected)
        assert np.array_equal(answer.face, face)
        assert np.array_equal(answer.depth, depth)
