"""3MF: objects, where the build places them, in metres and upright."""

from __future__ import annotations

import numpy as np

from eyeline.files import load
from files import good_meshes as good
from files.broken_meshes import multiplied
from files.test_broken_meshes import written

ITEMS = '<item objectid="1"/><item objectid="1" transform="1 0 0 0 1 0 0 0 1 2000 0 0"/>'


def scene_of(folder, model=None):
    return load(written(folder, {"m.3mf": good.threemf(model)}))


def test_pyramid_is_in_metres_and_its_z_is_up(tmp_path):
    scene = scene_of(tmp_path)
    x, y, z = good.POINTS.T
    expected = np.stack([x, z, -y], axis=1)
    np.testing.assert_allclose(scene.bounds.low, expected.min(axis=0), atol=1e-6)
    np.testing.assert_allclose(scene.bounds.high, expected.max(axis=0), atol=1e-6)
    assert scene.face_count == 6


def test_inches_become_metres(tmp_path):
    model = good.model_3mf().replace('unit="millimeter"', 'unit="inch"')
    np.testing.assert_allclose(scene_of(tmp_path, model).bounds.high[0], 25.4, rtol=1e-6)


def test_item_placed_twice_stands_twice(tmp_path):
    scene = scene_of(tmp_path, good.model_3mf(items=ITEMS))
    assert scene.face_count == 12
    np.testing.assert_allclose(scene.bounds.high[0], 3, rtol=1e-6)
    assert scene.nodes[1].mesh is scene.nodes[2].mesh


def test_objects_of_objects_are_placed(tmp_path):
    scene = load(written(tmp_path, {"m.3mf": multiplied(3)}))
    assert scene.face_count == 8 * 6


def test_colours_are_noted(tmp_path):
    colours = '<basematerials id="9"><base name="red" displaycolor="#FF0000"/></basematerials>'
    scene = scene_of(tmp_path, good.model_3mf(components=colours))
    assert scene.notes == ("colours of 3MF files are not read; all is grey",)
