"""Scenes that are hard for a method: each is what it says it is."""

from __future__ import annotations

import numpy as np
import pytest

from eyeline.errors import SceneError
from eyeline.render.visible import visible
from eyeline.samples import HARD_CASES, SAMPLES
from eyeline.visibility import METHODS

SIZE = (240, 150)


def seen(name: str, **options):
    return visible(SAMPLES[name](), size=SIZE, **options)


def overlaps(name: str) -> np.ndarray:
    """(N, N) whether node i is seen where i and j alone would both be seen."""
    scene = SAMPLES[name]()
    nodes = [index for index, node in enumerate(scene.nodes) if node.mesh is not None]
    nearest = seen(name).node
    alone = [visible(only(scene, index), size=SIZE).node >= 0 for index in nodes]
    return np.array([[((nearest == i) & alone[i] & alone[j]).any() for j in nodes] for i in nodes])


def only(scene, wanted: int):
    from dataclasses import replace

    nodes = [replace(node, visible=node.mesh is None or k == wanted) for k, node in enumerate(scene.nodes)]
    return replace(scene, nodes=tuple(nodes))


@pytest.mark.parametrize("name", HARD_CASES)
def test_a_case_says_which_methods_it_is_hard_for_and_why(name):
    scene, case = SAMPLES[name](), HARD_CASES[name]
    (note,) = scene.notes
    assert case.why in note
    assert all(method in note for method in case.methods)
    assert seen(name).work


def test_planks_overlap_in_a_ring():
    over = overlaps("cyclic_overlap")
    assert all(over[(k + 1) % 4, k] != over[k, (k + 1) % 4] for k in range(4))
    assert len({bool(over[k, (k + 1) % 4]) for k in range(4)}) == 1


def test_piercing_sheets_are_each_before_the_other():
    over = overlaps("piercing_faces")
    assert over.all()


def test_coplanar_sheets_go_by_their_numbers():
    answer = seen("coplanar_faces")
    assert len(np.unique(answer.depth[answer.node < 3])) >= 1
    scene = SAMPLES["coplanar_faces"]()
    shared = [visible(only(scene, index), size=SIZE) for index in range(3)]
    together = np.stack([one.node >= 0 for one in shared])
    first = np.where(together.any(axis=0), together.argmax(axis=0), -1)
    assert (answer.node[first >= 0] == first[first >= 0]).all()


def test_a_sheet_seen_edge_on_covers_nothing():
    scene = SAMPLES["edge_on_faces"]()
    answer = seen("edge_on_faces")
    assert not (answer.node == scene.find("90 degrees")).any()
    assert (answer.node == scene.find("75 degrees")).any()


def test_no_red_shines_through_the_junction():
    scene = SAMPLES["t_junction"]()
    assert not (seen("t_junction").node == scene.find("behind")).any()


def test_the_stack_is_deep():
    answer = seen("deep_stack")
    assert answer.work["depth tests"] > 30 * (answer.face >= 0).sum()


def test_one_body_is_convex_and_the_other_is_not():
    assert (METHODS["backface"](seen("convex_body").projected).face == seen("convex_body").face).all()
    with pytest.raises(SceneError, match="not convex"):
        METHODS["backface"](seen("concave_body").projected)
