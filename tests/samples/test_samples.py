"""The built-in models: sound surfaces of sensible sizes, and clips that keep their feet on the floor."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

from data import data
from eyeline.files import load
from eyeline.geometry.weld import welded
from eyeline.samples import HARD_CASES, SAMPLES, newell
from eyeline.samples.bouncing_ball import RADIUS
from eyeline.samples.demo_shot import HIT
from eyeline.samples.teapot import STEPS, TALL, surface
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene

SIZES = {
    "sphere": (1, 1, 1), "cube": (1, 1, 1), "torus": (1, 0.3, 1), "teapot": (0.327, 0.16, 0.203),
    "cornell_box": (0.556, 0.549, 0.559), "bouncing_ball": (8, 4, 4.3),
    "desk_lamp": (8, 4, 4.3), "demo_shot": (8, 4, 4.3),
    "flour_sack": (8, 4, 4.3),
    "cyclic_overlap": (1.9, 1.9, 0.57), "piercing_faces": (1.9, 1.8, 1.44), "coplanar_faces": (2.6, 1.9, 0.5),
    "edge_on_faces": (1.966, 1.6, 1), "t_junction": (2.2, 1.8, 0.5), "deep_stack": (2.3, 1.64, 1),
    "convex_body": (1.68, 1.68, 1.68), "concave_body": (1.902, 1.809, 0.5),
}  # fmt: skip
SHEETS = set(HARD_CASES) - {"convex_body", "concave_body"}
OPEN = {"backdrop", "walls", "lamp", "short block", "tall block", "teapot", "lid"}  # as drawn by their makers


@cache
def made(name: str) -> Scene:
    return SAMPLES[name]()


def solid(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    """A mesh's points and faces, split vertices made one again."""
    first, index = welded(mesh.points)
    return mesh.points[first].astype(np.float64), index[mesh.faces]


def volume(mesh: Mesh) -> float:
    a, b, c = (mesh.points[mesh.faces[:, k]].astype(np.float64) for k in range(3))
    return float((a * np.cross(b, c)).sum() / 6)


@pytest.mark.parametrize("name", SAMPLES)
def test_model_has_its_size(name):
    bounds = made(name).at(0.0).bounds
    np.testing.assert_allclose(bounds.high - bounds.low, SIZES[name], rtol=0.01)


@pytest.mark.parametrize("name", SAMPLES)
def test_closed_parts_are_watertight_and_face_outwards(name):
    for node in made(name).nodes:
        if node.mesh is None or node.name in OPEN or name in SHEETS:
            continue
        _, faces = solid(node.mesh)
        ways = np.concatenate([faces[:, [k, (k + 1) % 3]] for k in range(3)])
        kinds = {tuple(way) for way in ways.tolist()}
        assert len(kinds) == len(ways), f"{node.name} has an edge that two faces turn the same way around"
        assert all((b, a) in kinds for a, b in kinds), f"{node.name} has an open edge"
        assert volume(node.mesh) > 0


@pytest.mark.parametrize("name", SAMPLES)
def test_normals_are_unit_and_on_the_side_of_their_faces(name):
    for node in made(name).nodes:
        if node.mesh is None:
            continue
        mesh = node.mesh
        a, b, c = (mesh.points[mesh.faces[:, k]].astype(np.float64) for k in range(3))
        facing = np.cross(b - a, c - a)
        np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-5)
        assert ((mesh.normals[mesh.faces] * facing[:, None]).sum(axis=2) > -1e-12).all(), node.name
        assert mesh.uv and len(mesh.uv[0]) == len(mesh.points)


def test_counts_are_as_made():
    counts = {name: made(name).face_count for name in ("sphere", "cube", "torus", "teapot", "cornell_box")}
    assert counts == {"sphere": 9024, "cube": 12, "torus": 9216, "teapot": 12432, "cornell_box": 32}


def test_sphere_is_smooth_and_round():
    (surface_of,) = made("sphere").surfaces
    mesh = surface_of.mesh
    np.testing.assert_allclose(np.linalg.norm(mesh.points, axis=1), 0.5, atol=1e-6)
    assert ((mesh.normals * mesh.points).sum(axis=1) / 0.5 > 0.999).all()
    assert volume(mesh) == pytest.approx(4 / 3 * math.pi / 8, rel=5e-3)


def test_torus_has_the_volume_of_its_formula():
    (surface_of,) = made("torus").surfaces
    assert volume(surface_of.mesh) == pytest.approx(2 * math.pi**2 * 0.35 * 0.15**2, rel=5e-3)


# --- the teapot -------------------------------------------------------------------------------------------


def test_newell_drew_32_patches_over_306_points():
    patches = newell.patches()
    every = np.concatenate(list(patches.values()))
    assert every.shape == (32, 4, 4, 3)
    assert {name: len(part) for name, part in patches.items()} == {
        "body": 16,
        "lid": 8,
        "handle": 4,
        "spout": 4,
    }
    assert len(np.unique(every.reshape(-1, 3).round(6), axis=0)) == 290


