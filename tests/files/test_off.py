"""OFF: points and polygons."""

from __future__ import annotations

import numpy as np

from eyeline.files import load
from files import good_meshes as good
from files.test_broken_meshes import written


def mesh_of(folder, content):
    return load(written(folder, {"m.off": content})).nodes[0].mesh


def test_pyramid_is_read_whole_in_order(tmp_path):
    mesh = mesh_of(tmp_path, good.off())
    np.testing.assert_array_equal(mesh.points[mesh.faces], good.POINTS[good.TRIANGLES])


def test_counts_may_stand_beside_the_word(tmp_path):
    mesh = mesh_of(tmp_path, good.off().replace(b"OFF\n# a pyramid\n", b"OFF "))
    assert len(mesh.faces) == 6


def test_colors_of_points_are_linear(tmp_path):
    text = "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 128 0 255\n0 1 0 0 0 0 128\n3 0 1 2\n"
    mesh = mesh_of(tmp_path, text.encode())
    np.testing.assert_allclose(
        mesh.colors, [[1, 0, 0, 1], [0, 0.2158605, 0, 1], [0, 0, 0, 128 / 255]], atol=1e-6
    )
