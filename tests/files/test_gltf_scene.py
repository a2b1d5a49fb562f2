"""Nodes, scenes, cameras, lights, skins and instances."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from eyeline.errors import FileError
from eyeline.files import load
from files.gltf_builder import SQUARE, SQUARE_FACES, Builder, floats

HALF_TURN = [0.0, 1.0, 0.0, 0.0]


def test_nodes_come_depth_first_with_parents_before_children(tmp_path: Path) -> None:
    builder = Builder()
    names = ["leaf", "trunk", "twig", "other", "branch"]
    for name, children in zip(names, [[], [4, 0], [], [], [2]], strict=True):
        builder.add("nodes", name=name, **({"children": children} if children else {}))
    builder.json["scenes"] = [{"nodes": [1, 3], "name": "wood"}]
    scene = load(builder.write(tmp_path))
    assert scene.paths == ("trunk", "trunk/branch", "trunk/branch/twig", "trunk/leaf", "other")
    assert [node.parent for node in scene.nodes] == [-1, 0, 1, 0, -1]
    assert scene.name == "wood"


def test_a_node_stands_where_its_parts_or_its_matrix_put_it(tmp_path: Path) -> None:
    builder = Builder()
    builder.node(translation=[1, 2, 3], rotation=HALF_TURN, scale=[2, 2, 2])
    # Column by column: scale 2, then 1 2 3 beside
    builder.node(matrix=[-2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -2, 0, 1, 2, 3, 1])
    scene = load(builder.write(tmp_path))
    np.testing.assert_allclose(scene.world[0], scene.world[1], atol=1e-12)
    assert scene.world[1][:3, 3].tolist() == [1, 2, 3]


def test_a_rotation_far_from_unit_length_is_scaled_and_reported(tmp_path: Path) -> None:
    builder = Builder()
    builder.node(rotation=[0, 2, 0, 0])
    scene = load(builder.write(tmp_path))
    assert scene.nodes[0].rotation == (0, 1, 0, 0)
    assert scene.notes[0] == "nodes[0].rotation has length 2; it is scaled to 1"


def test_nodes_without_names_are_called_by_their_numbers(tmp_path: Path) -> None:
    builder = Builder()
    builder.node()
    builder.node(name="")
    assert load(builder.write(tmp_path)).paths == ("node 0", "node 1")


def test_a_name_with_a_line_break_stays_on_one_line(tmp_path: Path) -> None:
    builder = Builder()
    builder.node(name="two\nlines")
    assert load(builder.write(tmp_path)).paths == (r"two\nlines",)


def three_scenes() -> Builder:
    builder = Builder()
    for name in "abc":
        builder.add("nodes", name=name)
        builder.add("scenes", name=f"scene {name}", nodes=[len(builder.json["nodes"]) - 1])
    return builder


@pytest.mark.parametrize(("wanted", "path"), [(None, "b"), (0, "a"), (2, "c"), ("scene c", "c")])
def test_one_of_several_scenes_is_chosen_by_name_or_number(
    tmp_path: Path, wanted: str | int | None, path: str
) -> None:
    builder = three_scenes()
    builder.json["scene"] = 1
    assert load(builder.write(tmp_path), scene=wanted).paths == (path,)


def test_several_scenes_are_reported(tmp_path: Path) -> None:
    notes = load(three_scenes().write(tmp_path)).notes
    assert notes[0] == "the file has 3 scenes, 'scene a', 'scene b', 'scene c'; 'scene a' is read"


@pytest.mark.parametrize("wanted", [3, -1, "scene d"])
def test_a_scene_that_is_not_there_is_refused(tmp_path: Path, wanted: str | int) -> None:
    with pytest.raises(FileError, match=r"^model.gltf: there is no scene .*; the file has 'scene a', "):
        load(three_scenes().write(tmp_path), scene=wanted)


def test_without_scenes_all_nodes_are_taken(tmp_path: Path) -> None:
    builder = Builder()
    builder.add("nodes", name="a", children=[1])
    builder.add("nodes", name="b")
    scene = load(builder.write(tmp_path))
    assert scene.paths == ("a", "a/b")
    assert scene.notes[0] == "the file has no scene; all its nodes are taken"


# --- what stands there ----------------------------------------------------------------------------------


def test_half_the_height_of_an_orthographic_camera_is_its_ymag(tmp_path: Path) -> None:
    builder = Builder()
    lens = {"xmag": 3.0, "ymag": 1.5, "znear": 0.0, "zfar": 9.0}
    builder.node(camera=builder.add("cameras", type="orthographic", orthographic=lens), translation=[0, 0, 5])
    (camera,) = load(builder.write(tmp_path)).cameras
    assert (camera.height, camera.aspect, camera.near, camera.far, camera.fov) == (3.0, 2.0, 0.0, 9.0, None)
    assert camera.world_from_eye[:3, 3].tolist() == [0, 0, 5]


def test_a_perspective_camera_may_see_to_infinity(tmp_path: Path) -> None:
    builder = Builder()
    number = builder.add("cameras", type="perspective", perspective={"yfov": 1.0, "znear": 0.5}, name="eye")
    builder.node(camera=number)
    (camera,) = load(builder.write(tmp_path)).cameras
    assert (camera.fov, camera.near, camera.far, camera.aspect, camera.name) == (1.0, 0.5, None, None, "eye")


def test_lights_of_every_kind_stand_at_their_nodes(tmp_path: Path) -> None:
    builder = Builder()
    lights = [
        {"type": "directional", "color": [1, 0.5, 0], "intensity": 3, "name": "sun"},
        {"type": "point", "range": 7},
        {"type": "spot", "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.2}},
        {"type": "spot"},
    ]
    builder.json["extensions"] = {"KHR_lights_punctual": {"lights": lights}}
    for number in range(4):
        builder.node(extensions={"KHR_lights_punctual": {"light": number}}, translation=[number, 0, 0])
    found = load(builder.write(tmp_path)).lights
    sun, point, spot, wide = (light for light, _ in found)
    assert (sun.kind, sun.color, sun.intensity, sun.name) == ("directional", (1, 0.5, 0), 3, "sun")
    assert (point.kind, point.range, point.intensity, point.color) == ("point", 7, 1, (1, 1, 1))
    assert (spot.kind, spot.inner_cone, spot.outer_cone, spot.range) == ("spot", 0.1, 0.2, math.inf)
    assert (wide.inner_cone, wide.outer_cone) == (0, math.pi / 4)
    assert [matrix[0, 3] for _, matrix in found] == [0, 1, 2, 3]


def test_a_hidden_node_is_not_visible(tmp_path: Path) -> None:
    builder = Builder()
    builder.node(mesh=builder.square(), extensions={"KHR_node_visibility": {"visible": False}})
    builder.node(mesh=0, extensions={"KHR_node_visibility": {}})
    scene = load(builder.write(tmp_path))
    assert [node.visible for node in scene.nodes] == [False, True]


def test_a_mesh_used_twice_is_one_mesh(tmp_path: Path) -> None:
    builder = Builder()
    builder.node(mesh=builder.square())
    builder.node(mesh=0)
    first, second = load(builder.write(tmp_path)).nodes
    assert first.mesh is second.mesh


def test_instances_stand_where_their_attributes_say(tmp_path: Path) -> None:
    builder = Builder()
    named = {
        "TRANSLATION": builder.accessor(floats([0, 0, 0], [5, 0, 0], [0, 5, 0])),
        "ROTATION": builder.accessor(
            np.array([[0, 0, 0, 127], [0, 127, 0, 0], [0, 0, 0, 127]], np.int8), normalized=True
        ),
        "SCALE": builder.accessor(floats([1, 1, 1], [1, 1, 1], [2, 2, 2])),
        "_ID": builder.accessor(np.array([0, 1, 2], np.uint8)),
    }
    builder.node(mesh=builder.square(), extensions={"EXT_mesh_gpu_instancing": {"attributes": named}})
    scene = load(builder.write(tmp_path))
    corners = np.append(SQUARE[2], 1)
    places = [(matrix @ corners)[:3].tolist() for matrix in scene.nodes[0].instances]
    np.testing.assert_allclose(places, [[1, 1, 0], [4, 1, 0], [2, 7, 0]], atol=1e-6)
    assert scene.face_count == 6


# --- skins ----------------------------------------------------------------------------------------------


def skinned(**skin: object) -> Builder:
    """A square on two joints; node 0 wears it, node 2 stands under node 1."""
    builder = Builder()
    attributes = {
        "POSITION": SQUARE,
        "JOINTS_0": np.array([[0, 1, 0, 0]] * 4, np.uint8),
        "WEIGHTS_0": floats(*[[0.5, 0.5, 0, 0]] * 4),
    }
    builder.node(mesh=builder.mesh(attributes, SQUARE_FACES), skin=0)
    builder.node(name="hip", children=[2])
    builder.add("nodes", name="knee", translation=[0, 1, 0])
    builder.add("skins", joints=[2, 1], **skin)
    return builder


def test_a_skin_names_the_scenes_nodes_and_undoes_the_bind_pose(tmp_path: Path) -> None:
    builder = skinned(name="suit")
    matrices = np.tile(np.eye(4, dtype=np.float32), (2, 1, 1))
    matrices[0, :3, 3] = (0, -1, 0)
    builder.json["skins"][0]["inverseBindMatrices"] = builder.accessor(matrices)
    scene = load(builder.write(tmp_path))
    skin = scene.nodes[0].skin
    assert [scene.paths[joint] for joint in skin.joints] == ["hip/knee", "hip"]
    assert skin.joint_from_mesh.tolist() == matrices.tolist()
    assert skin.name == "suit"
    assert scene.notes == ()


def test_without_inverse_bind_matrices_they_are_identities(tmp_path: Path) -> None:
    skin = load(skinned(skeleton=1).write(tmp_path)).nodes[0].skin
    assert skin.joint_from_mesh.tolist() == np.tile(np.eye(4), (2, 1, 1)).tolist()


def test_joints_outside_the_scene_bring_their_tree_with_them(tmp_path: Path) -> None:
    builder = skinned()
    builder.json["scenes"] = [{"nodes": [0]}]
    scene = load(builder.write(tmp_path))
    assert scene.paths == ("node 0", "hip", "hip/knee")
    assert scene.notes == ("node 2, a joint of a skin, stands outside the scene; its tree is added",)


def test_a_skin_of_another_scene_brings_nothing(tmp_path: Path) -> None:
    builder = skinned()
    builder.add("nodes", name="alone")
    builder.json["scenes"] = [{"nodes": [3]}]
    assert load(builder.write(tmp_path)).paths == ("alone",)


def test_a_skin_without_joints_in_the_mesh_is_reported(tmp_path: Path) -> None:
    builder = skinned()
    builder.json["nodes"][0]["mesh"] = builder.square()
    scene = load(builder.write(tmp_path))
    assert scene.nodes[0].skin is None
    assert scene.notes == ("nodes[0] has a skin, and mesh 'mesh 1' has no joints; it stays rigid",)


# --- extensions -----------------------------------------------------------------------------------------


def test_an_unknown_extension_is_reported_once(tmp_path: Path) -> None:
    builder = Builder()
    builder.node(mesh=builder.square())
    builder.json["extensionsUsed"] = ["VENDOR_magic", "KHR_texture_transform", "VENDOR_magic"]
    scene = load(builder.write(tmp_path))
    assert scene.notes == ("the extension 'VENDOR_magic' is not read; the model is drawn without it",)
    assert scene.extensions == ("VENDOR_magic", "KHR_texture_transform")


def test_notes_are_at_most_a_hundred_and_one(tmp_path: Path) -> None:
    builder = Builder()
    builder.node(mesh=builder.square())
    builder.json["extensionsUsed"] = [f"VENDOR_{number}" for number in range(150)]
    notes = load(builder.write(tmp_path)).notes
    assert len(notes) == 101
    assert notes[-1] == "and 50 more notes like these"


def test_trees_of_joints_bring_the_trees_of_their_own_joints(tmp_path: Path) -> None:
    builder = skinned()
    builder.json["nodes"][2] |= {"mesh": 0, "skin": 1}
    builder.add("nodes", name="far")
    builder.add("skins", joints=[3, 3])
    builder.json["scenes"] = [{"nodes": [0]}]
    assert load(builder.write(tmp_path)).paths == ("node 0", "hip", "hip/knee", "far")


def test_a_name_of_any_length_leaves_sentences_short(tmp_path: Path) -> None:
    builder = Builder()
    builder.node(mesh=builder.square(mode=0), name="n" * 5000)
    builder.json["meshes"][0]["name"] = "m" * 5000
    assert max(map(len, load(builder.write(tmp_path)).notes)) < 200
