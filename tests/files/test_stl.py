"""STL, binary and text: triangles become a surface with crisp edges."""

from __future__ import annotations

import numpy as np
import pytest

from data import data
from eyeline.files import load
from eyeline.files.meshes.stl import HEADER, TRIANGLE
from eyeline.geometry.weld import welded
from files import good_meshes as good
from files.test_broken_meshes import written


@pytest.mark.parametrize("content", [good.stl_binary(), good.stl_text()], ids=["binary", "text"])
def test_pyramid_is_read_whole(tmp_path, content):
    mesh = load(written(tmp_path, {"m.stl": content})).nodes[0].mesh
    np.testing.assert_array_equal(mesh.points[mesh.faces], good.POINTS[good.TRIANGLES])
    # All edges of the pyramid are sharp: four corners of the ground, and three of each side
    assert len(mesh.points) == 4 + 4 * 3


def test_round_surface_becomes_smooth(tmp_path):
    trimesh = pytest.importorskip("trimesh")
    ball = trimesh.creation.icosphere(subdivisions=3)
    mesh = load(written(tmp_path, {"m.stl": ball.export(file_type="stl")})).nodes[0].mesh
    assert len(mesh.points) == len(ball.vertices)
    np.testing.assert_allclose(mesh.normals, mesh.points, atol=0.01)


def test_bytes_after_the_last_triangle_are_noted(tmp_path):
    scene = load(written(tmp_path, {"m.stl": good.stl_binary() + b"made by hand"}))
    assert scene.notes == ("12 bytes after the last triangle are left out",)
    assert scene.face_count == 6


def test_solids_of_a_text_file_become_nodes(tmp_path):
    text = good.stl_text() + good.stl_text().replace(b"Pyramid", b"Second")
    scene = load(written(tmp_path, {"m.stl": text}))
    assert [node.name for node in scene.nodes] == ["Pyramid", "Second"]


def test_soup_of_triangles_is_kept_as_it_is():
    scene = load(data("mesh/soup.stl"))
    assert scene.face_count == 100
    assert len(scene.nodes[0].mesh.points) == 300


def test_busted_model_is_closed_though_its_own_normals_are_zero():
    """What is busted are the file's normals, all 0 0 0, and its suffix is in capitals."""
    path = data("mesh/busted.STL")
    assert not np.frombuffer(path.read_bytes(), TRIANGLE, offset=HEADER)["normal"].any()
    mesh = load(path).nodes[0].mesh
    first, index = welded(mesh.points)
    faces, points = index[mesh.faces], mesh.points[first]
    edges = np.sort(np.concatenate([faces[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    _, counts = np.unique(edges, axis=0, return_counts=True)
    assert (counts == 2).all()
    assert len(points) - len(counts) + len(faces) == 2
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-5)
