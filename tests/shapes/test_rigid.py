"""As rigid as possible: what only turns keeps its shape on the way."""

from __future__ import annotations

import numpy as np
import pytest

import eyeline as el
from eyeline.shapes.linear import Linear
from eyeline.shapes.rigid import Rigid
from shapes.bodies import bar, block, edge_lengths, moved, turned

QUARTERS = np.linspace(0, 1, 5)


@pytest.mark.parametrize("angle", [0.5, 1.5, 3.0])
def test_a_turned_bar_keeps_every_length(angle: float) -> None:
    start = bar()
    between = Rigid(start, moved(start, np.add(turned(start.points, angle), (1, 2, 3))))
    for points in between.sample(QUARTERS):
        lengths, whole = edge_lengths(points, start.faces), edge_lengths(start.points, start.faces)
        np.testing.assert_allclose(lengths, whole, atol=1e-5)


def test_a_bar_that_goes_straight_shrinks() -> None:
    """Half way of a turn by a right angle it is cos 45 degrees as long."""
    start = bar()
    half = Linear(start, moved(start, turned(start.points, np.pi / 2))).at(0.5)
    tall = np.linalg.norm(half.points, axis=1).max() / np.linalg.norm(start.points, axis=1).max()
    assert tall == pytest.approx(np.cos(np.pi / 4), abs=0.002)


def test_its_centroid_goes_straight() -> None:
    start = block((1, 1, 1))
    between = Rigid(start, moved(start, np.add(turned(start.points, 2.0), (4, 0, 0))))
    np.testing.assert_allclose(between.sample(QUARTERS).mean(axis=1)[:, 0], 4 * QUARTERS, atol=1e-6)


def test_a_bar_bent_by_more_than_half_a_turn_is_bent_half_on_the_way() -> None:
    """Each ring turns on by its own angle, the last by 1.5 turns: none takes the shorter way round."""
    start = bar(length=6.0, rings=120)
    bend = 3 * np.pi / 6  # radians a metre

    def bent(rate: float) -> np.ndarray:
        x, y, z = start.points.astype(np.float64).T
        angle = rate * y
        if rate == 0:
            return start.points
        return np.stack(
            [(x - 1 / rate) * np.cos(angle) + 1 / rate, (1 / rate - x) * np.sin(angle), z], axis=1
        )

    middle = Rigid(start, moved(start, bent(bend))).sample([0.5])[0]
    wanted = bent(bend / 2)
    difference = (middle - middle.mean(axis=0)) - (wanted - wanted.mean(axis=0))
    assert np.abs(difference).max() < 0.3  # a twentieth of the bar


def test_stretches_grow_evenly() -> None:
    start = block((1, 1, 1))
    half = Rigid(start, moved(start, start.points * (3, 1, 1))).at(0.5)
    np.testing.assert_allclose(half.bounds.high - half.bounds.low, (2, 1, 1), atol=1e-6)


def test_parts_that_do_not_touch_each_turn_about_their_own_middle() -> None:
    one, other = block((1, 1, 1), (-3, 0, 0)), block((1, 1, 1), (3, 0, 0))
    start = el.Mesh(
        np.vstack([one.points, other.points]), np.vstack([one.faces, other.faces + len(one.points)])
    )
    points = start.points.copy()
    points[len(one.points) :] = np.add(turned(other.points - (3, 0, 0), np.pi / 2), (3, 0, 0))
    half = Rigid(start, moved(start, points)).sample([0.5])[0]
    np.testing.assert_allclose(half[: len(one.points)], one.points, atol=1e-5)
    np.testing.assert_allclose(half[len(one.points) :].mean(axis=0), (3, 0, 0), atol=1e-5)


def test_points_of_no_face_go_straight() -> None:
    start = el.Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (5, 5, 5)], [(0, 1, 2)])
    end = el.Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (7, 5, 5)], [(0, 1, 2)])
    np.testing.assert_allclose(Rigid(start, end).sample([0.5])[0, 3], (6, 5, 5), atol=1e-12)


def test_faces_without_area_follow() -> None:
    """A needle among the faces, and a mesh of nothing else: no number is lost."""
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.5, 0, 0)]
    start = el.Mesh(points, [(0, 1, 2), (0, 3, 1)])
    end = el.Mesh(np.multiply(points, 2), start.faces)
    np.testing.assert_allclose(Rigid(start, end).at(0.5).points[:3], np.multiply(points, 1.5)[:3], atol=1e-6)
    needle = el.Mesh([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)])
    moved_needle = el.Mesh([(0, 2, 0), (1, 2, 0), (2, 2, 0)], [(0, 1, 2)])
    np.testing.assert_allclose(Rigid(needle, moved_needle).sample([0.5])[0, :, 1], 1, atol=1e-12)


def test_creases_stay_crisp() -> None:
    start = block((1, 1, 1))
    half = Rigid(start, moved(start, turned(start.points, 1.0))).at(0.5)
    np.testing.assert_allclose(half.normals, turned(start.normals, 0.5), atol=1e-4)
