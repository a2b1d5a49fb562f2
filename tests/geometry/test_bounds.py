import numpy as np
import pytest

from eyeline.geometry.bounds import Bounds


@pytest.mark.parametrize("count", [1, 2, 31, 32, 33, 64, 1000])
def test_the_box_touches_the_outermost_points(count: int) -> None:
    points = np.random.default_rng(count).normal(size=(count, 3)).astype(np.float32)
    bounds = Bounds.of(points)
    assert np.array_equal(bounds.low, points.min(axis=0))
    assert np.array_equal(bounds.high, points.max(axis=0))


def test_no_points_have_no_box() -> None:
    assert Bounds.of(np.empty((0, 3))).is_empty


def test_a_box_turned_holds_its_corners() -> None:
    bounds = Bounds.of(np.array([[-1.0, -2, -3], [1, 2, 3]]))
    turned = bounds.moved(np.array([[0.0, -1, 0, 5], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]))
    assert turned.low.tolist() == [3, -1, -3]
    assert turned.high.tolist() == [7, 1, 3]


def test_a_union_holds_both() -> None:
    one, other = Bounds.of(np.zeros((1, 3))), Bounds.of(np.ones((1, 3)))
    assert one.union(other).diagonal == np.sqrt(3)
    assert one.union(Bounds.empty()).diagonal == 0
