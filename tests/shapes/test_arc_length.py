"""Outlines between outlines: corners stay, and places answer each other along the length."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from eyeline.errors import GeometryError, OptionError
from eyeline.shapes.arc_length import ArcLength, pairs
from eyeline.shapes.outline import Outline

SQUARE = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], float)


def turned(points: np.ndarray, angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return points @ np.array([(c, s), (-s, c)])


def circle(radius: float, count: int, begin: float = 0.0, backwards: bool = False) -> Outline:
    angle = begin + np.linspace(0, 2 * np.pi, count, endpoint=False) * (-1 if backwards else 1)
    return Outline(radius * np.stack([np.cos(angle), np.sin(angle)], axis=1))


@pytest.mark.parametrize("start_at", range(4))
@pytest.mark.parametrize("backwards", [False, True])
def test_a_square_meets_its_turned_self_corner_to_corner(start_at: int, backwards: bool) -> None:
    """Wherever the other one begins, and whichever way it is drawn."""
    other = np.roll(turned(SQUARE, 0.5), start_at, axis=0)
    middle = ArcLength(Outline(SQUARE), Outline(other[::-1] if backwards else other)).at(0.5)
    np.testing.assert_allclose(middle.points, (SQUARE + turned(SQUARE, 0.5)) / 2, atol=1e-12)


def test_a_chosen_start_is_where_the_first_point_goes() -> None:
    other = np.add(SQUARE, (5, 0))
    for first in range(4):
        last = ArcLength(Outline(SQUARE), Outline(other), first=first).at(1.0)
        np.testing.assert_allclose(last.points[0], other[first])
        np.testing.assert_allclose(last.points, np.roll(other, -first, axis=0))


def test_a_chosen_start_stays_where_an_outline_is_turned_round() -> None:
    last = ArcLength(Outline(SQUARE), Outline(SQUARE[::-1]), first=2).at(1.0)
    np.testing.assert_allclose(last.points[0], SQUARE[::-1][2])


@pytest.mark.parametrize("part", [0.0, 0.3, 1.0])
def test_between_circles_is_a_circle(part: float) -> None:
    middle = ArcLength(circle(1, 60), circle(3, 90, begin=1.0, backwards=True)).at(part)
    radius = np.linalg.norm(middle.points, axis=1)
    np.testing.assert_allclose(radius, 1 + 2 * part, atol=0.01)


@settings(derandomize=True, deadline=None, max_examples=60)
@given(st.integers(0, 2**32 - 1), st.integers(3, 20), st.integers(3, 20), st.booleans())
def test_the_ends_are_exactly_the_outlines(seed: int, count: int, other: int, closed: bool) -> None:
    """No corner is lost: every corner of an end is a point of it, and all its points are on its line."""
    random = np.random.default_rng(seed)
    start = Outline(random.normal(size=(count, 2)), closed)
    end = Outline(random.normal(size=(other, 2)), closed)
    between = ArcLength(start, end)
    for part, wanted in ((0.0, start), (1.0, end)):
        found = between.at(part)
        away = np.linalg.norm(found.points[:, None] - wanted.points[None], axis=2)
        assert away.min(axis=0).max() < 1e-9
        assert found.length == pytest.approx(wanted.length)


def test_an_open_line_goes_the_way_that_fits() -> None:
    line = np.array([(0, 0), (1, 0), (2, 1)], float)
    between = ArcLength(Outline(line, closed=False), Outline(np.add(line[::-1], (0, 3)), closed=False))
    np.testing.assert_allclose(between.at(0.5).points, np.add(line, (0, 1.5)), atol=1e-12)
    assert not between.at(0.5).closed


def test_outlines_meet_by_place_and_size_and_the_rest_stands_alone() -> None:
    here, there, small = Outline(SQUARE), Outline(np.add(SQUARE, (10, 0))), Outline(0.1 * SQUARE + (9, 0))
    assert pairs([here, there], [there, small, here]) == [(0, 2), (1, 0), (None, 1)]
    assert pairs([here], []) == [(0, None)]
    assert pairs([here], [Outline(SQUARE, closed=False)]) == [(0, None), (None, 0)]


def test_what_is_no_outline_is_refused() -> None:
    with pytest.raises(GeometryError, match=r"shape \(0,\)"):
        Outline(np.array([]))
    with pytest.raises(OptionError, match="first is 4; the outline has points 0 to 3"):
        ArcLength(Outline(SQUARE), Outline(SQUARE), first=4).at(0.5)
