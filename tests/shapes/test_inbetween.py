"""What every way from shape to shape promises."""

from __future__ import annotations

import numpy as np
import pytest

import eyeline as el
from eyeline.errors import GeometryError, OptionError
from eyeline.shapes import WAYS
from shapes.bodies import bar, block, moved, sphere, turned

ENDS = {name: (bar(), moved(bar(), turned(bar().points, 1.0))) for name in WAYS}


@pytest.mark.parametrize("way", WAYS)
def test_any_order_of_times_gives_the_same_bytes(way: str) -> None:
    parts = (0.0, 0.3, 1.0, 0.7)
    forth = [el.inbetween(*ENDS[way], way=way).at(part).points.tobytes() for part in parts]
    again = el.inbetween(*ENDS[way], way=way)
    back = [again.at(part).points.tobytes() for part in parts[::-1]][::-1]
    assert forth == back


@pytest.mark.parametrize("way", [name for name, way in WAYS.items() if way.same_faces])
def test_the_ends_are_the_shapes_themselves(way: str) -> None:
    start, end = ENDS[way]
    between = el.inbetween(start, end, way=way)
    np.testing.assert_allclose(between.at(0).points, start.points, atol=1e-6)
    np.testing.assert_allclose(between.at(1).points, end.points, atol=1e-6)
    np.testing.assert_array_equal(between.at(0.5).faces, start.faces)


@pytest.mark.parametrize("way", WAYS)
def test_colours_mix_on_the_way(way: str) -> None:
    red, blue = (el.Material(name, colour) for name, colour in (("r", (1, 0, 0, 1)), ("b", (0, 0, 1, 0.5))))
    start, end = (mesh.with_material(paint) for mesh, paint in zip(ENDS[way], (red, blue), strict=True))
    between = el.inbetween(start, end, way=way)
    assert between.at(0).materials[0].base_color == (1, 0, 0, 1)
    np.testing.assert_allclose(between.at(1).materials[0].base_color, (0, 0, 1, 0.5), atol=1e-12)
    middle = between.at(0.5).materials[0].base_color
    assert 0 < middle[0] < 1 and 0 < middle[2] < 1 and middle[3] == 0.75


@pytest.mark.parametrize("way", WAYS)
def test_a_scene_is_a_shape(way: str) -> None:
    scene = el.Scene.of(
        el.Node("left", translation=(-1, 0, 0), mesh=block((1, 1, 1))),
        el.Node("right", mesh=block((1, 2, 1))),
    )
    middle = el.inbetween(scene, scene, way=way).at(0.5)
    np.testing.assert_allclose(middle.bounds.low, (-1.5, -1, -0.5), atol=0.02)
    np.testing.assert_allclose(middle.bounds.high, (0.5, 1, 0.5), atol=0.02)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("part", [float("nan"), float("inf")])
def test_a_part_that_is_no_number_is_refused(way: str, part: float) -> None:
    with pytest.raises(OptionError, match="the part of the way is"):
        el.inbetween(*ENDS[way], way=way).at(part)


@pytest.mark.parametrize("way", WAYS)
def test_an_empty_shape_is_refused(way: str) -> None:
    with pytest.raises(GeometryError, match="has no faces"):
        el.inbetween(el.Mesh([(0, 0, 0)], np.zeros((0, 3), int)), sphere(1), way=way)
    with pytest.raises(GeometryError, match="no visible mesh"):
        el.inbetween(sphere(1), el.Scene.of(el.Node("empty")), way=way)


def test_other_faces_are_refused_with_the_way_out() -> None:
    with pytest.raises(GeometryError, match=r"faces; the same are needed in both, or way='level_set'"):
        el.inbetween(sphere(1, rings=16), sphere(1, rings=20), way="rigid")
    mesh = bar()
    with pytest.raises(GeometryError, match=r"face 0 joins vertices .* or way='level_set'"):
        el.inbetween(mesh, el.Mesh(mesh.points, mesh.faces[::-1]))


def test_ways_and_options_that_are_not_there_are_refused() -> None:
    with pytest.raises(OptionError, match="there is no way 'magic'; there is linear, rigid, level_set"):
        el.inbetween(sphere(1), sphere(1), way="magic")
    with pytest.raises(OptionError, match="Linear has no option 'cells'; it has none"):
        el.inbetween(sphere(1), sphere(1), cells=3)
    with pytest.raises(OptionError, match="LevelSet has no option 'cell'; it has align, cells"):
        el.inbetween(sphere(1), sphere(1), way="level_set", cell=3)
