from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import eyeline as el
from eyeline.render.fingerprint import fingerprint


def teapot() -> el.Scene:
    return el.samples.SAMPLES["teapot"]()


def test_equal_scenes_have_equal_fingerprints() -> None:
    assert fingerprint(teapot()) == fingerprint(teapot())


def test_one_moved_point_changes_it() -> None:
    scene = teapot()
    index, node = next((i, node) for i, node in enumerate(scene.nodes) if node.mesh is not None)
    assert node.mesh is not None
    points = node.mesh.points.copy()
    points[7, 1] += 1e-3
    moved = replace(node, mesh=node.mesh.changed(points=points))
    assert fingerprint(scene) != fingerprint(
        replace(scene, nodes=(*scene.nodes[:index], moved, *scene.nodes[index + 1 :]))
    )


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (1, 1.0),
        ("1", 1),
        (("ab", "c"), ("a", "bc")),
        ((1, (2, 3)), ((1, 2), 3)),
        (None, "None"),
        (True, 1),
        (np.zeros(4, np.float32), np.zeros(4, np.int32)),
        (np.zeros((2, 3)), np.zeros((3, 2))),
        ({"a": 1}, {"a": 2}),
        (0.0, -0.0),
    ],
)
def test_unlike_data_have_unlike_fingerprints(one: object, other: object) -> None:
    assert fingerprint(one) != fingerprint(other)


def test_the_order_of_a_mapping_does_not_matter() -> None:
    assert fingerprint({"a": 1, "b": 2}) == fingerprint({"b": 2, "a": 1})
