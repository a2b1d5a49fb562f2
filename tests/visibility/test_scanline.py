"""Scan line: its spans are the picture, piercing faces part at the right column, and depth costs no time."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import oracle
import soups
from eyeline.projection import project
from eyeline.projection.projected import Projected
from eyeline.samples import piercing_faces
from eyeline.scene.camera import Camera
from eyeline.visibility import METHODS
from eyeline.visibility.scanline.overtaking import nearer_throughout, overtaken
from eyeline.visibility.scanline.spans import Scanned

SCANLINE = METHODS["scanline"]
by_chance = settings(max_examples=60, deadline=None, derandomize=True)
seeds = st.integers(0, 10**6)


def scanned(projected: Projected) -> Scanned:
    answer = SCANLINE(projected)
    assert isinstance(answer, Scanned)
    return answer


# --- spans ------------------------------------------------------------------------------------------------


@by_chance
@given(kind=st.sampled_from(soups.SNAPPED), seed=seeds, size=st.sampled_from([(1, 1), (64, 48), (7, 90)]))
def test_spans_cover_the_picture_once_and_are_as_many_as_counted(
    kind: str, seed: int, size: tuple[int, int]
) -> None:
    answer = scanned(soups.snapped(kind, seed, size))
    covered = np.zeros(size[::-1], int)
    spans = answer.spans
    for row, first, last, face in zip(spans.row, spans.first, spans.last, spans.face, strict=True):
        covered[row, first : last + 1] += 1
        assert (answer.face[row, first : last + 1] == face).all()
        assert first == 0 or answer.face[row, first - 1] != face, "a span is as long as it can be"
    assert (covered == 1).all()
    assert answer.work["spans"] == len(spans)
    assert np.array_equal(spans.picture, answer.face)


def test_a_face_over_the_whole_picture_is_one_span_a_row() -> None:
    corners = np.array([(-4000, -4000), (90000, -4000), (-4000, 90000)])
    one = soups.picture(corners, np.full(3, 0.5), [(0, 1, 2)], np.array([3]), (64, 48), 0)
    answer = scanned(one)
    assert (answer.face == 0).all()
    assert answer.spans.rectangles.tolist() == [[0, y, 64, y + 1] for y in range(48)]
    assert answer.work["most edges active"] == 2
    assert answer.work["depth comparisons"] == 0


@pytest.mark.parametrize("size", [(16384, 1), (1, 16384)])
def test_the_longest_rows_and_columns_equal_the_oracle(size: tuple[int, int]) -> None:
    projected = soups.snapped("huge", 7, size, 60)
    face, depth = oracle.seen(projected)
    answer = scanned(projected)
    assert np.array_equal(answer.face, face)
    assert np.array_equal(answer.depth, depth)


def test_faces_without_area_and_no_faces_at_all_leave_the_background() -> None:
    points = np.array([(0, 0), (5000, 5000), (10000, 10000)])
    line = soups.picture(points, np.full(3, 0.5), [(0, 1, 2), (1, 1, 1)], np.array([3]), (16, 9), 0)
    assert (scanned(line).face == -1).all()
    none = soups.picture(points, np.full(3, 0.5), np.empty((0, 3)), np.array([3]), (16, 9), 0)
    assert scanned(none).work["spans"] == 9


# --- who is in front --------------------------------------------------------------------------------------


def test_piercing_faces_part_at_the_column_where_their_depths_cross() -> None:
    """One rises from 0.2 to 0.8 over 100 pixels, the other falls; they meet in the middle."""
    corners = np.array([(0, -25600), (0, 51200), (25600, -25600), (25600, 51200)])
    xy, faces = np.concatenate([corners, corners]), [(0, 2, 1), (1, 2, 3), (4, 6, 5), (5, 6, 7)]
    depth = np.array([0.2, 0.2, 0.8, 0.8, 0.8, 0.8, 0.2, 0.2])
    answer = scanned(soups.picture(xy, depth, faces, np.array([3]), (100, 1), 0))
    assert (answer.face[0, :50] >= 2).all()
    assert (answer.face[0, 50:] <= 1).all()
    # Some tries lead to the crossing, not one a pixel
    assert 0 < answer.work["depth comparisons"] < 50


def test_steps_tell_of_piercing() -> None:
    scene = piercing_faces()
    projected = project(scene, Camera.framing(scene.bounds), (48, 27))
    kinds = [step.kind for step in SCANLINE.steps(projected)]
    assert kinds.count("pierced") > 0
    assert {"tabled", "edges", "span"} < set(kinds)


def rounded(a: float, k: float, x: int) -> np.float32:
    return np.float32(k + a * float(x))


@by_chance
@given(seed=seeds)
def test_sure_is_right_at_every_column_and_the_overtaking_column_is_the_first(seed: int) -> None:
    """Lines that nearly coincide, by steps of both precisions."""
    random = np.random.default_rng(seed)
    a, k = random.uniform(-1, 1) * 2.0 ** -random.integers(8, 30), random.uniform(0.01, 1)
    other_a = a * (1 + random.integers(-3, 4) * 2.0 ** -random.integers(10, 53))
    other_k = k * (1 + random.integers(-3, 4) * 2.0 ** -random.integers(10, 53))
    lower, last = bool(seed % 2), int(random.integers(0, 300))
    loses = [
        x
        for x in range(last + 1)
        if rounded(a, k, x) < rounded(other_a, other_k, x)
        or (rounded(a, k, x) == rounded(other_a, other_k, x) and not lower)
    ]
    if nearer_throughout(a, k, other_a, other_k, lower, 0, last):
        assert loses == []
    assert overtaken(a, k, other_a, other_k, lower, 0, last)[0] == (loses[0] if loses else last + 1)


def test_the_margin_is_wider_than_what_rounding_can_do() -> None:
    """Both lines are off by at most 2**-53 (2 |a x| + |k|), at the end and between: twice, for two faces."""
    random = np.random.default_rng(1)
    epsilon = Fraction(2) ** -53
    for _ in range(900):
        a, k, x = random.normal(), random.normal(), int(random.integers(0, 16384))
        off = abs(Fraction(k + a * float(x)) - (Fraction(k) + Fraction(a) * x))
        assert off <= epsilon * (2 * abs(Fraction(a) * x) + abs(Fraction(k))) * (1 + 2 * epsilon)


# --- deep scenes ------------------------------------------------------------------------------------------


def stack(count: int, size: tuple[int, int], spread: float, order: int = 1) -> Projected:
    """Sheets over the whole picture behind each other, `spread` of depth between the first and the last."""
    corners = np.array([(-(2**18), -(2**18)), (2**22, -(2**18)), (-(2**18), 2**22)])
    xy = np.tile(corners, (count, 1))
    depth = np.repeat(0.9 - spread * np.arange(count)[::order] / count, 3)
    return soups.picture(xy, depth, np.arange(3 * count).reshape(-1, 3), np.array([3]), size, 0)


@pytest.mark.parametrize("order", [1, -1])
def test_hidden_sheets_are_met_once_a_row(order: int) -> None:
    answer = scanned(stack(1000, (64, 48), 0.5, order))
    assert (answer.face == (0 if order == 1 else 999)).all()
    assert answer.work["most edges active"] == 2000
    assert answer.work["depth comparisons"] <= 1000 * 48


def test_a_million_coincident_faces_are_one_comparison_a_row_each() -> None:
    count, rows = 10**6, 4
    answer = scanned(stack(count, (1920, rows), 0.0))
    assert (answer.face == 0).all()
    assert answer.work["depth comparisons"] == (count - 1) * rows
