"""The painter: the depth buffer's answer by order alone, whatever lies over, through or around each other."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

import eyeline as el
import oracle
import soups
from data import PROJECT, data
from eyeline.errors import SceneError
from eyeline.projection import project
from eyeline.projection.projected import Projected
from eyeline.visibility import METHODS
from eyeline.visibility.method import Step
from eyeline.visibility.painter import painter
from eyeline.visibility.painter.painter import Painter

PAINTER, ZBUFFER = METHODS["painter"], METHODS["zbuffer"]

PROGRAM = """
import hashlib
import soups
from eyeline.projection import project
from eyeline.visibility import METHODS
digest = hashlib.sha256()
pictures = [soups.snapped(kind, 5, (301, 200), 1000) for kind in soups.SNAPPED]
pictures += [project(*soups.around_the_eye(seed, 90), (301, 200)) for seed in range(4)]
for picture in pictures:
    answer = METHODS["painter"](picture)
    digest.update(answer.face.tobytes() + answer.depth.tobytes() + repr(sorted(answer.work.items())).encode())
print(digest.hexdigest())
"""


def picture_of(
    faces: Sequence[Sequence[tuple[float, float, float]]], size: tuple[int, int] = (8, 8)
) -> Projected:
    """Faces of three corners (x, y, depth), in pixels."""
    corners = np.array(faces, dtype=np.float64).reshape(-1, 3)
    numbers = np.arange(len(corners)).reshape(-1, 3)
    return soups.picture(
        np.round(corners[:, :2] * 256), corners[:, 2], numbers, np.array([soups.BOTH]), size, 0
    )


def assert_is_the_oracles(projected: Projected) -> dict[str, int]:
    face, depth = oracle.seen(projected)
    answer = PAINTER(projected)
    assert np.argwhere(answer.face != face).tolist() == []
    assert np.array_equal(answer.depth, depth)
    return dict(answer.work)


def ring(turns: int = 4, beside: float = 2.2, rise: float = 0.01, lean: float = 0.04) -> Projected:
    """Long faces around the middle of one cell, `beside` it, each with one end under the next one's other.

    rise, lean: of their depths, along a face and across it, for each pixel.
    """
    faces = []
    for k in range(turns):
        turn = 2 * np.pi * k / turns
        along, aside = np.array([np.cos(turn), np.sin(turn)]), np.array([-np.sin(turn), np.cos(turn)])
        faces.append(
            [
                (*(4 + aside * (beside + b) + along * a), 0.5 + rise * a + lean * b)
                for a, b in ((-4, -1), (-4, 1), (4, 0))
            ]
        )
    return picture_of(faces)


def steps_of(projected: Projected, kind: str) -> list[Step]:
    return [step for step in PAINTER.steps(projected) if step.kind == kind]


# --- order ------------------------------------------------------------------------------------------------


def test_a_face_that_reaches_farther_but_lies_before_is_swapped() -> None:
    """Sorted by its far end the floor comes first, though the page stands behind it."""
    floor = [(0, 0, 0.9), (8, 0, 0.9), (4, 8, 0.1)]
    page = [(0, 3, 0.3), (8, 3, 0.3), (4, 5, 0.3)]
    projected = picture_of([floor, page])
    work = assert_is_the_oracles(projected)
    assert (work["swaps"], work["splits"]) == (1, 0)
    assert [step.data["face"] for step in steps_of(projected, "painted")] == [1, 0]


def test_faces_that_pierce_each_other_are_cut_along_the_line_they_meet_in() -> None:
    left = [(0, 0, 0.9), (8, 0, 0.1), (0, 8, 0.9)]
    right = [(0, 0, 0.1), (8, 0, 0.9), (0, 8, 0.1)]
    projected = picture_of([left, right])
    assert assert_is_the_oracles(projected)["splits"] == 1
    (cut,) = steps_of(projected, "split")
    assert cut.data["verdict"] == "split"
    np.testing.assert_allclose(cut.data["segments"], [[(4, 0), (4, 7)]], atol=1e-5)


def test_a_cycle_is_broken_by_a_cut() -> None:
    projected = ring()
    work = assert_is_the_oracles(projected)
    assert (work["swaps"], work["splits"]) == (6, 1)
    (cut,) = steps_of(projected, "split")
    assert cut.sentence.startswith("a cycle: ")


def test_the_steps_cut_a_ring_of_planks_that_cells_take_apart() -> None:
    """One list of whole faces has to cut; a cell holds only one crossing of the ring."""
    explanation = el.explain(el.samples.cyclic_overlap(), "painter")
    kinds = [step.kind for step in explanation]
    first = explanation.steps[kinds.index("split")]
    assert PAINTER(explanation.projected).work["splits"] == 0
    assert re.fullmatch(r"all tests fail, .*: face \d is cut by the plane of face \d", first.sentence)
    assert len(first.data["segments"]) == 1 and first.data["verdict"] == "split"
    # Every test is named where it decides, and pieces of what was cut are painted one by one
    told = [step.sentence[:7] for step in explanation if step.kind == "compared"]
    assert set(told) == {"test 2:", "test 3:", "test 4:", "test 5:"}
    assert kinds.count("painted") == len(explanation.scene.surfaces) * 2 + kinds.count("split")


def test_rings_of_any_length_and_slope_are_seen_as_they_are() -> None:
    random = np.random.default_rng(5)
    splits = 0
    for _ in range(200):
        turns, beside = int(random.integers(3, 10)), random.uniform(0.5, 2.5)
        splits += assert_is_the_oracles(ring(turns, beside, *random.uniform(-0.1, 0.1, 2)))["splits"]
    assert splits > 200


def test_of_faces_in_one_plane_the_lower_number_is_seen() -> None:
    """Also where another reaches farther back, and is first in the list for it."""
    whole = [(0, 0, 0.25), (16, 0, 0.75), (0, 16, 0.25)]
    part = [(0, 0, 0.25), (8, 0, 0.5), (0, 8, 0.25)]
    inner = [(4, 0, 0.375), (8, 0, 0.5), (4, 4, 0.375)]
    for faces in ([whole, part, inner], [inner, whole, part], [part, inner, whole]):
        projected = picture_of(faces)
        assert_is_the_oracles(projected)
        assert PAINTER(projected).face[1, 5] == 0  # a pixel that all three cover


def test_a_part_wholly_hidden_is_not_painted() -> None:
    """Many faces in one place cost a comparison each, not one for each pair."""
    slope = [(0, 0, 0.2), (8, 0, 0.8), (0, 8, 0.4)]
    work = assert_is_the_oracles(picture_of([slope] * 500))
    assert work["parts wholly hidden"] == 499
    assert work["behind the other's plane"] == 499


# --- as the depth buffer sees -----------------------------------------------------------------------------


@pytest.mark.parametrize("kind", soups.SNAPPED)
def test_crowded_cells_are_seen_as_the_oracle_sees_them(kind: str) -> None:
    for seed in range(4):
        assert_is_the_oracles(soups.snapped(kind, seed, (40, 29), 600))


def test_many_cuts_in_one_cell() -> None:
    random = np.random.default_rng(8)
    corners = np.concatenate(
        [random.uniform(-20, 28, (150, 3, 2)), random.uniform(0.05, 1, (150, 3, 1))], axis=2
    )
    assert assert_is_the_oracles(picture_of(corners.tolist()))["splits"] > 300


@pytest.mark.parametrize("name", el.samples.HARD_CASES)
def test_hard_cases_are_seen_as_by_the_depth_buffer(name: str) -> None:
    scene = getattr(el.samples, name)()
    ours, theirs = (el.visible(scene, size=(320, 180), method=method) for method in ("painter", "zbuffer"))
    assert np.array_equal(ours.face, theirs.face)
    assert np.array_equal(ours.depth, theirs.depth)


@pytest.mark.parametrize("name", ["stanford-bunny.obj", "teapot.obj", "suzanne.obj"])
def test_real_models_are_seen_as_by_the_depth_buffer(name: str) -> None:
    scene = el.load(data(f"mesh/{name}"))
    middle, radius = scene.bounds.centre, scene.bounds.diagonal
    for k, size in enumerate([(97, 61), (320, 200), (1000, 700)]):
        for turn in np.arange(4) * np.pi / 2 + k:
            eye = middle + np.array([np.sin(turn), 0.4, np.cos(turn)]) * radius
            projected = project(scene, el.Camera.look_at(eye, middle, fov=0.9), size)
            ours, theirs = PAINTER(projected), ZBUFFER(projected)
            assert np.array_equal(ours.face, theirs.face)
            assert np.array_equal(ours.depth, theirs.depth)


def test_rows_of_cells_may_be_handled_in_groups(monkeypatch: pytest.MonkeyPatch) -> None:
    projected = soups.snapped("mixed", 4, (130, 97), 500)
    whole = PAINTER(projected)
    monkeypatch.setattr(painter, "GROUP", 100)
    grouped = PAINTER(projected)
    assert np.array_equal(whole.face, grouped.face)
    assert dict(whole.work) == dict(grouped.work)


def test_one_thread_and_many_give_the_same_bytes() -> None:
    path = os.pathsep.join([str(PROJECT / "tests"), str(PROJECT / "src")])
    digests = set()
    for count in ("1", "2", "5"):
        environment = os.environ | {"PYTHONPATH": path, "EYELINE_THREADS": count}
        run = subprocess.run(
            [sys.executable, "-c", PROGRAM], env=environment, capture_output=True, text=True, check=True
        )
        digests.add(run.stdout)
    assert len(digests) == 1


# --- limits -----------------------------------------------------------------------------------------------


def mutually_piercing(count: int, size: tuple[int, int]) -> Projected:
    random = np.random.default_rng(1)
    xy = random.uniform(-size[0], 2 * size[0], (count, 3, 2))
    corners = np.concatenate([xy, random.uniform(0.05, 1, (count, 3, 1))], axis=2)
    return picture_of(corners.tolist(), size)


def test_too_many_cuts_are_refused_in_a_sentence() -> None:
    crowd = mutually_piercing(5000, (640, 360))
    with pytest.raises(SceneError, match=r"has cut 20000 faces .* use method 'zbuffer'"):
        Painter(most_splits=20000)(crowd)


def test_too_many_comparisons_are_refused_in_a_sentence() -> None:
    with pytest.raises(SceneError, match="has compared 1000 pairs"):
        Painter(most_comparisons=1000)(mutually_piercing(400, (64, 48)))


def test_too_many_faces_in_a_row_of_cells_are_refused_in_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(painter, "MOST_PARTS", 50)
    with pytest.raises(SceneError, match=r"faces lie over each other in 8 rows .* at most 50"):
        PAINTER(mutually_piercing(60, (64, 48)))


def test_steps_refuse_what_the_kernel_refuses() -> None:
    few = replace(PAINTER, most_splits=3)
    crowd = mutually_piercing(40, (16, 16))
    with pytest.raises(SceneError, match="has cut 3 faces"):
        few(crowd)
    with pytest.raises(SceneError, match="has cut 3 faces"):
        list(few.steps(crowd))
