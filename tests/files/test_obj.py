"""OBJ and MTL: the shape, the materials, and the order of the file."""

from __future__ import annotations

import numpy as np
import pytest

from data import data
from eyeline.files import load
from files import good_meshes as good
from files.test_broken_meshes import written

POINTS = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


def scene_of(folder, text, **files):
    content = {name.replace("_", "."): part for name, part in files.items()}
    return load(written(folder, {"m.obj": text.encode()} | content))


def corners(mesh):
    """(F, 3, 3) where the corners of the faces are."""
    return mesh.points[mesh.faces]


def test_pyramid_is_read_whole(tmp_path):
    scene = load(written(tmp_path, good.obj()))
    (node,) = scene.nodes
    np.testing.assert_array_equal(corners(node.mesh), good.POINTS[good.TRIANGLES])
    assert node.name == "pyramid"
    assert scene.notes == ("1 points, lines and curved surfaces are not drawn",)
    assert [material.name for material in node.mesh.materials] == ["stone", "sand"]
    np.testing.assert_array_equal(node.mesh.face_material, [0, 0, 1, 1, 1, 1])


def test_materials_become_metallic_roughness(tmp_path):
    stone, sand = load(written(tmp_path, good.obj())).nodes[0].mesh.materials
    np.testing.assert_allclose(stone.base_color, (0.2140, 0.2140, 0.2140, 1), atol=1e-4)  # sRGB 0.5
    assert 0.3 < stone.roughness < 0.5 and stone.double_sided
    assert sand.base_color == pytest.approx((1, 1, 1, 0.5)) and sand.alpha_mode == "blend"
    assert sand.base_color_texture.texture.pixels.shape == (4, 4, 4)
    assert sand.base_color_texture.scale == (2, 2)


def test_v_of_textures_runs_down_the_image(tmp_path):
    text = POINTS + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n"
    mesh = scene_of(tmp_path, text).nodes[0].mesh
    found = {tuple(point[:2]): tuple(place) for point, place in zip(mesh.points, mesh.uv[0], strict=True)}
    assert found == {(0, 0): (0, 1), (1, 0): (1, 1), (1, 1): (1, 0), (0, 1): (0, 0)}


@pytest.mark.parametrize(
    ("scale", "offset"), [((2, 3), (0, 0)), ((1, 1), (0.25, 0.5)), ((2, 0.5), (0.1, 0.2))]
)
def test_texture_options_say_the_same_with_v_down(tmp_path, scale, offset):
    text = f"newmtl a\nmap_Kd -o {offset[0]} {offset[1]} -s {scale[0]} {scale[1]} -clamp on a b.png\n"
    folder = tmp_path
    (folder / "a b.png").write_bytes(good.png())
    model = "mtllib a.mtl\nusemtl a\n" + POINTS + "f 1 2 3\n"
    slot = scene_of(folder, model, a_mtl=text.encode()).nodes[0].mesh.materials[0].base_color_texture
    up = np.array([[0.3, 0.4], [0.9, 0.1]])
    down = np.column_stack([up[:, 0], 1 - up[:, 1], np.ones(2)]) @ slot.texture_from_uv.T
    np.testing.assert_allclose(np.column_stack([down[:, 0], 1 - down[:, 1]]), up * scale + offset)
    assert slot.texture.wrap == ("clamp", "clamp")


def test_corner_has_its_own_place_in_the_texture(tmp_path):
    text = POINTS + "vt 0 0\nvt 1 0\nvt 0.5 1\nf 1/1 2/2 3/3\nf 1/3 3/2 4/1\n"
    mesh = scene_of(tmp_path, text).nodes[0].mesh
    np.testing.assert_allclose(mesh.uv[0][mesh.faces][1], [[0.5, 0], [1, 1], [0, 1]])
    assert len(mesh.points) == 6


def test_numbers_count_back_from_where_they_stand(tmp_path):
    text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 5\nv 1 0 5\nv 0 1 5\nf -3 -2 -1\n"
    mesh = scene_of(tmp_path, text).nodes[0].mesh
    assert corners(mesh)[:, 0, 2].tolist() == [0, 5]


def test_faces_keep_the_order_of_the_file_over_materials(tmp_path):
    text = POINTS + "usemtl a\nf 1 2 3\nusemtl b\nf 2 3 4\nusemtl a\nf 3 4 1\n"
    (node,) = scene_of(tmp_path, text).nodes
    np.testing.assert_array_equal(corners(node.mesh)[:, 0, :2], [(0, 0), (1, 0), (1, 1)])
    np.testing.assert_array_equal(node.mesh.face_material, [0, 1, 0])


