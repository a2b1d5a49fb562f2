import math

import numpy as np
import pytest

from eyeline.deform.affine import Affine
from eyeline.deform.composite import Composite
from eyeline.deform.rigid import Reflection, Rotation, Translation

RNG = np.random.default_rng(0)
POINTS = RNG.uniform(-3, 3, (400, 3))
PLACE = {"origin": (1.0, -2.0, 0.5), "axis": (0.3, -1.0, 2.0)}
RIGID: list[Affine] = [
    Translation((3.0, -1.0, 2.0), **PLACE),
    Rotation(2.2, **PLACE),
    Reflection(**PLACE),
    Rotation(1.0, axis=(0.0, -1.0, 0.0)),
]


@pytest.mark.parametrize("rigid", RIGID, ids=lambda one: one.kind)
def test_every_distance_is_kept(rigid: Affine) -> None:
    moved, _, _ = rigid(POINTS)
    before, after = (np.linalg.norm(one[:, None] - one[None], axis=2) for one in (POINTS, moved))
    assert np.abs(after - before).max() <= 1e-12


@pytest.mark.parametrize("rigid", RIGID, ids=lambda one: one.kind)
def test_only_a_mirror_turns_the_hand(rigid: Affine) -> None:
    hand = -1 if isinstance(rigid, Reflection) else 1
    assert np.allclose(rigid.growth(POINTS), hand, rtol=0, atol=1e-12)
    assert rigid.mirrors == (hand < 0)


def test_a_rotation_leaves_its_axis() -> None:
    axis = np.array(PLACE["origin"]) + np.linspace(-4, 4, 9)[:, None] * PLACE["axis"]
    assert np.abs(RIGID[1](axis)[0] - axis).max() <= 1e-14


def test_a_rotation_follows_the_right_hand() -> None:
    quarter = Rotation(math.pi / 2, axis=(0.0, 0.0, 2.0))
    assert np.allclose(quarter(np.array([[1.0, 0.0, 0.0]]))[0], [[0, 1, 0]], rtol=0, atol=1e-15)


def test_a_reflection_leaves_its_plane_and_undoes_itself() -> None:
    across = np.cross(RNG.normal(size=(9, 3)), PLACE["axis"]) + PLACE["origin"]
    assert np.abs(RIGID[2](across)[0] - across).max() <= 1e-14
    assert np.abs(RIGID[2](RIGID[2](POINTS)[0])[0] - POINTS).max() <= 1e-14


def test_matrices_compose_as_the_deformers_do() -> None:
    product = RIGID[2].matrix @ RIGID[1].matrix @ RIGID[0].matrix
    found, _, _ = Composite(tuple(RIGID[:3]))(POINTS)
    assert np.abs(found - (POINTS @ product[:3, :3].T + product[:3, 3])).max() <= 1e-13


def test_two_mirrors_turn_the_hand_back() -> None:
    two = Composite((Reflection(name="one"), Reflection(axis=(1.0, 0.0, 0.0))))
    assert not two.mirrors
    assert not Reflection(weight=0.4).mirrors
    assert Reflection(weight=0.6).mirrors
