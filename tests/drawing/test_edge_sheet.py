"""Visible edges as a drawing."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np

import eyeline as el
from eyeline.drawing.edge_sheet import sheet_of_edges
from eyeline.drawing.svg import svg_of
from eyeline.projection import project


def cubes():
    scene = el.Scene.of(el.Node("one", mesh=el.samples.cube().nodes[0].mesh), el.Node("none"))
    view = project(scene, el.Camera.look_at((3, 2, 4), (0, 0, 0)), (320, 180))
    return scene, el.METHODS["roberts"](view)


def test_a_cube_s_sheet_has_its_seen_edges_and_its_hidden_ones_if_asked() -> None:
    scene, edges = cubes()
    (seen,) = sheet_of_edges(edges, scene.paths).groups
    assert (seen.node, seen.seen, len(seen.paths)) == ("one", True, 9)
    below, above = sheet_of_edges(edges, scene.paths, hidden=True).groups
    assert (below.seen, len(below.paths), above.seen) == (False, 3, True)
    assert below.pen.dash and not above.pen.dash
    places = np.concatenate([np.stack(group.paths) for group in (above, below)]) / 100
    np.testing.assert_allclose(places, np.concatenate([edges.segments, edges.hidden]), atol=0.005)


def test_the_sheet_becomes_svg() -> None:
    scene, edges = cubes()
    root = ET.fromstring(svg_of(sheet_of_edges(edges, scene.paths, hidden=True, title="a cube")))
    assert root.get("width") == "320"
    drawn = "".join(path.get("d", "") for path in root.iter("{http://www.w3.org/2000/svg}path"))
    assert drawn.upper().count("M") == 12
