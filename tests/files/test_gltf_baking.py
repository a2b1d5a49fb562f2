"""What glTF has no words for, saved as keys and morph targets that come near enough."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import eyeline as el
from eyeline.deform.twist import Twist
from eyeline.errors import FileError
from eyeline.files.gltf.writing.curves import as_gltf
from eyeline.files.gltf.writing.fewest_targets import fewest_targets
from eyeline.files.gltf.writing.fitting import fewest_keys
from eyeline.scene.deformation import deformed

TOLERANCE = 1e-3
ROUNDED = 1e-6  # what 32 bits may lose


def test_bezier_handles_at_thirds_are_a_cubic_spline() -> None:
    handles = [[[-1 / 3, -1], [1 / 3, 2]], [[-1 / 3, 1], [1 / 3, 0]], [[-1 / 3, 2], [1 / 3, 0]]]
    curve = el.Curve([0, 1, 2], [0.0, 3.0, 1.0], "bezier", handles=np.array(handles))
    made = as_gltf(curve, 2.0, TOLERANCE)
    times = np.linspace(0, 2, 101)
    assert (made.curve.interpolation, len(made.curve.times), made.error) == ("cubic", 3, 0)
    np.testing.assert_allclose(made.curve.at(times), curve.at(times), atol=ROUNDED)


@pytest.mark.parametrize("ease", ["ease_in_out_sine", "ease_out_bounce", "ease_in_out_elastic", "linear"])
@pytest.mark.parametrize("beyond", ["hold", "cycle", "ping_pong"])
def test_any_curve_is_written_within_the_tolerance(ease: str, beyond: str) -> None:
    curve = el.Curve([0.25, 1, 2], [[0.0, 1], [3, 1], [1, 5]], ease=ease, extrapolate=beyond)
    made = as_gltf(curve, 4.0, TOLERANCE)
    times = np.random.default_rng(1).uniform(0, 4, 2000)
    missed = np.abs(made.curve.at(times) - curve.at(times))
    assert missed.max() <= max(made.error, ROUNDED) * (1 + TOLERANCE)
    assert made.error <= TOLERANCE * np.ptp(curve.at(np.linspace(0, 4, 4000)), axis=0).max() * 1.01
    assert made.curve.is_plain


@settings(derandomize=True, deadline=None, max_examples=50)
@given(st.integers(2, 400), st.integers(0, 2**31), st.floats(1e-3, 1))
def test_no_sample_is_off_by_more_than_the_tolerance(count: int, seed: int, tolerance: float) -> None:
    rng = np.random.default_rng(seed)
    times, values = np.sort(rng.random(count)), np.cumsum(rng.normal(size=(count, 2)), axis=0) / 10
    times += np.arange(count)
    kept = fewest_keys(times, values, tolerance)
    for column in values.T:
        way = np.interp(times, times[kept], column[kept])
        assert np.abs(way - column).max() <= tolerance * (1 + ROUNDED)
    assert kept[0] == 0 and kept[-1] == count - 1


def test_a_line_needs_two_keys() -> None:
    times = np.linspace(0, 1, 1000)
    assert fewest_keys(times, times[:, None] * 3, ROUNDED).tolist() == [0, 999]


def test_shapes_made_of_three_need_three_targets() -> None:
    rng = np.random.default_rng(2)
    moves = np.tensordot(rng.normal(size=(40, 3)), rng.normal(size=(3, 60, 3)), axes=1)
    blend = fewest_targets(moves, 1e-4)
    assert len(blend.targets) == 3
    made = np.tensordot(blend.weights, blend.targets.astype(float), axes=1)
    missed = np.sqrt(np.square(made - moves).sum(axis=2)).max()
    assert missed == pytest.approx(blend.error, rel=1e-3, abs=1e-9)
    assert blend.error <= 1e-4


def twisted() -> el.Scene:
    mesh = el.samples.sphere().nodes[0].mesh
    node = el.Node("tower", mesh=mesh, deform=Twist(angle=0.0))
    track = el.Track("node", "tower", "deform.angle", el.Curve([0, 1.5], [0.0, 2.0], ease="ease_in_out_sine"))
    return el.Scene.of(node, clips=[el.Clip("turn", [track])])


def test_a_deformer_becomes_morph_targets_within_the_tolerance(tmp_path: Path) -> None:
    scene = twisted()
    notes = scene.save(tmp_path / "tower.glb", tolerance=TOLERANCE, fps=30)
    again = el.load(tmp_path / "tower.glb")
    assert "morph targets" in notes[0]
    (node,) = again.nodes
    assert node.mesh is not None and 2 <= len(node.mesh.targets) <= 8
    reach = TOLERANCE * scene.bounds.diagonal
    for frame in range(0, 46, 5):
        wanted, found = (one.at(frame / 30).surfaces[0].mesh for one in (scene, again))
        assert np.sqrt(np.square(found.points - wanted.points).sum(axis=1)).max() <= reach * (1 + TOLERANCE)
        assert (found.normals * wanted.normals).sum(axis=1).min() > math.cos(0.05)


def test_a_deformer_that_stands_still_needs_no_target(tmp_path: Path) -> None:
    mesh = el.samples.cube().nodes[0].mesh
    node = el.Node("tower", mesh=mesh, deform=Twist(angle=1.0))
    el.Scene.of(node).save(tmp_path / "tower.glb")
    (found,) = el.load(tmp_path / "tower.glb").nodes
    assert found.mesh.targets == ()
    np.testing.assert_array_equal(found.mesh.points, deformed(mesh, node.deform).points)


@dataclass(frozen=True)
class Hanging:
    """One node hangs below another."""

    below: str
    above: str
    length: float = 1.0
    name: str = "hanging"
    influence: float = 1.0

    def __call__(self, pose: object, moved: object) -> object:
        """Follow at once."""
        top = pose.translation[:, pose.find(self.above)]
        return pose.placed(pose.find(self.below), translation=top - (0, self.length, 0))


def test_constraints_become_the_motion_they_make(tmp_path: Path) -> None:
    swing = el.Curve([0, 1, 2], [[0, 0, 0], [1, 2, 0], [0, 0, 1]], "catmull_rom")
    clip = el.Clip("swing", [el.Track("node", "top", "translation", swing)])
    nodes = (el.Node("top"), el.Node("bell"))
    scene = el.Scene(nodes, (clip,), constraints=(Hanging("bell", "top"),))
    notes = scene.save(tmp_path / "bell.glb", tolerance=TOLERANCE)
    again = el.load(tmp_path / "bell.glb")
    times = np.linspace(0, 2, 77)
    np.testing.assert_allclose(again.sample(times).world, scene.sample(times).world, atol=4 * TOLERANCE)
    np.testing.assert_allclose(again.world, scene.at(0).world, atol=1.5)
    assert any("'hanging'" in note for note in notes)


def test_cameras_lights_materials_and_hiding_move_in_the_file(tmp_path: Path) -> None:
    lens = el.Camera.look_at((0, 0, 5), (0, 0, 0), near=0.1, name="eye")
    mesh = el.samples.cube().nodes[0].mesh.with_material(el.Material("clay"))
    lamp = el.Light("spot", name="lamp")
    tracks = [
        el.Track("node", "eye", "camera.focal_length", el.Curve([0, 1], [24.0, 80.0])),
        el.Track("node", "lamp", "light.intensity", el.Curve([0, 1], [1.0, 80.0])),
        el.Track("node", "box", "visible", el.Curve([0, 1], [1.0, 0.0])),
        el.Track("material", "clay", "emissive", el.Curve([0, 1], [[0.0, 0, 0], [4.0, 0, 2]])),
    ]
    scene = el.Scene.of(lens, lamp, el.Node("box", mesh=mesh), clips=[el.Clip("all", tracks)])
    notes = scene.save(tmp_path / "all.glb")
    again = el.load(tmp_path / "all.glb")
    assert any("KHR_animation_pointer" in note for note in notes)
    for time in (0.0, 0.3, 0.49, 0.51, 0.8, 1.0):
        one, other = again.at(time), scene.at(time)
        assert one["eye"].camera.fov == pytest.approx(other["eye"].camera.fov, abs=1e-3)
        assert one["lamp"].light.intensity == pytest.approx(other["lamp"].light.intensity, rel=ROUNDED)
        assert one["box"].visible == other["box"].visible
        found, wanted = (pose["box"].mesh.materials[0].emissive for pose in (one, other))
        np.testing.assert_allclose(found, wanted, atol=1e-5)


def test_shear_stands_as_a_node_in_a_node(tmp_path: Path) -> None:
    matrix = np.array([[1, 0.5, 0, 2], [0, 1, 0.2, 3], [0, 0, -1, 0], [0, 0, 0, 1]], float)
    nodes = (el.Node("bent", matrix=matrix), el.Node("child", 0, (1.0, 0.0, 0.0)))
    el.Scene(nodes).save(tmp_path / "bent.glb")
    again = el.load(tmp_path / "bent.glb")
    np.testing.assert_allclose(again["child"].parent_from_node, el.Scene(nodes)["child"].parent_from_node)
    np.testing.assert_allclose(again.world[again.find("child")], el.Scene(nodes).world[1], atol=1e-12)


def test_an_unknown_suffix_is_refused_in_a_sentence(tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"the suffix '\.fbx' is not known; eyeline writes \.glb, \.gltf"):
        el.samples.cube().save(tmp_path / "cube.fbx")


def test_a_file_that_cannot_be_finished_leaves_nothing(tmp_path: Path) -> None:
    (tmp_path / "cube.bin").mkdir()
    with pytest.raises(FileError):
        el.samples.cube().save(tmp_path / "cube.gltf")
    assert [path.name for path in tmp_path.iterdir()] == ["cube.bin"]
