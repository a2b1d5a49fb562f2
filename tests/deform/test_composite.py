import numpy as np
import pytest

from eyeline.deform.bend import Bend
from eyeline.deform.composite import Composite, Mixture
from eyeline.deform.twist import Twist
from eyeline.errors import GeometryError

POINTS = np.random.default_rng(0).uniform(-1, 1, (300, 3))
TWIST, BEND = Twist(1.0, lower=-1.0), Bend(0.7, axis=(1.0, 1.0, 0.0))


def test_parts_follow_each_other() -> None:
    one_by_one, _, _ = BEND(TWIST(POINTS)[0])
    assert np.abs(Composite.of(TWIST, BEND)(POINTS)[0] - one_by_one).max() <= 1e-15


def test_a_composite_in_a_composite_is_the_longer_one() -> None:
    nested = Composite.of(Composite.of(TWIST, name="inner"), BEND)
    assert np.abs(nested(POINTS)[0] - Composite.of(TWIST, BEND)(POINTS)[0]).max() <= 1e-15


def test_moves_side_by_side_add_up() -> None:
    sum_of_moves = POINTS + (TWIST(POINTS)[0] - POINTS) + (BEND(POINTS)[0] - POINTS)
    assert np.abs(Mixture.of(TWIST, BEND)(POINTS)[0] - sum_of_moves).max() <= 1e-15


def test_a_mixture_of_one_is_that_one() -> None:
    assert np.abs(Mixture.of(BEND)(POINTS)[0] - BEND(POINTS)[0]).max() <= 1e-15


def test_parts_stand_where_the_composite_stands() -> None:
    moved = Composite.of(Twist(1.0), origin=(0.3, 0.2, 0.1))
    alone = Twist(1.0, origin=(0.3, 0.2, 0.1))
    assert np.abs(moved(POINTS)[0] - alone(POINTS)[0]).max() <= 1e-15


def test_a_tree_is_weighed_at_every_branch() -> None:
    tree = Composite.of(Composite.of(TWIST, BEND, weight=0.5, name="both"), BEND)
    both, _, _ = Composite.of(TWIST, BEND)(POINTS)
    assert np.abs(tree(POINTS)[0] - BEND((POINTS + both) / 2)[0]).max() <= 1e-15


def test_a_number_is_reached_by_its_path() -> None:
    tree = Composite.of(Composite.of(TWIST, name="inner"), BEND)
    assert tree.parameters["inner.twist.angle"] == 1.0
    changed = tree.changed({"inner.twist.angle": 0.0, "bend.angle": 0.0, "weight": 1.0})
    assert np.array_equal(changed(POINTS)[0], POINTS)


def test_parts_of_one_name_are_refused() -> None:
    with pytest.raises(GeometryError, match="2 deformers are called 'twist'; name them apart"):
        Composite.of(TWIST, TWIST)


def test_a_part_that_is_not_there_is_refused() -> None:
    with pytest.raises(GeometryError, match="there is no deformer 'bent'; there are twist, bend"):
        Composite.of(TWIST, BEND).changed({"bent.angle": 1.0})


def test_masks_of_two_lengths_are_refused() -> None:
    one, other = Twist(1.0, mask=np.ones(3)), Bend(1.0, mask=np.ones(4))
    with pytest.raises(GeometryError, match="a mask has 4 rows where another deformer has 3"):
        Composite.of(one, other)(POINTS)
