"""Faces of every mode, primitives joined into one mesh, and what is filled in."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from eyeline.files import load
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from files.gltf_builder import SQUARE, SQUARE_FACES, Builder, floats
from files.images import png

ALONG_Z = np.tile(floats([0, 0, 1]), (4, 1))
ZIGZAG = floats([0, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 0], [2, 0, 0])


def loaded(builder: Builder, folder: Path) -> Scene:
    builder.node(mesh=0)
    return load(builder.write(folder))


def mesh_of(builder: Builder, folder: Path) -> Mesh:
    mesh = loaded(builder, folder).nodes[0].mesh
    assert mesh is not None
    return mesh


def area_vectors(mesh: Mesh) -> np.ndarray:
    a, b, c = (mesh.points[mesh.faces[:, k]].astype(float) for k in range(3))
    return np.cross(b - a, c - a) / 2


# --- modes ----------------------------------------------------------------------------------------------


def test_the_faces_of_a_strip_all_turn_the_same_way(tmp_path: Path) -> None:
    builder = Builder()
    builder.mesh({"POSITION": ZIGZAG[[1, 0, 3, 2, 4]]}, mode=5)
    mesh = mesh_of(builder, tmp_path)
    assert mesh.faces.tolist() == [[0, 1, 2], [1, 3, 2], [2, 3, 4]]
    assert (area_vectors(mesh)[:, 2] > 0).all()


def test_the_faces_of_a_fan_share_its_first_corner(tmp_path: Path) -> None:
    builder = Builder()
    builder.mesh({"POSITION": floats([0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [-1, 1, 0])}, mode=6)
    mesh = mesh_of(builder, tmp_path)
    assert np.sort(mesh.faces, axis=1).tolist() == [[0, 1, 2], [0, 2, 3], [0, 3, 4]]
    assert (area_vectors(mesh)[:, 2] > 0).all()


@pytest.mark.parametrize(
    ("mode", "kind"), [(0, "points"), (1, "lines"), (2, "a line loop"), (3, "a line strip")]
)
def test_points_and_lines_are_reported_not_drawn(tmp_path: Path, mode: int, kind: str) -> None:
    builder = Builder()
    builder.square(mode=mode)
    builder.json["meshes"][0]["name"] = "wires"
    scene = loaded(builder, tmp_path)
    assert scene.face_count == 0
    assert scene.notes[0] == f"mesh 'wires' has {kind}, which are not drawn"
    assert scene.notes[-1] == "the scene has no mesh with faces; there is nothing to draw"


def test_corners_left_over_are_reported(tmp_path: Path) -> None:
    builder = Builder()
    builder.mesh({"POSITION": SQUARE}, np.array([0, 1, 2, 3], np.uint8))
    scene = loaded(builder, tmp_path)
    assert scene.face_count == 1
    assert scene.notes == ("mesh 'mesh 0' has 1 corners left over that make no face",)


# --- several primitives ---------------------------------------------------------------------------------


def primitive(builder: Builder, shift: float, **more: Any) -> dict[str, Any]:
    values = more.pop("attributes", {})
    arrays = {"POSITION": SQUARE + np.float32(shift), **values}
    attributes = {name: builder.accessor(array) for name, array in arrays.items()}
    return {"attributes": attributes, "indices": builder.accessor(SQUARE_FACES), **more}


def test_primitives_become_one_mesh_with_a_material_a_face(tmp_path: Path) -> None:
    builder = Builder()
    for name in ("red", "green"):
        builder.add("materials", name=name)
    parts = [
        primitive(builder, 0, material=1),
        primitive(builder, 5, material=0),
        primitive(builder, 9, material=1),
    ]
    builder.add("meshes", primitives=parts, name="trio")
    mesh = mesh_of(builder, tmp_path)
    assert mesh.name == "trio"
    assert [material.name for material in mesh.materials] == ["green", "red"]
    assert mesh.face_material.tolist() == [0, 0, 1, 1, 0, 0]
    assert mesh.points[mesh.faces].min(axis=(1, 2)).tolist() == [0, 0, 5, 5, 9, 9]


def test_primitives_that_share_vertices_keep_them_shared(tmp_path: Path) -> None:
    builder = Builder()
    points = builder.accessor(SQUARE)
    halves = [np.array([0, 1, 2], np.uint8), np.array([0, 2, 3], np.uint8)]
    parts = [{"attributes": {"POSITION": points}, "indices": builder.accessor(half)} for half in halves]
    builder.add("meshes", primitives=parts)
    mesh = mesh_of(builder, tmp_path)
    assert len(mesh.points) == 4
    assert mesh.faces.tolist() == [[0, 1, 2], [0, 2, 3]]


def test_vertices_no_face_uses_are_dropped_where_they_are_many(tmp_path: Path) -> None:
    builder = Builder()
    far = np.concatenate([np.full((90, 3), 7, np.float32), SQUARE])
    builder.mesh({"POSITION": far}, SQUARE_FACES + np.uint16(90))
    mesh = mesh_of(builder, tmp_path)
    assert mesh.points.tolist() == SQUARE.tolist()
    assert mesh.faces.tolist() == [[0, 1, 2], [0, 2, 3]]


def test_what_one_primitive_has_is_filled_in_for_the_other(tmp_path: Path) -> None:
    builder = Builder()
    rich = {
        "NORMAL": ALONG_Z,
        "TEXCOORD_0": SQUARE[:, :2] + np.float32(0.5),
        "TEXCOORD_1": SQUARE[:, :2],
        "COLOR_0": np.full((4, 4), 0.25, np.float32),
    }
    tilted = SQUARE[:, [2, 0, 1]]
    plain = primitive(builder, 0)
    plain["attributes"]["POSITION"] = builder.accessor(tilted)
    builder.add("meshes", primitives=[primitive(builder, 0, attributes=rich), plain])
    mesh = mesh_of(builder, tmp_path)
    # The second square gets corners of its own, because its normals are flat
    assert len(mesh.points) == 4 + 6
    assert mesh.normals[4:].tolist() == [[1, 0, 0]] * 6
    assert mesh.points[mesh.faces[2:]].tolist() == tilted[SQUARE_FACES].reshape(2, 3, 3).tolist()
    assert mesh.uv[0][:4].tolist() == (SQUARE[:, :2] + 0.5).tolist()
    assert not mesh.uv[0][4:].any() and not mesh.uv[1][4:].any()
    assert (mesh.colors[:4] == 0.25).all() and (mesh.colors[4:] == 1).all()


def test_without_any_normals_faces_stay_flat(tmp_path: Path) -> None:
    builder = Builder()
    builder.square()
    assert mesh_of(builder, tmp_path).normals is None


# --- attributes -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("width", [3, 4])
@pytest.mark.parametrize("kind", [np.float32, np.uint8, np.uint16])
def test_vertex_colours_of_every_kind_are_the_same_colours(tmp_path: Path, width: int, kind: type) -> None:
    builder = Builder()
    largest = 1 if kind is np.float32 else np.iinfo(kind).max
    colors = np.array([[0, 0.2, 1, 0.6]] * 4)[:, :width] * largest
    number = builder.accessor(colors.round(6).astype(kind), normalized=kind is not np.float32)
    builder.mesh({"POSITION": SQUARE, "COLOR_0": number}, SQUARE_FACES)
    expected = [0, 0.2, 1, 0.6 if width == 4 else 1]
    np.testing.assert_allclose(mesh_of(builder, tmp_path).colors, [expected] * 4, rtol=1e-6)


def test_normals_of_any_length_are_made_unit(tmp_path: Path) -> None:
    builder = Builder()
    builder.mesh({"POSITION": SQUARE, "NORMAL": 3 * ALONG_Z}, SQUARE_FACES)
    assert mesh_of(builder, tmp_path).normals.tolist() == ALONG_Z.tolist()


def test_normals_without_length_are_made_from_the_faces_and_reported(tmp_path: Path) -> None:
    builder = Builder()
    normals = ALONG_Z * floats([1], [0], [1], [0])
    builder.mesh({"POSITION": SQUARE, "NORMAL": normals}, SQUARE_FACES)
    scene = loaded(builder, tmp_path)
    assert scene.nodes[0].mesh.normals.tolist() == ALONG_Z.tolist()
    assert scene.notes == ("mesh 'mesh 0' has 2 normals of length 0; they are made from its faces",)


def test_tangents_without_normals_are_left_out_and_reported(tmp_path: Path) -> None:
    builder = Builder()
    builder.mesh({"POSITION": SQUARE, "TANGENT": np.tile(floats([1, 0, 0, 1]), (4, 1))}, SQUARE_FACES)
    scene = loaded(builder, tmp_path)
    assert scene.nodes[0].mesh.tangents is None
    assert scene.notes == ("mesh 'mesh 0' has tangents without normals; they are left out",)


def bumpy(builder: Builder) -> int:
    builder.add("textures", source=builder.add("images", bufferView=builder.view(png((128, 128, 255, 255)))))
    return builder.add("materials", normalTexture={"index": 0})


def test_tangents_are_made_where_a_normal_texture_needs_them(tmp_path: Path) -> None:
    builder = Builder()
    # v runs down the image: this square shows it upright
    uv = np.stack([SQUARE[:, 0], 1 - SQUARE[:, 1]], axis=1)
    builder.mesh(
        {"POSITION": SQUARE, "NORMAL": ALONG_Z, "TEXCOORD_0": uv}, SQUARE_FACES, material=bumpy(builder)
    )
    assert mesh_of(builder, tmp_path).tangents.tolist() == [[1, 0, 0, 1]] * 4


def test_given_tangents_win_over_made_ones(tmp_path: Path) -> None:
    builder = Builder()
    given = np.tile(floats([0, 1, 0, -1]), (4, 1))
    attributes = {"POSITION": SQUARE, "NORMAL": ALONG_Z, "TEXCOORD_0": SQUARE[:, :2], "TANGENT": given}
    builder.mesh(attributes, SQUARE_FACES, material=bumpy(builder))
    assert mesh_of(builder, tmp_path).tangents.tolist() == given.tolist()


def test_a_mirrored_texture_splits_the_vertices_on_its_seam(tmp_path: Path) -> None:
    builder = Builder()
    points = floats([-1, 0, 0], [0, 0, 0], [1, 0, 0], [-1, 1, 0], [0, 1, 0], [1, 1, 0])
    uv = np.stack([np.abs(points[:, 0]), 1 - points[:, 1]], axis=1)
    faces = np.array([0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4], np.uint8)
    attributes = {"POSITION": points, "NORMAL": np.tile(floats([0, 0, 1]), (6, 1)), "TEXCOORD_0": uv}
    builder.mesh(attributes, faces, material=bumpy(builder))
    mesh = mesh_of(builder, tmp_path)
    assert len(mesh.points) == 8
    assert mesh.points[mesh.faces].tolist() == points[faces].reshape(4, 3, 3).tolist()
    left, right = mesh.tangents[mesh.faces[:2]], mesh.tangents[mesh.faces[2:]]
    assert (left == (-1, 0, 0, -1)).all() and (right == (1, 0, 0, 1)).all()


# --- morph targets --------------------------------------------------------------------------------------


def test_morph_targets_carry_their_differences_names_and_weights(tmp_path: Path) -> None:
    builder = Builder()
    lift = np.tile(floats([0, 0, 1]), (4, 1))
    lean = np.tile(floats([1, 0, 0]), (4, 1))
    targets = [
        {"POSITION": builder.accessor(lift), "NORMAL": builder.accessor(lean)},
        {"POSITION": builder.accessor(lean), "COLOR_0": builder.accessor(lift)},
    ]
    builder.mesh({"POSITION": SQUARE, "NORMAL": ALONG_Z}, SQUARE_FACES, targets=targets)
    builder.json["meshes"][0] |= {"weights": [0.25, 0.5], "extras": {"targetNames": ["up", "aside"]}}
    mesh = mesh_of(builder, tmp_path)
    assert [target.name for target in mesh.targets] == ["up", "aside"]
    assert mesh.weights == (0.25, 0.5)
    assert mesh.targets[0].points.tolist() == lift.tolist()
    assert mesh.targets[0].normals.tolist() == lean.tolist()
    assert mesh.targets[1].normals is None
    assert mesh.targets[1].colors.tolist() == [[0, 0, 1, 0]] * 4


def test_a_node_may_weigh_the_targets_of_its_mesh_otherwise(tmp_path: Path) -> None:
    builder = Builder()
    builder.square(targets=[{"POSITION": builder.accessor(ALONG_Z)}])
    builder.node(mesh=0)
    builder.node(mesh=0, weights=[0.75])
    first, second = load(builder.write(tmp_path)).nodes
    assert (first.weights, first.mesh.weights, second.weights) == (None, (0.0,), (0.75,))
    assert [target.name for target in first.mesh.targets] == ["target 0"]


def test_a_primitive_without_a_target_stays_while_the_other_morphs(tmp_path: Path) -> None:
    builder = Builder()
    morphing = primitive(builder, 0, targets=[{"POSITION": builder.accessor(ALONG_Z)}])
    builder.add("meshes", primitives=[primitive(builder, 5), morphing])
    (target,) = mesh_of(builder, tmp_path).targets
    assert target.points.tolist() == [[0, 0, 0]] * 4 + [[0, 0, 1]] * 4


# --- skins' weights -------------------------------------------------------------------------------------


def test_joints_of_several_sets_stand_side_by_side(tmp_path: Path) -> None:
    builder = Builder()
    attributes = {
        "POSITION": SQUARE,
        "JOINTS_0": np.tile(np.array([1, 2, 3, 4], np.uint8), (4, 1)),
        "WEIGHTS_0": np.tile(floats([0.5, 0.25, 0, 0]), (4, 1)),
        "JOINTS_1": np.tile(np.array([5, 6, 7, 8], np.uint16), (4, 1)),
        "WEIGHTS_1": np.tile(floats([0.25, 0, 0, 0]), (4, 1)),
    }
    builder.mesh(attributes, SQUARE_FACES)
    mesh = mesh_of(builder, tmp_path)
    # A joint without influence is no joint
    assert mesh.joints[0].tolist() == [1, 2, 0, 0, 5, 0, 0, 0]
    assert mesh.influences[0].tolist() == [0.5, 0.25, 0, 0, 0.25, 0, 0, 0]


def test_weights_are_scaled_to_one_and_lost_vertices_follow_the_first_joint(tmp_path: Path) -> None:
    builder = Builder()
    weights = floats([0.5, 0, 0, 0], [0.25, 0.25, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0])
    joints = np.tile(np.array([3, 4, 0, 0], np.uint8), (4, 1))
    builder.mesh({"POSITION": SQUARE, "JOINTS_0": joints, "WEIGHTS_0": weights}, SQUARE_FACES)
    scene = loaded(builder, tmp_path)
    mesh = scene.nodes[0].mesh
    assert mesh.influences[:, :2].tolist() == [[1, 0], [0.5, 0.5], [1, 0], [1, 0]]
    assert mesh.joints[3].tolist() == [0, 0, 0, 0]
    assert scene.notes == (
        "mesh 'mesh 0' has 1 vertices without weights; the first joint moves them",
        "mesh 'mesh 0' has weights that do not add up to 1; they are scaled to",
    )


def test_a_texture_on_a_uv_set_that_is_not_there_lies_on_zeros(tmp_path: Path) -> None:
    builder = Builder()
    material = bumpy(builder)
    builder.json["materials"][material]["normalTexture"]["texCoord"] = 1
    builder.square(material=material)
    mesh = mesh_of(builder, tmp_path)
    assert len(mesh.uv) == 2
    assert not mesh.uv[0].any() and not mesh.uv[1].any()
    assert mesh.tangents is None
