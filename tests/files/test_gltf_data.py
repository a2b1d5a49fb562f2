"""Real models: what is known of them is what is read."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree

from data import data, every
from eyeline.files import load

# faces, nodes, clips: name -> seconds
KNOWN = {
    "AlphaBlendModeTest.glb": (61, 13, {}),
    "AnimatedMorphCube.gltf": (12, 1, {"Square": 4.2}),
    "BoxTextured.gltf": (12, 2, {}),
    "Cameras.gltf": (2, 3, {}),
    "Duck.glb": (4212, 3, {}),
    "Fox.glb": (576, 26, {"Survey": 3.4167, "Walk": 0.7083, "Run": 1.1583}),
    "MorphStressTest.gltf": (2412, 1, {"Individuals": 9.3333, "Pulse": 6.3333, "TheWave": 1.9583}),
    "SimpleMorph.gltf": (1, 1, {"animation 0": 4.0}),
    "SimpleSkin.gltf": (8, 3, {"animation 0": 5.5}),
    "box_animated.gltf": (254, 4, {"animation 0": 3.7083}),
    "cesium_man.gltf": (4672, 22, {"animation 0": 2.0}),
    "rigged_simple.gltf": (188, 5, {"animation 0": 2.0833}),
    "simple_skin.gltf": (8, 3, {"animation 0": 5.5}),
}


@pytest.mark.parametrize("name", KNOWN)
def test_counts_names_and_durations_are_those_of_the_model(name: str) -> None:
    scene = load(data(f"gltf/{name}"))
    faces, nodes, clips = KNOWN[name]
    assert (scene.face_count, len(scene.nodes)) == (faces, nodes)
    assert {clip.name: pytest.approx(clip.duration, abs=1e-4) for clip in scene.clips} == clips


def test_every_model_at_hand_is_read_and_can_be_posed() -> None:
    for path in [*every("gltf/*.gltf"), *every("gltf/*.glb")]:
        scene = load(path)
        assert scene.face_count > 0, path.name
        assert np.isfinite(scene.bounds.corners).all(), path.name
        for clip in range(len(scene.clips)):
            assert np.isfinite(scene.at(0.4, clip).bounds.corners).all(), path.name


def test_a_missing_image_is_reported_and_the_model_is_read() -> None:
    scene = load(data("gltf/interpolation_test.gltf"))
    assert len(scene.clips) == 9
    assert scene.notes == (
        "the image 'l.jpg' is not in the model's folder; what it covers is drawn without it",
    )


def test_the_cameras_of_a_file_keep_their_lenses() -> None:
    perspective, orthographic = load(data("gltf/Cameras.gltf")).cameras
    assert (perspective.fov, perspective.aspect, perspective.near, perspective.far) == (0.7, 1.0, 0.01, 100)
    assert (orthographic.height, orthographic.near, orthographic.far) == (2.0, 0.01, 100)
    assert (
        perspective.world_from_eye[:3, 3].tolist()
        == orthographic.world_from_eye[:3, 3].tolist()
        == [0.5, 0.5, 3]
    )


def test_alpha_modes_and_cutoffs_are_those_of_the_labels() -> None:
    scene = load(data("gltf/AlphaBlendModeTest.glb"))
    materials = {one.name: one for node in scene.nodes if node.mesh for one in node.mesh.materials}
    modes = {name: materials[name].alpha_mode for name in ("MatOpaque", "MatBlend", "MatCutoffDefault")}
    assert modes == {"MatOpaque": "opaque", "MatBlend": "blend", "MatCutoffDefault": "mask"}
    cutoffs = [materials[f"MatCutoff{name}"].alpha_cutoff for name in ("Default", "25", "75")]
    assert cutoffs == [0.5, 0.25, 0.75]
    assert materials["MatBlend"].base_color_texture.texture.pixels[..., 3].min() == 0


def test_the_fox_is_skinned_by_joints_in_its_own_tree() -> None:
    scene = load(data("gltf/Fox.glb"))
    fox = next(node for node in scene.nodes if node.mesh)
    assert len(fox.skin.joints) == 24
    assert scene.nodes[fox.skin.joints[0]].name == "_rootJoint"
    np.testing.assert_allclose(fox.mesh.influences.sum(axis=1), 1, atol=1e-6)


def test_morph_targets_keep_the_names_people_gave_them() -> None:
    (node,) = load(data("gltf/MorphStressTest.gltf")).nodes
    assert [target.name for target in node.mesh.targets] == [f"Key {number}" for number in range(1, 9)]
    assert len(node.mesh.uv) == 2
    assert [material.name for material in node.mesh.materials] == ["Base", "TestMaterial"]
    assert np.bincount(node.mesh.face_material).tolist() == [12, 2400]


@pytest.mark.parametrize(
    "name", ["Duck.glb", "BoxTextured.gltf", "box_animated.gltf", "AlphaBlendModeTest.glb"]
)
def test_faces_stand_where_another_reader_puts_them(name: str) -> None:
    path = data(f"gltf/{name}")
    triangles = trimesh.load_scene(path).to_mesh().triangles.reshape(-1, 9)
    ours = []
    for surface in load(path).surfaces:
        points = surface.mesh.points @ surface.world_from_mesh[:3, :3].T + surface.world_from_mesh[:3, 3]
        ours.append(points[surface.mesh.faces].reshape(-1, 9))
    found, distance = np.concatenate(ours), np.abs(triangles).max()
    assert found.shape == triangles.shape
    nearest, _ = cKDTree(triangles).query(found)
    assert nearest.max() < 1e-6 * distance
