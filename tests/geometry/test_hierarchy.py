import numpy as np
import pytest

from eyeline.errors import GeometryError
from eyeline.geometry import hierarchy, quaternion, transform


def chain(times: int, nodes: int) -> tuple[np.ndarray, ...]:
    rng = np.random.default_rng(0)
    parents = np.array([rng.integers(-1, index) if index else -1 for index in range(nodes)], np.int32)
    turns = quaternion.normalized(rng.normal(size=(times, nodes, 4)))
    return rng.normal(size=(times, nodes, 3)), turns, rng.uniform(0.5, 2, (times, nodes, 3)), parents


def test_places_multiply_down_the_tree() -> None:
    shift, turn, scale, parents = chain(5, 12)
    world = hierarchy.world_from_nodes(shift, turn, scale, parents)
    local = transform.compose(shift, turn, scale)
    for node, parent in enumerate(parents):
        expected = local[:, node] if parent < 0 else world[:, parent] @ local[:, node]
        assert np.allclose(world[:, node], expected, rtol=1e-13, atol=1e-13)


def test_a_matrix_stands_in_for_a_place() -> None:
    shift, turn, scale, parents = chain(2, 3)
    parents[:] = (-1, 0, 1)
    shear = np.eye(4)
    shear[0, 1] = 2
    world = hierarchy.world_from_nodes(shift, turn, scale, parents, {1: shear})
    assert np.allclose(world[:, 1], world[:, 0] @ shear, rtol=1e-13, atol=1e-13)


def test_threads_do_not_change_a_byte(monkeypatch: pytest.MonkeyPatch) -> None:
    given = chain(2000, 8)
    answers = []
    for count in (1, 2, 3):
        monkeypatch.setattr(hierarchy, "threads", lambda count=count: count)
        answers.append(hierarchy.world_from_nodes(*given).tobytes())
    assert answers[0] == answers[1] == answers[2]


def test_a_child_before_its_parent_is_refused() -> None:
    shift, turn, scale, _ = chain(1, 2)
    with pytest.raises(GeometryError, match="comes before it"):
        hierarchy.world_from_nodes(shift, turn, scale, np.array([1, -1]))


def test_a_product_sums_in_order() -> None:
    a, b = np.random.default_rng(1).normal(size=(2, 6, 4, 4))
    assert np.allclose(transform.product(a, b), a @ b, rtol=1e-14, atol=1e-14)
