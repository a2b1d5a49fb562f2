import numpy as np
import pytest

from eyeline.deform import morph

RNG = np.random.default_rng(0)
BASE = RNG.normal(size=(400, 3)).astype(np.float32)
DELTAS = [RNG.normal(size=(400, 3)).astype(np.float32) for _ in range(3)]


def test_no_weight_is_the_base_itself() -> None:
    assert morph.blend(BASE, DELTAS, [0, 0, 0]) is BASE
    assert morph.blend_directions(BASE, DELTAS, [0, 0, 0]) is BASE
    assert morph.blend(BASE, [None, None], [1, 1]) is BASE


def test_one_whole_target_is_its_shape() -> None:
    assert np.array_equal(
        morph.blend(BASE, DELTAS, [0, 1, 0]), (BASE.astype(float) + DELTAS[1]).astype(np.float32)
    )


def test_targets_add_up() -> None:
    expected = BASE + 0.25 * DELTAS[0].astype(float) - 2 * DELTAS[2].astype(float)
    found = morph.blend(BASE, [DELTAS[0], None, DELTAS[2]], [0.25, 7, -2])
    assert found.dtype == np.float32
    assert np.allclose(found, expected, rtol=1e-7, atol=1e-7)


def test_normals_stay_unit() -> None:
    found = morph.blend_directions(BASE, DELTAS, [0.5, 0.5, 0.5])
    assert np.allclose(np.linalg.norm(found, axis=1), 1, rtol=0, atol=1e-6)


def test_a_tangent_keeps_its_side() -> None:
    tangents = np.concatenate([BASE, np.tile([[1], [-1]], (200, 1))], axis=1).astype(np.float32)
    found = morph.blend_directions(tangents, DELTAS, [0.5, 0, 0])
    assert np.array_equal(found[:, 3], tangents[:, 3])
    assert np.allclose(np.linalg.norm(found[:, :3], axis=1), 1, rtol=0, atol=1e-6)


def test_normals_that_cancel_stay_as_they_were() -> None:
    assert np.array_equal(morph.blend_directions(BASE[:1], [-BASE[:1]], [1]), BASE[:1])


def test_threads_do_not_change_a_byte(monkeypatch: pytest.MonkeyPatch) -> None:
    base = np.tile(BASE, (50, 1))
    deltas = [np.tile(delta, (50, 1)) for delta in DELTAS]
    answers = []
    for count in (1, 2, 3):
        monkeypatch.setattr(morph, "threads", lambda count=count: count)
        answers.append(morph.blend(base, deltas, [0.1, 0.2, 0.3]).tobytes())
    assert answers[0] == answers[1] == answers[2]
