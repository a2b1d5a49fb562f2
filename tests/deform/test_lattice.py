import math

import numpy as np
import pytest

from eyeline.deform.lattice import Lattice
from eyeline.errors import GeometryError

RNG = np.random.default_rng(0)
POINTS = RNG.uniform(-0.7, 0.7, (500, 3))
INSIDE = np.clip(POINTS, -0.5, 0.5)
both = pytest.mark.parametrize("basis", ["bernstein", "bspline"])


def bernstein(count: int, u: np.ndarray) -> np.ndarray:
    n = count - 1
    return np.stack([math.comb(n, i) * u**i * (1 - u) ** (n - i) for i in range(count)])


def test_bernstein_is_the_trivariate_sum() -> None:
    lattice = Lattice(RNG.normal(size=(3, 5, 4, 3)))
    weights = [bernstein(count, INSIDE[:, axis] + 0.5) for axis, count in enumerate((3, 5, 4))]
    moved = np.einsum("iv,jv,kv,ijkr->vr", *weights, lattice.offsets)
    assert np.abs(lattice(INSIDE)[0] - (INSIDE + moved)).max() <= 1e-14


@both
@pytest.mark.parametrize("resolution", [(2, 2, 2), (4, 4, 4), (7, 3, 9)])
def test_at_rest_it_is_the_identity_to_the_bit(basis: str, resolution: tuple[int, int, int]) -> None:
    lattice = Lattice.around(POINTS, resolution, basis=basis)
    assert lattice(POINTS)[0] is POINTS
    assert lattice.to(lattice.points)(POINTS)[0] is POINTS


@both
def test_all_points_moved_alike_move_the_shape(basis: str) -> None:
    lattice = Lattice(np.broadcast_to((0.5, -0.25, 2.0), (4, 3, 6, 3)), basis=basis)
    assert np.abs(lattice(POINTS)[0] - (POINTS + np.array([0.5, -0.25, 2.0]))).max() <= 1e-14


def test_control_points_scaled_scale_the_box() -> None:
    lattice = Lattice.of((4, 3, 5))
    scaled = lattice.to(lattice.rest * (2, 0.5, -1))
    assert np.abs(scaled(INSIDE)[0] - INSIDE * (2, 0.5, -1)).max() <= 1e-14


def test_a_fading_lattice_lets_go_of_what_is_far() -> None:
    lattice = Lattice(RNG.normal(size=(3, 3, 3, 3)), fade=0.1)
    away = np.linalg.norm(POINTS - INSIDE, axis=1)
    moved, _, _ = lattice(POINTS)
    assert np.array_equal(moved[away >= 0.1], POINTS[away >= 0.1])
    assert (moved[away < 0.05] != POINTS[away < 0.05]).all()


@both
def test_without_a_fade_the_border_is_where_it_ends(basis: str) -> None:
    lattice = Lattice(RNG.normal(size=(3, 3, 3, 3)), basis=basis, fade=0.0)
    outside = (POINTS != INSIDE).any(axis=1)
    assert np.array_equal(lattice(POINTS)[0][outside], POINTS[outside])
    whole = Lattice(lattice.offsets, basis=basis)
    assert np.array_equal(lattice(POINTS)[0][~outside], whole(POINTS)[0][~outside])


def test_around_a_flat_sheet_there_is_room() -> None:
    sheet = POINTS * (1, 0, 1)
    assert np.isfinite(
        Lattice.around(sheet, (2, 2, 2)).changed({"offsets": np.ones((2, 2, 2, 3))})(sheet)[0]
    ).all()


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        (
            {"offsets": np.zeros((1, 1, 1, 3))},
            "lattice is 1 x 1 x 1; 2 points or more along three axes are needed",
        ),
        ({"offsets": np.zeros((4, 4, 3))}, "lattice is 4 x 4 x 3; 2 points"),
        ({"basis": "bezier"}, "basis is 'bezier'; there are bernstein, bspline"),
        ({"upper": (0.5, -0.5, 0.5)}, "has no room inside"),
        ({"fade": -1.0}, "fade is -1; it must be 0 or more"),
    ],
)
def test_lattices_that_cannot_be_are_refused(values: dict[str, object], sentence: str) -> None:
    with pytest.raises(GeometryError) as refusal:
        Lattice(**values)  # type: ignore[arg-type]
    assert sentence in str(refusal.value)
