"""A path is walked by the metre, and its traveller does not twist."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from eyeline.errors import GeometryError
from eyeline.geometry import quaternion
from eyeline.motion.path import Path

SEEDS = st.integers(0, 2**32 - 1)


def wandering(seed: int, *, closed: bool) -> Path:
    return Path.through(np.random.default_rng(seed).normal(size=(6, 3)), closed=closed)


@given(SEEDS, st.booleans())
@settings(max_examples=25, deadline=None, derandomize=True)
def test_speed_along_a_path_is_constant(seed: int, closed: bool) -> None:
    """Ten thousand chords between even distances: none is longer than its arc, and they add up to it."""
    path = wandering(seed, closed=closed)
    places = path.at(np.linspace(0, path.length * (1 - 1e-15), 10_001))
    steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
    arc = path.length / 10_000
    assert steps.max() <= arc * (1 + 1e-6)
    assert np.quantile(steps, 0.05) >= arc * 0.999
    assert steps.sum() == pytest.approx(path.length, rel=1e-3)


def test_a_circle_has_its_length_and_stays_at_its_radius() -> None:
    path = Path.circle((1, 2, 3), 2.0)
    assert path.length == pytest.approx(4 * math.pi, rel=3e-4)
    radii = np.linalg.norm(path.at(np.linspace(0, 20, 100)) - (1, 2, 3), axis=1)
    assert np.abs(radii / 2 - 1).max() < 3e-4


def test_a_path_goes_through_its_places() -> None:
    places = np.random.default_rng(3).normal(size=(5, 3))
    path = Path.through(places)
    near = path.at(np.linspace(0, path.length, 200_001))
    for place in places:
        assert np.linalg.norm(near - place, axis=1).min() < 1e-4


def test_straight_lines_are_walked_evenly() -> None:
    path = Path.straight([(0, 0, 0), (3, 0, 0), (3, 4, 0)])
    assert path.length == pytest.approx(7)
    assert np.allclose(path.at([-1, 1.5, 3, 5, 9]), [(0, 0, 0), (1.5, 0, 0), (3, 0, 0), (3, 2, 0), (3, 4, 0)])


@given(SEEDS, st.booleans())
@settings(max_examples=15, deadline=None, derandomize=True)
def test_the_traveller_looks_ahead_and_does_not_twist(seed: int, closed: bool) -> None:
    """Between near places it turns by no more than the way does, but for the rest of a loop's twist."""
    path = wandering(seed, closed=closed)
    along = np.linspace(0, path.length * 0.999, 4001)
    axes = quaternion.to_matrix(path.turns(along))
    ways = path.directions(along)
    assert np.abs(-axes[:, :, 2] - ways).max() < 1e-9
    spun = np.linalg.norm(np.diff(axes, axis=0), axis=(1, 2))
    turned = np.sqrt(2) * np.linalg.norm(np.diff(ways, axis=0), axis=1)
    rest = np.sqrt(2) * math.pi / 4000 if closed else 0.0
    assert (spun <= turned * 1.01 + rest + 1e-6).all()


def test_the_traveller_closes_a_loop_as_it_began() -> None:
    path = wandering(5, closed=True)
    first, last = path.turns([0.0, path.length * (1 - 1e-12)])
    assert abs(first @ last) == pytest.approx(1, abs=1e-9)


def test_any_batch_answers_the_same() -> None:
    path = wandering(7, closed=False)
    along = np.random.default_rng(0).uniform(0, path.length, 50)
    for ask in (path.at, path.turns):
        assert np.array_equal(ask(along)[::-1], np.concatenate([ask([one]) for one in along[::-1]]))


@pytest.mark.parametrize(
    ("places", "sentence"),
    [
        ([(0, 0, 0)], "goes through 1 place"),
        ([(1, 1, 1), (1, 1, 1)], "goes through 1 place"),
        ([(0, 0), (1, 1)], "shape"),
        ([(0, 0, 0), (math.nan, 0, 0)], "not finite"),
    ],
)
def test_places_that_make_no_path_are_refused(places: list[tuple[float, ...]], sentence: str) -> None:
    with pytest.raises(GeometryError, match=sentence):
        Path.through(places)