def test_teapot_lies_on_another_program_s_teapot():
    from scipy.spatial import cKDTree

    other = load(data("mesh/teapot.obj")).surfaces[0].mesh.points
    ours = np.concatenate([surface(part, 40).points for part in newell.patches().values()]) * (
        newell.HEIGHT / TALL
    )
    distance, _ = cKDTree(ours).query(other)
    assert distance.max() < 2e-6


def test_teapot_s_neighbouring_patches_share_their_points():
    pot = made("teapot").nodes[0].mesh
    _, faces = solid(pot)
    _, counts = np.unique(
        np.sort(np.concatenate([faces[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1),
        axis=0,
        return_counts=True,
    )
    # Open are the rim's inside, four patches around, and both ends of handle and spout, two patches around
    assert (counts == 1).sum() == 3 * 4 * STEPS
    assert counts.max() == 2


# --- scenes -----------------------------------------------------------------------------------------------


def test_cornell_box_has_its_measured_corners_and_looks_inwards():
    scene = made("cornell_box")
    walls = scene["walls"].mesh
    np.testing.assert_allclose(walls.points.max(axis=0), [0.556, 0.5488, 0.5592], atol=1e-6)
    middle = np.array([0.278, 0.273, 0.28])
    assert (((middle - walls.points) * walls.normals).sum(axis=1) > 0).all()
    (camera,) = scene.cameras
    np.testing.assert_allclose(camera.world_from_eye[:3, 3], [0.278, 0.273, -0.8])
    assert math.degrees(camera.fov) == pytest.approx(39.3, abs=0.05)


@pytest.mark.parametrize("clip", ["hop", "nod"])
def test_lamp_ends_its_clips_as_it_began_but_for_where_it_stands(clip):
    scene = made("desk_lamp")
    before, after = scene.at(0.0, clip), scene.at(scene.clip(clip).duration, clip)
    for name in ("lower arm", "upper arm", "head"):
        np.testing.assert_allclose(after[name].rotation, before[name].rotation, atol=1e-6)
        np.testing.assert_allclose(before[name].rotation, scene[name].rotation, atol=1e-6)


def test_lamp_s_joints_carry_the_light():
    scene = made("desk_lamp")
    at = scene.find("light")
    moved = np.abs(scene.at(0.34, "nod").world[at] - scene.at(0.0, "nod").world[at]).max()
    assert moved > 0.05


def test_ball_touches_the_floor_and_never_sinks_in():
    scene = made("bouncing_ball")
    times = np.arange(0, 4.0, 1 / 480)
    samples = scene.sample(times)
    under = samples.translation[:, 1, 1] - RADIUS * samples.scale[:, 1, 1]
    assert under.min() == pytest.approx(0, abs=1e-9)
    ground = under[times < 2.1] < 1e-9
    assert (np.diff(ground.astype(int)) == 1).sum() == 5


def test_ball_flies_in_parabolas():
    times = np.linspace(0.45, 0.85, 41)
    height = made("bouncing_ball").sample(times).translation[:, 1, 1]
    np.testing.assert_allclose(np.diff(height, 2) / 0.01**2, -9.81, rtol=1e-6)


def test_squash_and_stretch_keep_the_ball_s_volume():
    scale = made("bouncing_ball").sample(np.arange(0, 4.0, 1 / 240)).scale[:, 1]
    np.testing.assert_allclose(scale.prod(axis=1), 1, atol=0.01)
    assert scale[:, 1].min() < 0.7 and scale[:, 1].max() > 1.1
    np.testing.assert_allclose(scale[-1], 1)


def test_demo_s_ball_touches_the_teapot_and_does_not_enter_it():
    scene = made("demo_shot")
    pot = scene.at(HIT)
    mesh = pot["place/teapot"].mesh
    points = (
        mesh.points @ pot.world[pot.find("place/teapot")][:3, :3].T
        + pot.world[pot.find("place/teapot")][:3, 3]
    )
    centre = pot.world[pot.find("ball/squash/spin")][:3, 3]
    assert np.linalg.norm(points - centre, axis=1).min() == pytest.approx(RADIUS, abs=0.006)


def test_demo_s_camera_sees_lamp_and_teapot_all_the_while():
    scene = made("demo_shot")
    for time in (0.0, 1.2, 2.4, 3.6, 4.8):
        posed = scene.at(time)
        (camera,) = posed.cameras
        clip_from_world = camera.fitted(posed.bounds).clip_from_eye(16 / 9) @ camera.eye_from_world
        for name in ("lamp/base", "lamp/lower arm/upper arm/head", "place/teapot"):
            x, y, _, w = clip_from_world @ posed.world[posed.find(name)][:, 3]
            assert abs(x) < 0.95 * w and abs(y) < 0.95 * w, f"{name} at {time} s"
