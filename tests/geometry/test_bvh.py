"""The tree of boxes: it holds every face once, inside every box above it, and follows points that move."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import soups
from eyeline.geometry.bvh import CHILD, CORNERS, EXTENT, MIDDLE, NO_CHILD, NO_FACE, NUMBER, Bvh, bvh_of
from eyeline.geometry.clustering import ROUNDS, clustered
from eyeline.geometry.morton import sorted_by_parts

seeds = st.integers(0, 10**6)
by_chance = settings(max_examples=40, deadline=None, derandomize=True)


def soup(seed: int, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Faces of very different sizes, some of them flat or a single point, sharing corners by chance."""
    random = np.random.default_rng(seed)
    points = random.normal(size=(max(3, count), 3)) * 10.0 ** random.integers(-3, 4, (max(3, count), 1))
    return points.astype(np.float32), random.integers(0, len(points), (count, 3)).astype(np.int32)


def assert_holds(tree: Bvh, points: np.ndarray, faces: np.ndarray) -> None:
    """Every face stands in one leaf with its corners, and within all boxes on the way there."""
    seen = []
    ways = [(0, np.full(3, -np.inf), np.full(3, np.inf))] if len(tree.nodes) else []
    for node, low, high in ways:
        for slot, child in enumerate(tree.children[node, CHILD].tolist()):
            if child == NO_CHILD:
                continue
            middle = tree.nodes[node, MIDDLE : MIDDLE + 3, slot].astype(float)
            extent = tree.nodes[node, EXTENT : EXTENT + 3, slot].astype(float)
            inner = np.maximum(low, middle - extent), np.minimum(high, middle + extent)
            if child > 0:
                ways.append((child, *inner))
                continue
            numbers = tree.numbers[~child, NUMBER]
            for place, face in enumerate(numbers.tolist()):
                if face != NO_FACE:
                    seen.append(face)
                    corners = tree.leaves[~child, CORNERS : CORNERS + 9, place].reshape(3, 3)
                    assert np.array_equal(corners, points[faces[face]])
                    assert (corners >= inner[0]).all()
                    assert (corners <= inner[1]).all()
    assert sorted(seen) == list(range(len(faces)))


@by_chance
@given(seed=seeds, count=st.sampled_from((0, 1, 2, 7, 8, 9, 64, 500)))
def test_every_face_stands_once_within_every_box_above_it(seed: int, count: int) -> None:
    points, faces = soup(seed, count)
    assert_holds(bvh_of(points, faces), points, faces)


@by_chance
@given(seed=seeds, count=st.sampled_from((0, 1, 9, 300)))
def test_a_refitted_tree_holds_the_moved_faces(seed: int, count: int) -> None:
    points, faces = soup(seed, count)
    moved = points[:, ::-1] * np.float32(-1.5) + np.float32(3)
    moved = np.ascontiguousarray(moved)
    assert_holds(bvh_of(points, faces).refit(moved), moved, faces)


def test_refitting_to_the_same_points_changes_nothing() -> None:
    points, faces = soup(3, 2000)
    tree = bvh_of(points, faces)
    again = tree.refit(points)
    assert again.nodes.tobytes() == tree.nodes.tobytes()
    assert again.leaves.tobytes() == tree.leaves.tobytes()


def test_a_tree_cannot_be_written() -> None:
    tree = bvh_of(*soup(0, 20))
    with pytest.raises(ValueError, match="read-only"):
        tree.nodes[0] = 0
    with pytest.raises(ValueError, match="read-only"):
        tree.numbers[0] = 0


def test_a_million_coincident_faces_make_a_tree() -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
    tree = bvh_of(points, np.tile(np.array([[0, 1, 2]], np.int32), (1_000_000, 1)))
    numbers = tree.numbers[:, NUMBER]
    assert np.array_equal(np.sort(numbers[numbers != NO_FACE]), np.arange(1_000_000))


@pytest.mark.parametrize("size", [1e-30, 1.0, 1e30])
def test_no_size_is_too_small_or_too_large(size: float) -> None:
    points, faces = soups.ball(8)
    points = (points * size).astype(np.float32)
    faces = faces.astype(np.int32)
    assert_holds(bvh_of(points, faces), points, faces)


def test_boxes_that_never_choose_each_other_are_merged_all_the_same() -> None:
    """Each is so much larger than the one before that only one pair a round is found."""
    count = 4 * ROUNDS
    edges = np.float32(1.05) ** -np.arange(count, 0, -1, dtype=np.float32)
    child, _ = clustered(np.stack([np.zeros(count, np.float32)] * 3 + [edges] * 3), 1)
    assert sorted(child[: count - 1].reshape(-1).tolist()) == list(range(2 * count - 2))


@by_chance
@given(seed=seeds, parts=st.integers(1, 9), count=st.integers(0, 200))
def test_keys_sorted_by_several_are_sorted(seed: int, parts: int, count: int) -> None:
    keys = np.random.default_rng(seed).permutation(np.arange(count, dtype=np.uint64) * np.uint64(977))
    assert np.array_equal(sorted_by_parts(keys.copy(), 0, parts), np.sort(keys))


def test_equal_codes_keep_the_order_of_their_numbers() -> None:
    codes = np.random.default_rng(4).integers(0, 2**40, 3000, dtype=np.uint64) // np.uint64(2**33)
    keys = codes << np.uint64(20) | np.arange(3000, dtype=np.uint64)
    for parts in (1, 2, 5):
        assert np.array_equal(sorted_by_parts(keys.copy(), 20, parts), np.sort(keys))
