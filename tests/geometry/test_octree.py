"""Octrees: every face in one leaf, every vertex in its boxes, and nothing else."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import soups
from eyeline.geometry.octree import (
    BEGIN,
    CHILD,
    CHILDREN,
    END,
    LEAF,
    LEAST,
    POINT,
    POINTS,
    Octree,
    joined,
    octree_of,
)

by_chance = settings(max_examples=40, deadline=None, derandomize=True)
seeds = st.integers(0, 10**6)


def soup(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Faces by chance, some of them alike."""
    random = np.random.default_rng(seed)
    count = int(random.integers(1, 800))
    points = random.normal(size=(int(random.integers(3, 900)), 3)) * 10 ** random.uniform(-3, 3, 3)
    faces = random.integers(0, len(points), (count, 3))
    faces[:: int(random.integers(2, 9))] = faces[0]
    return points.astype(np.float32), faces.astype(np.int32)


def leaves_of(tree: Octree) -> np.ndarray:
    return tree.nodes[tree.nodes[:, CHILDREN] == 0]


@by_chance
@given(seed=seeds, cubic=st.booleans())
def test_every_face_stands_in_one_leaf(seed: int, cubic: bool) -> None:
    points, faces = soup(seed)
    tree = octree_of(points, faces, cubic=cubic)
    leaves = leaves_of(tree)
    slots = np.concatenate([np.arange(begin, end) for begin, end in leaves[:, [BEGIN, END]]])
    assert sorted(slots.tolist()) == list(range(len(faces)))
    assert sorted(tree.rows.tolist()) == list(range(len(faces)))
    assert (leaves[:, END] - leaves[:, BEGIN]).max() <= LEAF


@by_chance
@given(seed=seeds)
def test_leaves_hold_the_corners_of_their_faces(seed: int) -> None:
    points, faces = soup(seed)
    tree = octree_of(points, faces)
    for leaf in leaves_of(tree):
        own = tree.points[leaf[POINT] : leaf[POINTS]]
        for slot in range(leaf[BEGIN], leaf[END]):
            assert np.array_equal(own[tree.corners[slot]], points[faces[tree.rows[slot]]])


@by_chance
@given(seed=seeds)
def test_boxes_are_as_tight_as_what_they_hold(seed: int) -> None:
    points, faces = soup(seed)
    tree = octree_of(points, faces)
    for node, box in zip(tree.nodes, tree.boxes, strict=True):
        corners = points[faces[tree.rows[node[BEGIN] : node[END]]]].reshape(-1, 3)
        assert np.array_equal(box, [*corners.min(axis=0), *corners.max(axis=0)])


@by_chance
@given(seed=seeds)
def test_children_share_out_their_parents_faces(seed: int) -> None:
    tree = octree_of(*soup(seed))
    for number, node in enumerate(tree.nodes):
        children = tree.nodes[node[CHILD] : node[CHILD] + node[CHILDREN]]
        if len(children):
            assert node[CHILD] > number
            assert 2 <= len(children) <= 8
            assert [node[BEGIN], *children[:, END]] == [*children[:, BEGIN], node[END]]


@by_chance
@given(seed=seeds)
def test_a_node_knows_its_least_number(seed: int) -> None:
    points, faces = soup(seed)
    numbers = np.random.default_rng(seed).integers(0, 10**9, len(faces)).astype(np.int32)
    tree = octree_of(points, faces, numbers)
    assert np.array_equal(tree.numbers, numbers[tree.rows])
    for node in tree.nodes:
        assert node[LEAST] == tree.numbers[node[BEGIN] : node[END]].min()


def test_faces_that_are_all_alike_are_dealt_out_in_their_order() -> None:
    tree = octree_of(np.eye(3, dtype=np.float32), np.tile(np.int32([[0, 1, 2]]), (5000, 1)))
    assert tree.rows.tolist() == list(range(5000))
    assert (leaves_of(tree)[:, END] - leaves_of(tree)[:, BEGIN]).max() <= LEAF


def test_a_fine_mesh_has_full_leaves() -> None:
    tree = octree_of(
        *[np.asarray(part, kind) for part, kind in zip(soups.ball(60), (np.float32, np.int32), strict=True)]
    )
    assert len(tree.rows) / len(leaves_of(tree)) > LEAF / 2


def test_no_face_makes_no_node() -> None:
    tree = octree_of(np.empty((0, 3), np.float32), np.empty((0, 3), np.int32))
    assert len(tree.nodes) == len(tree.points) == len(tree.rows) == 0


def test_joined_trees_are_what_they_were() -> None:
    trees = [octree_of(*soup(seed)) for seed in (1, 2, 3)]
    empty = octree_of(np.empty((0, 3), np.float32), np.empty((0, 3), np.int32))
    whole, roots = joined([trees[0], empty, *trees[1:]])
    assert roots[1] == -1
    for tree, root in zip(trees, roots[[0, 2, 3]], strict=True):
        node = whole.nodes[root]
        assert np.array_equal(whole.rows[node[BEGIN] : node[END]], tree.rows)
        assert np.array_equal(whole.boxes[root : root + len(tree.boxes)], tree.boxes)
        for own, moved in zip(tree.nodes, whole.nodes[root : root + len(tree.nodes)], strict=True):
            if not own[CHILDREN]:
                ours = tree.points[own[POINT] : own[POINTS]]
                assert np.array_equal(whole.points[moved[POINT] : moved[POINTS]], ours)


@pytest.mark.parametrize("count", [LEAF, LEAF + 1])
def test_a_leaf_is_divided_when_it_is_too_full(count: int) -> None:
    points = np.random.default_rng(0).normal(size=(3 * count, 3)).astype(np.float32)
    tree = octree_of(points, np.arange(3 * count, dtype=np.int32).reshape(-1, 3))
    assert (len(tree.nodes) == 1) == (count == LEAF)
