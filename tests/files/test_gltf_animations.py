"""Animations become clips: channels of nodes, and pointers to everything else."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from eyeline.files import load
from eyeline.motion.clip import Clip
from eyeline.motion.track import Track
from files.gltf_builder import Builder, floats
from files.images import png

TIMES = floats(0, 1, 2)


def clip_of(builder: Builder, folder: Path) -> Clip:
    (clip,) = load(builder.write(folder)).clips
    return clip


def track_of(builder: Builder, folder: Path) -> Track:
    (track,) = clip_of(builder, folder).tracks
    return track


@pytest.mark.parametrize(("word", "ours"), [("STEP", "step"), ("LINEAR", "linear")])
def test_keys_of_a_node_become_a_track_of_its_path(tmp_path: Path, word: str, ours: str) -> None:
    builder = Builder()
    builder.node(name="arm", children=[1])
    builder.add("nodes", name="hand")
    builder.animation("translation", 1, TIMES, floats([0, 0, 0], [1, 0, 0], [1, 2, 0]), word)
    builder.json["animations"][0]["name"] = "wave"
    clip = clip_of(builder, tmp_path)
    (track,) = clip.tracks
    assert (clip.name, clip.duration) == ("wave", 2.0)
    assert (track.kind, track.name, track.property) == ("node", "arm/hand", "translation")
    assert track.curve.interpolation == ours
    assert track.curve.values.tolist() == [[0, 0, 0], [1, 0, 0], [1, 2, 0]]


def test_a_cubic_key_is_tangent_value_tangent(tmp_path: Path) -> None:
    builder = Builder()
    builder.node()
    values = np.arange(27, dtype=np.float32).reshape(9, 3)
    builder.animation("scale", 0, TIMES, values, "CUBICSPLINE")
    curve = track_of(builder, tmp_path).curve
    assert curve.interpolation == "cubic"
    assert curve.values.tolist() == values.reshape(3, 3, 3).tolist()


def test_rotations_may_be_normalized_bytes(tmp_path: Path) -> None:
    builder = Builder()
    builder.node()
    turns = builder.accessor(
        np.array([[0, 0, 0, 127], [0, 127, 0, 0], [0, 0, 0, 127]], np.int8), normalized=True
    )
    builder.animation("rotation", 0, TIMES, turns)
    track = track_of(builder, tmp_path)
    assert track.curve.rotation
    assert np.abs(track.curve.values).tolist() == [[0, 0, 0, 1], [0, 1, 0, 0], [0, 0, 0, 1]]


@pytest.mark.parametrize(("word", "sides"), [("LINEAR", 1), ("CUBICSPLINE", 3)])
def test_weights_come_apart_into_targets(tmp_path: Path, word: str, sides: int) -> None:
    builder = Builder()
    target = {"POSITION": builder.accessor(np.ones((4, 3), np.float32))}
    builder.node(mesh=builder.square(targets=[target, target]))
    values = np.arange(3 * sides * 2, dtype=np.float32)
    builder.animation("weights", 0, TIMES, values, word)
    curve = track_of(builder, tmp_path).curve
    assert curve.shape == (2,)
    assert curve.values.reshape(-1).tolist() == values.tolist()


def test_a_clip_moves_what_it_says(tmp_path: Path) -> None:
    builder = Builder()
    builder.node(mesh=builder.square())
    builder.animation("translation", 0, TIMES, floats([0, 0, 0], [4, 0, 0], [4, 4, 0]))
    scene = load(builder.write(tmp_path))
    assert scene.at(0.5).world[0][:3, 3].tolist() == [2, 0, 0]
    assert scene.at(1.5).world[0][:3, 3].tolist() == [4, 2, 0]


def test_clips_without_names_or_with_the_same_are_told_apart(tmp_path: Path) -> None:
    builder = Builder()
    builder.node()
    for name in (None, "run", "run"):
        builder.animation("scale", 0, TIMES, np.ones((3, 3), np.float32))
        builder.json["animations"][-1] |= {} if name is None else {"name": name}
    assert [clip.name for clip in load(builder.write(tmp_path)).clips] == ["animation 0", "run", "run.1"]


def test_of_two_keys_at_one_time_the_last_counts_and_that_is_reported(tmp_path: Path) -> None:
    builder = Builder()
    builder.node()
    builder.animation("scale", 0, floats(0, 1, 1, 2), floats([1, 1, 1], [2, 2, 2], [3, 3, 3], [4, 4, 4]))
    scene = load(builder.write(tmp_path))
    assert scene.clips[0].tracks[0].curve.values[:, 0].tolist() == [1, 3, 4]
    assert (
        scene.notes[0]
        == "animations[0].samplers[0].input has several keys at one time; the last of them counts"
    )


def test_two_channels_of_one_property_are_reported(tmp_path: Path) -> None:
    builder = Builder()
    builder.node(name="a")
    ones = np.ones((3, 3), np.float32)
    builder.channels([({"node": 0, "path": "scale"}, TIMES, k * ones, "LINEAR") for k in (1, 2)])
    scene = load(builder.write(tmp_path))
    (track,) = scene.clips[0].tracks
    assert track.curve.values[0].tolist() == [1, 1, 1]
    assert "clip 'animation 0' moves scale of 'a' twice; the first of both counts" in scene.notes


def test_a_channel_of_a_node_outside_the_scene_is_reported(tmp_path: Path) -> None:
    builder = Builder()
    builder.node()
    builder.add("nodes")
    builder.animation("scale", 1, TIMES, np.ones((3, 3), np.float32))
    scene = load(builder.write(tmp_path))
    assert scene.clips[0].tracks == ()
    assert scene.notes[0] == "clip 'animation 0' moves scale of nodes[1], which the scene does not show"


# --- pointers -------------------------------------------------------------------------------------------


def stage() -> Builder:
    """A node with everything a pointer may move."""
    builder = Builder()
    builder.add("images", bufferView=builder.view(png((255, 0, 0, 255))))
    builder.add("textures", source=0)
    strength = {"KHR_materials_emissive_strength": {"emissiveStrength": 2}}
    texture = {"index": 0}
    surface = {"baseColorTexture": texture, "metallicRoughnessTexture": texture}
    builder.add(
        "materials", name="paint", pbrMetallicRoughness=surface,
        extensions=strength, emissiveFactor=[1, 0.5, 0.25],
        normalTexture=texture, occlusionTexture=texture, emissiveTexture=texture,
    )  # fmt: skip
    builder.add("cameras", type="perspective", perspective={"yfov": 1.0, "znear": 0.125})
    builder.add("cameras", type="orthographic", orthographic={"xmag": 1, "ymag": 1, "znear": 0, "zfar": 9})
    builder.json["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "spot"}]}}
    mesh = builder.square(material=0, targets=[{"POSITION": builder.accessor(np.ones((4, 3), np.float32))}])
    builder.node(name="all", mesh=mesh, camera=0, extensions={"KHR_lights_punctual": {"light": 0}})
    builder.node(name="flat", camera=1)
    return builder


MATERIAL = "/materials/0/"
PBR = f"{MATERIAL}pbrMetallicRoughness/"
LIGHT = "/extensions/KHR_lights_punctual/lights/0/"
MOVED = "/extensions/KHR_texture_transform/"
NUMBERS = floats(0.25, 0.5, 1)
POINTERS: dict[str, tuple[str, str, int]] = {
    "/nodes/0/translation": ("all", "translation", 3),
    "/nodes/0/rotation": ("all", "rotation", 4),
    "/nodes/0/scale": ("all", "scale", 3),
    "/nodes/0/weights": ("all", "weights", 1),
    "/meshes/0/weights": ("all", "weights", 1),
    "/nodes/0/extensions/KHR_node_visibility/visible": ("all", "visible", 1),
    "/cameras/0/perspective/yfov": ("all", "camera.fov", 1),
    "/cameras/0/perspective/znear": ("all", "camera.near", 1),
    "/cameras/0/perspective/zfar": ("all", "camera.far", 1),
    f"{LIGHT}color": ("all", "light.color", 3),
    f"{LIGHT}intensity": ("all", "light.intensity", 1),
    f"{LIGHT}range": ("all", "light.range", 1),
    f"{LIGHT}spot/innerConeAngle": ("all", "light.inner_cone", 1),
    f"{LIGHT}spot/outerConeAngle": ("all", "light.outer_cone", 1),
    f"{PBR}baseColorFactor": ("paint", "base_color", 4),
    f"{PBR}metallicFactor": ("paint", "metallic", 1),
    f"{PBR}roughnessFactor": ("paint", "roughness", 1),
    f"{MATERIAL}alphaCutoff": ("paint", "alpha_cutoff", 1),
    f"{MATERIAL}normalTexture/scale": ("paint", "normal_scale", 1),
    f"{MATERIAL}occlusionTexture/strength": ("paint", "occlusion_strength", 1),
    f"{PBR}baseColorTexture{MOVED}offset": ("paint", "base_color_texture.offset", 2),
    f"{PBR}metallicRoughnessTexture{MOVED}scale": ("paint", "metallic_roughness_texture.scale", 2),
    f"{MATERIAL}normalTexture{MOVED}rotation": ("paint", "normal_texture.rotation", 1),
    f"{MATERIAL}occlusionTexture{MOVED}offset": ("paint", "occlusion_texture.offset", 2),
    f"{MATERIAL}emissiveTexture{MOVED}offset": ("paint", "emissive_texture.offset", 2),
}


@pytest.mark.parametrize("pointer", POINTERS)
def test_a_pointer_moves_what_it_points_at(tmp_path: Path, pointer: str) -> None:
    name, moved, width = POINTERS[pointer]
    builder = stage()
    rows = np.tile(NUMBERS[:, None], (1, width))
    builder.pointer(pointer, TIMES, rows if width > 1 else NUMBERS)
    scene = load(builder.write(tmp_path))
    (track,) = scene.clips[0].tracks
    assert (track.name, track.property) == (name, moved)
    if moved != "rotation":
        assert track.curve.values.reshape(3, width).tolist() == rows.tolist()
    scene.at(0.5)
    assert scene.notes == ()


def test_an_orthographic_camera_is_moved_by_half_its_height(tmp_path: Path) -> None:
    builder = stage()
    builder.pointer("/cameras/1/orthographic/ymag", TIMES, NUMBERS)
    track = track_of(builder, tmp_path)
    assert (track.name, track.property) == ("flat", "camera.height")
    assert track.curve.values.tolist() == [0.5, 1, 2]


@pytest.mark.parametrize(
    ("pointer", "values", "expected"),
    [
        # strength 2 times the moving factor; the factor 1, 0.5, 0.25 times the moving strength
        (f"{MATERIAL}emissiveFactor", floats([0, 0, 0], [1, 0, 0], [1, 1, 0.5]), [2, 2, 1]),
        (
            f"{MATERIAL}extensions/KHR_materials_emissive_strength/emissiveStrength",
            floats(0, 1, 4),
            [4, 2, 1],
        ),
    ],
)
def test_emissive_colour_and_strength_move_as_one(
    tmp_path: Path, pointer: str, values: np.ndarray, expected: list[float]
) -> None:
    builder = stage()
    builder.pointer(pointer, TIMES, values)
    track = track_of(builder, tmp_path)
    assert (track.kind, track.name, track.property) == ("material", "paint", "emissive")
    assert track.curve.values[-1].tolist() == expected


def test_a_light_or_camera_at_several_nodes_is_moved_at_all(tmp_path: Path) -> None:
    builder = stage()
    builder.node(name="second", camera=0)
    builder.pointer("/cameras/0/perspective/yfov", TIMES, NUMBERS)
    assert [track.name for track in clip_of(builder, tmp_path).tracks] == ["all", "second"]


@pytest.mark.parametrize(
    "pointer",
    [
        "/cameras/0/perspective/aspectRatio",
        "/materials/0/extensions/KHR_materials_ior/ior",
        "/nodes/0",
        "no pointer",
        "",
    ],
)
def test_a_pointer_to_what_is_not_drawn_is_reported(tmp_path: Path, pointer: str) -> None:
    builder = stage()
    builder.pointer(pointer, TIMES, NUMBERS)
    scene = load(builder.write(tmp_path))
    assert scene.clips[0].tracks == ()
    assert scene.notes == (f"clip 'animation 0' moves {pointer!r}, which is not drawn",)


def test_a_channel_without_a_target_is_reported(tmp_path: Path) -> None:
    builder = stage()
    ones: Any = np.ones((3, 3), np.float32)
    builder.channels(
        [({"path": "translation"}, TIMES, ones, "LINEAR"), ({"node": 0, "path": "mood"}, TIMES, ones, "STEP")]
    )
    scene = load(builder.write(tmp_path))
    assert scene.clips[0].tracks == ()
    assert scene.notes == (
        "clip 'animation 0' moves 'translation' of nothing that is read",
        "clip 'animation 0' moves 'mood' of nothing that is read",
    )
