"""Level sets: known shapes between known shapes, and a stated error."""

from __future__ import annotations

import numpy as np
import pytest

import eyeline as el
from eyeline.errors import GeometryError, OptionError
from eyeline.scene.topology import build
from eyeline.shapes.level_set import LevelSet
from eyeline.shapes.winding import volume
from shapes.bodies import block, sphere

CELLS = 48


@pytest.mark.parametrize("part", [0.0, 0.25, 0.5, 1.0])
def test_between_spheres_about_one_point_the_radius_goes_straight(part: float) -> None:
    between = LevelSet(sphere(0.5), sphere(1.0), cells=CELLS)
    middle = between.at(part)
    radius = np.linalg.norm(middle.points, axis=1)
    np.testing.assert_allclose(radius, 0.5 + 0.5 * part, atol=between.cell / 10)
    np.testing.assert_allclose(middle.normals, middle.points / radius[:, None], atol=0.1)


def test_the_first_and_the_last_shape_are_within_the_stated_error() -> None:
    between = LevelSet(sphere(0.5), block((1, 1, 1)), cells=CELLS)
    first, last = between.error
    assert first.mean < between.cell / 50 and first.largest < between.cell / 5
    # An edge is cut by at most a cell's diagonal
    assert last.mean < between.cell / 10 and last.missed < between.cell * np.sqrt(3)


@pytest.mark.parametrize("part", [0.0, 0.5, 1.0])
def test_what_comes_out_is_closed_and_turns_outwards(part: float) -> None:
    middle = LevelSet(el.samples.torus(), sphere(0.4), cells=CELLS).at(part)
    assert len(build(middle).open_edges) == 0
    assert volume(middle.points, middle.faces) > 0


def test_a_ring_closes_its_hole_on_the_way_to_a_ball() -> None:
    """V - E + F is 0 of a ring and 2 of a ball."""
    between = LevelSet(el.samples.torus(), sphere(0.4), cells=CELLS)

    def euler(mesh: el.Mesh) -> int:
        return len(mesh.points) - len(mesh.faces) // 2

    assert euler(between.at(0)) == 0
    assert euler(between.at(1)) == 2


def test_parts_that_overlap_are_one_body() -> None:
    pair = el.Scene.of(
        el.Node("low", mesh=block((1, 1, 1))),
        el.Node("high", translation=(0.3, 0.6, 0), mesh=block((1, 1, 1))),
    )
    once = LevelSet(pair, pair, cells=CELLS).at(0.5)
    assert volume(once.points, once.faces) == pytest.approx(2 - 0.7 * 0.4, rel=0.02)
    assert len(np.unique(build(once).part)) == 1


def test_a_small_hole_does_not_empty_a_body() -> None:
    ball = sphere(1.0)
    torn = el.Mesh(
        ball.points, ball.faces[np.abs(ball.points[ball.faces].mean(axis=1) - (0, 1, 0)).max(axis=1) > 0.2]
    )
    assert len(torn.faces) < len(ball.faces)
    closed = LevelSet(torn, torn, cells=CELLS).at(0)
    assert volume(closed.points, closed.faces) == pytest.approx(volume(ball.points, ball.faces), rel=0.02)


def test_a_body_that_is_inside_out_is_a_body() -> None:
    ball = sphere(0.5)
    inner = el.Mesh(ball.points, ball.faces[:, ::-1])
    np.testing.assert_array_equal(
        LevelSet(inner, ball, cells=CELLS).at(0).points, LevelSet(ball, ball, cells=CELLS).at(0).points
    )


@pytest.mark.parametrize("align", ["centre", "box"])
def test_aligned_shapes_move_and_grow_evenly(align: str) -> None:
    """Two spheres apart are one sphere on its way: growing by equal factors."""
    between = LevelSet(sphere(0.5), sphere(2.0, (10, 0, 0)), cells=CELLS, align=align)
    middle = between.at(0.5)
    np.testing.assert_allclose(np.linalg.norm(middle.points - (5, 0, 0), axis=1), 1.0, atol=0.02)


def test_shapes_apart_must_be_aligned() -> None:
    with pytest.raises(GeometryError, match=r"nothing is left at part 0.5 .* align them"):
        LevelSet(sphere(0.5), sphere(0.5, (10, 0, 0)), cells=128).at(0.5)


def test_what_encloses_nothing_is_refused() -> None:
    sheet = el.Mesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)])
    with pytest.raises(GeometryError, match="encloses nothing on a grid of 48 points"):
        LevelSet(sheet, sphere(1), cells=CELLS).at(0)


def test_a_mere_point_is_refused() -> None:
    point = el.Mesh(np.zeros((3, 3)), [(0, 1, 2)])
    with pytest.raises(GeometryError, match="the shapes are but a point"):
        LevelSet(point, point)
    with pytest.raises(GeometryError, match="has no area, so it has no centre to align"):
        LevelSet(sphere(1), point, align="centre")


def test_options_out_of_range_are_refused() -> None:
    with pytest.raises(OptionError, match="cells is 4; 8 to 384"):
        LevelSet(sphere(1), sphere(1), cells=4)
    with pytest.raises(OptionError, match="align is 'left'; there is none, centre, box"):
        LevelSet(sphere(1), sphere(1), align="left")
    with pytest.raises(OptionError, match=r"the part of the way is 1.5; level sets go from 0 to 1"):
        LevelSet(sphere(1), sphere(1), cells=CELLS).at(1.5)
