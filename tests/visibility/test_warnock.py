"""Area subdivision: the depth buffer's answer, and areas that are the picture."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import oracle
import soups
from eyeline.errors import OptionError
from eyeline.geometry.fixedpoint import GUARD
from eyeline.jit import threads
from eyeline.projection.projected import Projected
from eyeline.visibility import METHODS
from eyeline.visibility.warnock import area_lists
from eyeline.visibility.warnock.area_lists import TILE
from eyeline.visibility.warnock.quartering import SMALL
from eyeline.visibility.warnock.warnock import DECISIONS, decide

WARNOCK = METHODS["warnock"]
SIZE = (150, 97)


def stacked(count: int, size: tuple[int, int], depths) -> Projected:
    """Faces that each cover the whole picture, at these depths of their corners (count, 3)."""
    wide = np.array([(-GUARD // 2, -GUARD // 2), (GUARD // 2, -GUARD // 2), (0, GUARD // 2)])
    xy = np.tile(wide, (count, 1))
    return soups.picture(
        xy, np.reshape(depths, -1), np.arange(3 * count).reshape(-1, 3), np.array([3]), size, 0
    )


@pytest.mark.parametrize("kind", soups.SNAPPED)
def test_areas_are_the_picture_and_share_no_pixel(kind: str) -> None:
    answer = WARNOCK(soups.snapped(kind, 4, SIZE))
    owners = np.zeros(SIZE[::-1], int)
    for left, top, right, bottom in answer.areas.rectangles:
        owners[top:bottom, left:right] += 1
        assert max(right - left, bottom - top) <= TILE
    assert (owners == 1).all()
    assert len(answer.areas.face) == answer.work["areas"] - answer.work["areas cut"]


@pytest.mark.parametrize("kind", soups.SNAPPED)
def test_an_area_shows_what_was_decided_for_it(kind: str) -> None:
    answer = WARNOCK(soups.snapped(kind, 7, SIZE))
    areas = answer.areas
    for (left, top, right, bottom), decision, face in zip(
        areas.rectangles, areas.decision, areas.face, strict=True
    ):
        seen = set(np.unique(answer.face[top:bottom, left:right]))
        if DECISIONS[decision] == "sampled":
            assert max(right - left, bottom - top) <= SMALL
            assert face == -1
        else:
            assert seen <= {-1, face}


def test_a_face_before_everything_leaves_one_area_to_a_tile() -> None:
    random = np.random.default_rng(0)
    depths = np.concatenate([[[0.9] * 3], random.uniform(0.1, 0.8, (500, 3))])
    answer = WARNOCK(stacked(501, (128, 64), depths))
    assert answer.work["areas"] == 2
    assert answer.work["hidden"] == 1000
    assert [DECISIONS[one] for one in answer.areas.decision] == ["surrounded"] * 2
    assert (answer.face == 0).all()


def test_faces_as_deep_as_each_other_are_the_lowest_ones() -> None:
    answer = WARNOCK(stacked(20000, (128, 64), np.full((20000, 3), 0.5)))
    assert (answer.face == 0).all()
    assert answer.work["areas"] == 2
    assert answer.work["faces coincident"] == 19999


def test_what_is_many_times_in_one_place_is_looked_at_once() -> None:
    two = soups.snapped("large", 15, SIZE, count=2)
    many = replace(two, faces=np.tile(two.faces, (5000, 1)), face_count=10000)
    one, all_of_them = WARNOCK(two), WARNOCK(many)
    assert one.work["intersecting"] > 0
    assert np.array_equal(one.face, all_of_them.face)
    assert one.work["areas"] == all_of_them.work["areas"]
    assert one.work["intersecting"] == all_of_them.work["intersecting"]


def test_depths_that_differ_by_a_rounding_are_decided_as_the_oracle_does() -> None:
    """Sheets whose planes are a few units of float32 apart, some the other way at the other end."""
    random = np.random.default_rng(5)
    near = np.float32(0.5) + random.integers(-3, 4, (60, 3)) * np.float32(2.0**-24)
    projected = stacked(60, (70, 66), near)
    face, depth = oracle.seen(projected)
    answer = WARNOCK(projected)
    assert np.array_equal(answer.face, face)
    assert np.array_equal(answer.depth, depth)


@pytest.mark.parametrize("size", [(1, 1), (16384, 1), (1, 16384), (16384, 5)])
def test_the_longest_and_the_smallest_pictures_equal_the_oracle(size: tuple[int, int]) -> None:
    random = np.random.default_rng(3)
    xy = np.round(random.uniform(-2000, 18000, (40, 3, 2)) * (256, 256)).reshape(-1, 2)
    xy[:, np.argmin(size)] = np.round(random.uniform(-30, 40, 120) * 256)
    projected = soups.picture(
        xy, random.uniform(0, 1, 120), np.arange(120).reshape(-1, 3), np.array([3]), size, 0
    )
    face, depth = oracle.seen(projected)
    answer = WARNOCK(projected)
    assert np.array_equal(answer.face, face)
    assert np.array_equal(answer.depth, depth)


def test_no_face_is_all_background() -> None:
    empty = soups.picture(np.empty((0, 2)), np.empty(0), np.empty((0, 3), int), np.array([3]), (70, 20), 0)
    answer = WARNOCK(empty)
    assert (answer.face == -1).all()
    assert answer.work["areas"] == 2
    assert (answer.areas.decision == DECISIONS.index("empty")).all()


def test_a_face_that_only_its_box_brings_into_the_picture_is_counted_as_in_the_steps() -> None:
    corners = [(-200, 150), (150, -200), (-200, -200)]
    beside = soups.picture(
        np.array(corners) * 256, np.full(3, 0.5), np.array([(0, 1, 2)]), np.array([3]), (100, 8), 0
    )
    answer = WARNOCK(beside)
    *_, last = WARNOCK.steps(beside)
    assert answer.work["disjoint"] == 2
    assert dict(last.work) == dict(answer.work)


def test_too_many_faces_before_each_other_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    steep = np.random.default_rng(1).uniform(0.1, 0.9, (300, 3)) * (1, 1, 0.1)
    monkeypatch.setattr("eyeline.visibility.warnock.area_lists.MOST_ENTRIES", 3)
    with pytest.raises(OptionError, match=r"would list [\d,]+ faces.*'zbuffer'"):
        WARNOCK(stacked(300, (128, 128), steep))


def test_a_million_faces_in_each_other_s_way_are_given_up_within_an_area(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Six sheets that cross, again and again: one look at one area is a million relations."""
    random, count, limit = np.random.default_rng(2), 1_000_000, 10_000_000
    six = random.uniform(-64, 192, (18, 2)).round() * 256
    numbers = np.resize(np.arange(18).reshape(6, 3), (count, 3))
    # All reach as near, so that in the list, too, they come by turns
    depth = np.insert(random.uniform(0.1, 0.9, (6, 2)), 0, 1, axis=1).reshape(-1)
    crowd = soups.picture(six, depth, numbers, np.array([3]), (128, 128), 0)
    lists = area_lists.lists_of(crowd, area_lists.records_of(crowd))
    picture = np.empty((128, 128), np.int32), np.empty((128, 128), np.float32)
    monkeypatch.setattr("eyeline.visibility.warnock.warnock.MOST_WORK", limit)
    with pytest.raises(OptionError, match=r"more than 10,000,000 times.*'zbuffer'"):
        decide(crowd, lists, picture, (np.empty((0, 6), np.int32), np.empty(0, np.int64)))
    # A face is counted once, and compared at four corners; each thread may be amid an area of all of them
    assert lists.counts.sum() < 5 * (limit + threads() * count) + lists.starts[-1]


def test_too_much_work_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("eyeline.visibility.warnock.warnock.MOST_WORK", 100)
    with pytest.raises(OptionError, match=r"more than 100 times.*'zbuffer'"):
        WARNOCK(soups.snapped("large", 1, (128, 128)))
