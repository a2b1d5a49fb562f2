"""Cut points belong to edges, not to faces."""

from __future__ import annotations

import numpy as np

from eyeline.projection.clipping import Pieces, before, clipped, crossing, snapped

SIZE = (640, 480)


def ends(seed: int, count: int = 4000) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    random = np.random.default_rng(seed)
    a, b = random.normal(size=(2, count, 4)) * 10 ** random.uniform(-3, 3, (2, count, 1))
    return a, b, random.uniform(0, 5, count), -random.uniform(0, 5, count)


def test_an_edge_is_cut_at_the_same_point_from_both_ends() -> None:
    a, b, reach_a, reach_b = ends(1)
    assert np.array_equal(crossing(a, b, reach_a, reach_b), crossing(b, a, reach_b, reach_a))


def test_the_order_of_ends_is_total() -> None:
    random = np.random.default_rng(2)
    a, b = random.integers(0, 2, (2, 500, 4)).astype(float)
    same = (a == b).all(axis=1)
    assert np.array_equal(before(a, b) | before(b, a), ~same)
    assert not (before(a, b) & before(b, a)).any()
    assert before(a, b).tolist() == [tuple(x) < tuple(y) for x, y in zip(a.tolist(), b.tolist(), strict=True)]


def test_pieces_keep_the_area_of_what_is_inside() -> None:
    """A face across the near plane, in eye space with w = 1: what is left is what lies before it."""
    corners = np.array([[[0, 0, 0, 1], [4, 0, 0, 1], [0, 0, 4, 1]]], dtype=float)
    left = clipped(Pieces(corners, np.full((1, 3), -1), np.array([7])), SIZE)
    p = left.corners
    area = (
        np.sqrt((np.cross(p[:, 1, :3] - p[:, 0, :3], p[:, 2, :3] - p[:, 0, :3]) ** 2).sum(axis=1)).sum() / 2
    )
    assert np.isclose(area, 8 - 4.5)
    assert left.source.tolist() == [7] * len(p)


def test_a_placed_corner_stays_inside_whatever_rounding_says() -> None:
    """Its other faces are not cut: were this one cut there, a gap would open."""
    corners = np.array([[[0, 0, 1 + 1e-9, 1], [1, 0, 0, 1], [0, 0, 3, 1]]], dtype=float)
    left = clipped(Pieces(corners, np.array([[5, 6, -1]]), np.array([0])), SIZE)
    assert 5 in left.vertex
    assert 6 in left.vertex


def test_cut_corners_are_snapped_to_the_nearest_unit() -> None:
    xy, depth = snapped(np.array([[0.0, 0, 0.5, 2], [1, -1, 1, 1]]), SIZE)
    assert xy.tolist() == [[320 * 256, 240 * 256], [640 * 256, 480 * 256]]
    assert depth.tolist() == [0.25, 1]
