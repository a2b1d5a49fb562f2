"""glTF written: what was saved comes back, others read it, and Khronos' validator finds no error."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import eyeline as el
from data import data, every
from eyeline.samples import CHARACTERS, SAMPLES
from kitchen import answer

MODELS = [path.name for path in every("gltf/*.gl*")]
NAMES = [*MODELS, *(name for name in SAMPLES if name not in CHARACTERS)]
SUFFIXES = (".glb", ".gltf")
ROUNDED = 1e-6  # what 32 bits may lose of numbers that models have
VALIDATOR = Path(__file__).parent / "validator"
THREEJS = Path(__file__).parent.parent / "motion" / "threejs"

SIZE = (96, 64)
COARSE = {"fps": 24.0, "tolerance": 2e-3}  # what acts is sampled; so it stays small


def scene_of(name: str) -> el.Scene:
    return el.load(data(f"gltf/{name}")) if name in MODELS else SAMPLES[name]()


def saved(scene: el.Scene, path: Path, **options: float) -> el.Scene:
    scene.save(path, **options)
    return el.load(path)


def near(found: Any, expected: Any) -> None:
    np.testing.assert_allclose(found, expected, rtol=ROUNDED, atol=ROUNDED)


def same_array(found: Any, expected: Any, name: str) -> None:
    """Nothing and zeros are one: players take them so."""
    if found is None or expected is None:
        assert not np.any(found if expected is None else expected), name
    elif name in ("influences", "joints"):
        near(found[:, : expected.shape[1]], expected)
    else:
        np.testing.assert_array_equal(found, expected, name)


def corner_values(mesh: el.Mesh, array: Any) -> Any:
    """What every corner of every face has, so that vertices may be renumbered."""
    return None if array is None else array[mesh.faces]


def same_mesh(found: el.Mesh, expected: el.Mesh, ordered: bool) -> None:
    assert found.weights == expected.weights
    assert found.name == expected.name or not expected.name
    assert [one.name for one in found.targets] == [one.name for one in expected.targets]
    if not ordered:
        assert len(found.faces) == len(expected.faces)
        return
    for name in ("points", "normals", "tangents", "colors", "influences"):
        same_array(
            corner_values(found, getattr(found, name)), corner_values(expected, getattr(expected, name)), name
        )
    for one, other in zip(found.uv, expected.uv, strict=True):
        same_array(corner_values(found, one), corner_values(expected, other), "uv")
    for one, other in zip(found.targets, expected.targets, strict=True):
        for name in ("points", "normals", "tangents", "colors"):
            same_array(
                corner_values(found, getattr(one, name)),
                corner_values(expected, getattr(other, name)),
                name,
            )


def same_material(found: el.Material, expected: el.Material) -> None:
    for field in fields(expected):
        one, other = getattr(found, field.name), getattr(expected, field.name)
        if isinstance(other, el.TextureSlot):
            np.testing.assert_array_equal(one.texture.pixels, other.texture.pixels)
            kept = ("wrap", "nearest", "mipmaps", "name")
            assert all(getattr(one.texture, key) == getattr(other.texture, key) for key in kept)
            kept = ("uv_set", "offset", "rotation", "scale")
            assert all(getattr(one, key) == getattr(other, key) for key in kept)
        elif field.name == "name":
            assert one == other or not other
        elif isinstance(other, float | tuple):
            near(one, other)
        else:
            assert one == other, field.name


def worn(mesh: el.Mesh) -> list[el.Material]:
    """The material of the first face of each run of one."""
    if mesh.face_material is None:
        return [mesh.materials[0]]
    first = np.flatnonzero(np.diff(mesh.face_material, prepend=-1))
    return [mesh.materials[slot] for slot in mesh.face_material[first]]


def same_scene(found: el.Scene, expected: el.Scene, ordered: bool) -> None:
    assert found.paths == expected.paths
    assert [node.parent for node in found.nodes] == [node.parent for node in expected.nodes]
    near(found.world, expected.world)
    for one, other in zip(found.nodes, expected.nodes, strict=True):
        assert one.visible == other.visible
        assert (one.mesh is None) == (other.mesh is None)
        if one.mesh and other.mesh:
            same_mesh(one.mesh, other.mesh, ordered)
            for material, like in zip(worn(one.mesh), worn(other.mesh), strict=True) if ordered else ():
                same_material(material, like)
        if other.instances is not None:
            near(one.instances, other.instances)
        if other.skin is not None:
            assert one.skin.joints == other.skin.joints
            np.testing.assert_array_equal(one.skin.joint_from_mesh, other.skin.joint_from_mesh)
        if other.light is not None:
            near(vars(one.light)["intensity"], other.light.intensity)
            near(one.light.color, other.light.color)
            assert (one.light.kind, one.light.range) == (other.light.kind, other.light.range)
        if other.camera is not None:
            assert (one.camera.fov, one.camera.height) == (other.camera.fov, other.camera.height)


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize("name", NAMES)
def test_a_saved_scene_comes_back(name: str, suffix: str, tmp_path: Path) -> None:
    scene = scene_of(name)
    notes = scene.save(tmp_path / f"model{suffix}")
    again = el.load(tmp_path / f"model{suffix}")
    assert again.notes == ()
    same_scene(again, scene, ordered=not any("faces of mesh" in note for note in notes))
    assert [clip.name for clip in again.clips] == [clip.name for clip in scene.clips]


@pytest.mark.parametrize("name", NAMES)
def test_clips_come_back_at_every_time(name: str, tmp_path: Path) -> None:
    scene = scene_of(name)
    again = saved(scene, tmp_path / "model.glb")
    for number, clip in enumerate(scene.clips):
        times = np.random.default_rng(number).uniform(-0.5, clip.duration + 0.5, 50)
        found, expected = again.sample(times, number), scene.sample(times, number)
        near(found.world, expected.world)
        for node, weights in expected.weights.items():
            near(found.weights[node], weights)


@pytest.mark.parametrize("name", [*MODELS, "cornell_box", "desk_lamp", "coplanar_faces"])
def test_a_saved_scene_looks_the_same(name: str, tmp_path: Path) -> None:
    scene = scene_of(name)
    again = saved(scene, tmp_path / "model.glb")
    time = 0.6 * scene.duration
    camera = el.Camera.framing(scene.at(time).bounds)
    faces = [el.visible(one.at(time), camera, size=SIZE).face for one in (again, scene)]
    np.testing.assert_array_equal(*faces)
    shown = [el.render(one, camera=camera, size=SIZE, time=time).pixels for one in (again, scene)]
    np.testing.assert_array_equal(*shown)


@pytest.mark.parametrize("name", CHARACTERS)
def test_a_saved_character_acts_the_same(name: str, tmp_path: Path) -> None:
    scene = SAMPLES[name]()
    again = saved(scene, tmp_path / "model.glb", **COARSE)
    assert again.paths == scene.paths
    for clip in scene.clips:
        for part in (0.0, 0.37, 0.71):
            # At a frame that was sampled, so that only the tolerance counts
            time = round(part * clip.duration * 24) / 24
            shown = [el.render(one.at(time, clip.name), size=(160, 100)).pixels for one in (again, scene)]
            off = np.abs(shown[0].astype(int) - shown[1].astype(int)).max(axis=2)
            assert (off > 16).mean() < 0.004 and off.mean() < 0.25, (clip.name, time)


def test_the_validator_finds_no_error(tmp_path: Path) -> None:
    files = [tmp_path / f"{name.replace('.', '-')}{suffix}" for name in NAMES for suffix in SUFFIXES]
    for name, pair in zip(NAMES, zip(files[::2], files[1::2], strict=True), strict=True):
        for path in pair:
            scene_of(name).save(path)
    for name in CHARACTERS:
        files.append(tmp_path / f"{name}.glb")
        SAMPLES[name]().save(files[-1], **COARSE)
    errors = answer(VALIDATOR, "validate.mjs", [str(path) for path in files])
    assert {path.name: found for path, found in zip(files, errors, strict=True) if found} == {}
