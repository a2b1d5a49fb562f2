"""PLY, text and binary: points, polygons, colours, normals and texture places."""

from __future__ import annotations

import numpy as np
import pytest

from eyeline.files import load
from files import good_meshes as good
from files.test_broken_meshes import written


def mesh_of(folder, data):
    return load(written(folder, {"m.ply": data})).nodes[0].mesh


@pytest.mark.parametrize(
    "data", [good.ply_text(), good.ply_binary("<"), good.ply_binary(">")], ids=["text", "<", ">"]
)
def test_pyramid_is_read_whole_with_its_square_ground(tmp_path, data):
    mesh = mesh_of(tmp_path, data)
    np.testing.assert_array_equal(mesh.points[mesh.faces], good.POINTS[good.TRIANGLES])
    assert mesh.materials[0].double_sided


def test_colors_are_linear(tmp_path):
    mesh = mesh_of(tmp_path, good.ply_text())
    np.testing.assert_allclose(mesh.colors, [[1, 0.2158605, 0, 1]] * len(mesh.points), atol=1e-6)


def test_colors_of_fractions_count_up_to_one(tmp_path):
    text = good.ply_text().replace(b"uchar red", b"float red").replace(b"uchar green", b"float green")
    text = text.replace(b"uchar blue", b"float blue").replace(b"255 128 0", b"1 0.5 0")
    np.testing.assert_allclose(mesh_of(tmp_path, text).colors[0], [1, 0.2140, 0, 1], atol=1e-4)


def test_texture_places_run_down_the_image(tmp_path):
    mesh = mesh_of(tmp_path, good.ply_binary())
    np.testing.assert_allclose(mesh.uv[0], np.column_stack([mesh.points[:, 0], 1 - mesh.points[:, 2]]))


def test_normals_of_the_file_are_kept(tmp_path):
    head = "ply\nformat ascii 1.0\nelement vertex 3\n" + "".join(
        f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz")
    )
    head += "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    body = "0 0 0 0 0 1\n1 0 0 0.6 0 0.8\n0 1 0 0 0 1\n3 0 1 2\n"
    mesh = mesh_of(tmp_path, (head + body).encode())
    np.testing.assert_allclose(mesh.normals[mesh.faces][0], [[0, 0, 1], [0.6, 0, 0.8], [0, 0, 1]], atol=1e-6)


def test_elements_that_are_not_known_are_stepped_over(tmp_path):
    text = good.ply_text().replace(b"element face", b"element camera 1\nproperty float view\nelement face")
    text = text.replace(b"4 0 1 2 3\n", b"42\n4 0 1 2 3\n")
    assert len(mesh_of(tmp_path, text).faces) == 6


def test_another_program_s_files_agree(tmp_path):
    trimesh = pytest.importorskip("trimesh")
    from trimesh.exchange.ply import export_ply

    ball = trimesh.creation.icosphere(subdivisions=2)
    for encoding in ("ascii", "binary"):
        mesh = mesh_of(tmp_path, export_ply(ball, encoding=encoding))
        np.testing.assert_allclose(mesh.points[mesh.faces], ball.vertices[ball.faces], atol=1e-6)
