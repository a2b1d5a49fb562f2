"""Drawings between drawings."""

from __future__ import annotations

import numpy as np
import pytest

from eyeline.errors import OptionError
from eyeline.shapes.cel import Cel, Patch, between
from eyeline.shapes.outline import Outline

SQUARE = np.array([(0, 0), (10, 0), (10, 10), (0, 10)], float)
RED, BLUE = (1.0, 0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 0.5)


def patch(x: float, fill: tuple[float, float, float, float] = RED, name: str = "") -> Patch:
    return Patch((Outline(np.add(SQUARE, (x, 0))),), fill, name=name)


def left(found: Patch) -> float:
    return float(found.whole.points[:, 0].min())


def test_patches_of_one_name_become_each_other_wherever_they_are() -> None:
    start = Cel((patch(0, RED, "a"), patch(50, BLUE, "b")), (100, 100))
    end = Cel((patch(0, BLUE, "b"), patch(50, RED, "a")), (100, 100))
    assert {one.name: left(one) for one in start.inbetween(end).at(0.5).patches} == {"a": 25, "b": 25}


def test_without_names_place_decides() -> None:
    middle = Cel((patch(0), patch(50)), (100, 100)).inbetween(Cel((patch(52), patch(2)), (100, 100))).at(0.5)
    assert sorted(map(left, middle.patches)) == [1, 51]


def test_what_is_only_there_later_grows_out_of_its_centre() -> None:
    middle = Cel((patch(0),), (100, 100)).inbetween(Cel((patch(0), patch(50)), (100, 100))).at(0.25)
    new = middle.patches[1].whole.points
    np.testing.assert_allclose(new, 0.25 * SQUARE + 0.75 * 5 + (50, 0), atol=50 * 0.75 + 1e-9)
    assert np.ptp(new, axis=0) == pytest.approx(2.5)
    np.testing.assert_allclose((new.max(axis=0) + new.min(axis=0)) / 2, (55, 5))


def test_a_hole_stays_a_hole() -> None:
    hole = Outline(SQUARE[::-1] * 0.5 + 2.5)
    ring = Patch((Outline(SQUARE), hole), RED)
    moved = Patch((Outline(SQUARE + 20), Outline(hole.points + 20)), RED)
    found = Cel((ring,), (9, 9)).inbetween(Cel((moved,), (9, 9))).at(0.5).patches[0]
    assert [np.sign(one.area) for one in found.outlines] == [1, -1]


def test_paint_goes_from_nothing_by_growing_clear() -> None:
    np.testing.assert_allclose(between(None, RED, 0.25), (1, 0, 0, 0.25), atol=1e-6)
    np.testing.assert_allclose(between(RED, None, 0.25), (1, 0, 0, 0.75), atol=1e-6)
    assert between(None, None, 0.5) is None
    assert between(RED, BLUE, 0.5)[3] == 0.75  # type: ignore[index]


def test_the_ends_are_the_drawings_themselves() -> None:
    start, end = Cel((patch(0, RED),), (10, 10)), Cel((patch(5, BLUE),), (20, 30))
    way = start.inbetween(end)
    assert way.at(0).patches[0] is start.patches[0]
    assert way.at(1).patches[0] is end.patches[0]
    assert way.at(0.5).size == (15, 20)


def test_a_start_among_several_outlines_is_refused() -> None:
    with pytest.raises(OptionError, match="first is 1, but the drawings have 2 and 1 outlines"):
        Cel((patch(0), patch(5)), (9, 9)).inbetween(Cel((patch(0),), (9, 9)), first=1)
