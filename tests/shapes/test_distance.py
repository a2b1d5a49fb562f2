"""Signed distances on a grid are those of brute force."""

from __future__ import annotations

import numpy as np
import pytest

import eyeline as el
from eyeline.geometry.arrays import read_only
from eyeline.geometry.bounds import Bounds
from eyeline.geometry.bvh import bvh_of
from eyeline.geometry.nearest import nearest
from eyeline.shapes.distance import BAND, signed_distance
from eyeline.shapes.grid import Grid
from shapes.bodies import block, sphere

BODIES = {"sphere": sphere(0.5), "block": block((1, 0.5, 0.8)), "torus": el.samples.torus().surfaces[0].mesh}


def grid_points(grid: Grid) -> np.ndarray:
    return grid.low + grid.step * np.stack(np.indices(grid.counts), axis=-1).reshape(-1, 3)


@pytest.mark.parametrize("name", BODIES)
def test_distances_are_exact_near_the_surface_and_nearly_so_farther_out(name: str) -> None:
    mesh = BODIES[name]
    grid = Grid.around(Bounds.of(mesh.points), 40)
    found = signed_distance(grid, mesh.points, mesh.faces)
    exact = nearest(bvh_of(read_only(mesh.points), mesh.faces), grid_points(grid)).distance
    close = exact < BAND * grid.step
    np.testing.assert_allclose(np.abs(found)[close], exact[close], atol=1e-5 * grid.step)
    np.testing.assert_allclose(np.abs(found), exact, atol=grid.step / 5)
    assert (np.abs(found) >= exact - 1e-5 * grid.step).all()


def test_signs_tell_inside_from_outside() -> None:
    mesh = BODIES["block"]
    grid = Grid.around(Bounds.of(mesh.points), 40)
    away = np.abs(grid_points(grid)) - mesh.bounds.high
    found = signed_distance(grid, mesh.points, mesh.faces)
    clear = np.abs(away.max(axis=1)) > 1e-3 * grid.step
    np.testing.assert_array_equal(found[clear] < 0, away.max(axis=1)[clear] < 0)


def test_the_grid_may_be_where_the_surface_is() -> None:
    """Faces that lie in planes of the grid, and edges along its rows: each row still has one answer."""
    mesh = block((10, 10, 10))
    grid = Grid(np.full(3, -8.0), 1.0, (17, 17, 17))
    found = signed_distance(grid, mesh.points, mesh.faces)
    assert (found < 0).sum() in range(9**3, 11**3 + 1)
    np.testing.assert_allclose(found.reshape(grid.counts)[8, 8], np.abs(np.arange(-8, 9)) - 5, atol=1e-5)