def test_objects_become_nodes_and_groups_do_where_there_are_none(tmp_path):
    objects = POINTS + "o a\ng x\nf 1 2 3\ng y\nf 2 3 4\no b\nf 3 4 1\n"
    assert [node.name for node in scene_of(tmp_path / "1", objects).nodes] == ["a", "b"]
    groups = POINTS + "g x\nf 1 2 3\ng y\nf 2 3 4\n"
    assert [node.name for node in scene_of(tmp_path / "2", groups).nodes] == ["x", "y"]


def test_polygon_that_is_not_convex_is_cut_inside_itself(tmp_path):
    # An L: a fan about its first corner would cover the notch
    text = "v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nf 1 2 3 4 5 6\n"
    mesh = scene_of(tmp_path, text).nodes[0].mesh
    a, b, c = (corners(mesh)[:, k] for k in range(3))
    areas = np.cross(b - a, c - a)[:, 2] / 2
    assert (areas > 0).all() and areas.sum() == pytest.approx(3)
    middles = corners(mesh).mean(axis=1)
    assert not ((middles[:, 0] > 1) & (middles[:, 1] > 1)).any()


def test_normals_of_the_file_are_kept(tmp_path):
    text = POINTS + "vn 0 0 2\nvn 3 0 4\nf 1//1 2//2 3//1\n"
    mesh = scene_of(tmp_path, text).nodes[0].mesh
    np.testing.assert_allclose(mesh.normals[mesh.faces][0], [[0, 0, 1], [0.6, 0, 0.8], [0, 0, 1]], atol=1e-6)


def test_colors_of_points_are_read(tmp_path):
    text = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 0.5\nf 1 2 3\n"
    mesh = scene_of(tmp_path, text).nodes[0].mesh
    np.testing.assert_allclose(mesh.colors, [[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 0.2140, 1]], atol=1e-4)


def test_missing_library_and_picture_are_noted(tmp_path):
    model = "mtllib a.mtl\nusemtl a\n" + POINTS + "f 1 2 3\n"
    assert "material library 'a.mtl' is not beside the model" in scene_of(tmp_path / "1", model).notes[0]
    scene = scene_of(tmp_path / "2", model, a_mtl=b"newmtl a\nmap_Kd gone.png\n")
    assert "'gone.png', which is not beside the model" in scene.notes[0]


def test_link_out_of_the_folder_is_refused(tmp_path):
    secret = tmp_path / "secret.mtl"
    secret.write_text("newmtl a\nKd 1 0 0\n")
    folder = tmp_path / "model"
    folder.mkdir()
    (folder / "a.mtl").symlink_to(secret)
    with pytest.raises(Exception, match="leads out of the model's folder"):
        scene_of(folder, "mtllib a.mtl\n" + POINTS + "f 1 2 3\n")


def test_continued_lines_comments_and_windows_line_ends_are_read(tmp_path):
    text = POINTS.replace("\n", "\r\n") + "f 1 2 \\\r\n 3 # a face\r\n"
    assert len(scene_of(tmp_path, text).nodes[0].mesh.faces) == 1


MODELS = [
    ("spot.obj", 5856, 2930), ("cow.obj", 5804, 2903), ("teapot.obj", 6320, 3241),
    ("fandisk.obj", 5750, 2877),
    ("stanford-bunny.obj", 69451, 34834), ("suzanne.obj", 968, 505), ("not_convex.obj", 96, 44),
]  # fmt: skip


@pytest.mark.parametrize(("name", "faces", "places"), MODELS)
def test_real_models_have_their_counts(name, faces, places):
    scene = load(data(f"mesh/{name}"))
    mesh = scene.surfaces[0].mesh
    assert (scene.face_count, len(np.unique(mesh.points, axis=0))) == (faces, places)
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-5)


@pytest.mark.parametrize("name", ["spot.obj", "cow.obj", "fandisk.obj"])
def test_real_models_agree_with_another_reader(name):
    trimesh = pytest.importorskip("trimesh")
    other = trimesh.load(data(f"mesh/{name}"), process=False, maintain_order=True)
    mesh = load(data(f"mesh/{name}")).surfaces[0].mesh
    np.testing.assert_allclose(corners(mesh), other.vertices[other.faces], rtol=1e-6, atol=1e-6)
