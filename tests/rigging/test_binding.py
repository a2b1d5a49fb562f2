"""Weights that are found: smooth along a limb, none through the air, and near to what an artist painted."""

from __future__ import annotations

import numpy as np
import pytest

import eyeline as el
from data import data
from eyeline.errors import GeometryError, OptionError, SceneError
from eyeline.rigging.binding import FAINT, bone_weights, heaviest_joints
from eyeline.samples.clay import Ball, Limb, clay
from eyeline.samples.shapes import lathe
from eyeline.scene.pose import places_of

WAYS = ["heat", "voxels"]
LEGS = {
    "hips": (None, (0, 1.0, 0)),
    "thigh.L": ("hips", (0.1, 0.9, 0)),
    "shin.L": ("thigh.L", (0.1, 0.5, 0)),
    "thigh.R": ("hips", (-0.1, 0.9, 0)),
    "shin.R": ("thigh.R", (-0.1, 0.5, 0)),
}
TIPS = {"shin.L": (0.1, 0.1, 0), "shin.R": (-0.1, 0.1, 0)}


def tube() -> el.Mesh:
    """A closed tube along y from -1 to 1, 0.15 thick, and round at no end."""
    rim = [(0.15, y) for y in np.linspace(-1, 1, 41)]
    return lathe(np.array([(0, -1), *rim, (0, 1)]), 24).mesh()


def halves() -> tuple[el.Node, ...]:
    return el.skeleton({"low": (None, (0, -1, 0)), "high": ("low", (0, 0, 0))})


def two_legs() -> el.Mesh:
    """Two legs 2 cm apart, joined by hips."""
    return clay(
        [
            Ball((0, 1, 0), (0.2, 0.12, 0.12)),
            Limb((0.1, 0.95, 0), (0.1, 0.08, 0), 0.09, 0.09, both_sides=True),
        ],
        0.012,
    )


@pytest.mark.parametrize("way", WAYS)
def test_a_straight_tube_bends_smoothly_and_evenly(way):
    mesh = tube()
    weights = bone_weights(mesh, halves(), tips={"high": (0, 1, 0)}, way=way)
    side = np.hypot(mesh.points[:, 0], mesh.points[:, 2]) > 0.149
    rings = np.unique(mesh.points[side, 1])
    ramp = np.array([weights[side & (mesh.points[:, 1] == y), 1].mean() for y in rings])
    spread = max(np.ptp(weights[side & (mesh.points[:, 1] == y), 1]) for y in rings)
    assert spread < (1e-3 if way == "heat" else 0.08)
    np.testing.assert_allclose(ramp, 1 - ramp[::-1], atol=0.002 if way == "heat" else 0.02)
    assert (np.diff(ramp) > -1e-9).all()
    assert np.diff(ramp).max() < 0.25
    assert ramp[0] < 0.01 and ramp[-1] > 0.99


@pytest.mark.parametrize("way", WAYS)
def test_a_leg_does_not_move_the_leg_beside_it(way):
    mesh, joints = two_legs(), el.skeleton(LEGS)
    weights = bone_weights(mesh, joints, tips=TIPS, way=way)
    low = mesh.points[:, 1] < 0.6
    left = mesh.points[:, 0] > 0
    assert weights[low & left][:, [3, 4]].max() < 0.01
    assert weights[low & ~left][:, [1, 2]].max() < 0.01
    assert weights[low & left & (mesh.points[:, 1] < 0.35), 2].min() > 0.9


@pytest.mark.parametrize("way", WAYS)
def test_mirrored_bodies_have_mirrored_weights(way):
    mesh = two_legs()
    weights = bone_weights(mesh, el.skeleton(LEGS), tips=TIPS, way=way)
    there = {tuple(np.round(point, 4)): row for point, row in zip(mesh.points, weights, strict=True)}
    pairs = [(row, there[(-x, y, z)]) for (x, y, z), row in there.items() if x > 0 and (-x, y, z) in there]
    assert len(pairs) > 0.4 * len(mesh.points)
    one, other = (np.array(rows) for rows in zip(*pairs, strict=True))
    np.testing.assert_allclose(one, other[:, [0, 3, 4, 1, 2]], atol=0.02)


@pytest.mark.parametrize("way", WAYS)
def test_weights_are_parts_of_a_whole(way):
    weights = bone_weights(two_legs(), el.skeleton(LEGS), tips=TIPS, way=way)
    assert weights.min() >= 0
    np.testing.assert_allclose(weights.sum(axis=1), 1, atol=1e-9)


@pytest.mark.parametrize(("way", "moved", "alike"), [("heat", 0.11, 0.95), ("voxels", 0.16, 0.93)])
def test_a_walking_man_gets_nearly_the_weights_he_came_with(way, moved, alike):
    """The mean part of a vertex's weight that goes to another joint than in the file."""
    scene = el.load(data("gltf/cesium_man.gltf"))
    node = next(node for node in scene.nodes if node.skin)
    joints, order = bound_joints(scene, node)
    painted = np.zeros((len(node.mesh.points), len(joints)))
    for k in range(node.mesh.joints.shape[1]):
        np.add.at(painted, (np.arange(len(painted)), node.mesh.joints[:, k]), node.mesh.influences[:, k])
    painted = painted[:, order]
    found = bone_weights(node.mesh, joints, way=way)
    assert np.abs(found - painted).sum(axis=1).mean() / 2 < moved
    assert (found.argmax(axis=1) == painted.argmax(axis=1)).mean() > alike


def bound_joints(scene, node):
    """The joints of a skin as nodes where the mesh was bound, parents first; their numbers in the skin."""
    numbers = {joint: k for k, joint in enumerate(node.skin.joints)}
    parents = [numbers.get(scene.nodes[joint].parent, -1) for joint in node.skin.joints]
    order = sorted(range(len(parents)), key=lambda k: scene.paths[node.skin.joints[k]].count("/"))
    world = np.linalg.inv(node.skin.joint_from_mesh)
    nodes = []
    for k in order:
        above = np.eye(4) if parents[k] < 0 else np.linalg.inv(world[parents[k]])
        parent = -1 if parents[k] < 0 else order.index(parents[k])
        nodes.append(el.Node(scene.nodes[node.skin.joints[k]].name, parent, matrix=above @ world[k]))
    return nodes, order


def test_what_is_bound_stands_as_it_stood_and_bends_where_its_joint_is_turned():
    scene = el.bind(tube(), halves(), tips={"high": (0, 1, 0)})
    still = scene.surfaces[-1].mesh.points
    np.testing.assert_allclose(still, tube().points, atol=1e-6)
    turned = scene.with_changes({1: {"rotation": (0, 0, 0.5**0.5, 0.5**0.5)}}).surfaces[-1].mesh.points
    top = still[:, 1] > 0.99
    np.testing.assert_allclose(turned[top, 0], -still[top, 1], atol=0.02)
    low = still[:, 1] < -0.8
    np.testing.assert_allclose(turned[low], still[low], atol=0.02)


def test_an_open_mesh_is_bound_through_voxels_and_a_closed_one_by_heat():
    mesh = tube()
    opened = el.Mesh(mesh.points, mesh.faces[4:])
    joints, tips = halves(), {"high": (0, 1, 0)}
    by = {way: bone_weights(mesh, joints, tips=tips, way=way) for way in WAYS}
    np.testing.assert_array_equal(bone_weights(mesh, joints, tips=tips), by["heat"])
    found = bone_weights(opened, joints, tips=tips)
    np.testing.assert_array_equal(found, bone_weights(opened, joints, tips=tips, way="voxels"))
    assert np.abs(found - by["voxels"]).max() < 0.05


def test_vertices_split_at_seams_move_together():
    mesh = tube()
    weights = bone_weights(mesh, halves())
    _, first, index = np.unique(mesh.points, axis=0, return_index=True, return_inverse=True)
    assert len(first) < len(mesh.points)
    np.testing.assert_array_equal(weights, weights[first][index.reshape(-1)])


def test_only_the_heaviest_joints_are_kept():
    weights = np.array([[0.1, 0.4, 0.2, 0.3], [1 - FAINT / 2, FAINT / 2, 0, 0]])
    joints, influences = heaviest_joints(weights, 2)
    np.testing.assert_array_equal(joints[0], [1, 3])
    np.testing.assert_allclose(influences[0], [4 / 7, 3 / 7], rtol=1e-6)
    np.testing.assert_array_equal(influences[1], [1, 0])
    assert el.bind(two_legs(), el.skeleton(LEGS), tips=TIPS).nodes[-1].mesh.influences.shape[1] == 4


def test_a_still_joint_moves_nothing():
    joints = el.skeleton({"root": (None, (0, 0, 0)), "low": ("root", (0, -1, 0)), "high": ("low", (0, 0, 0))})
    weights = bone_weights(tube(), joints, still=["root"])
    assert weights[:, 0].max() == 0
    assert places_of(joints).world[0, 2, 1, 3] == 0


def test_a_body_within_a_body_gets_its_weights_from_the_nearest_bone():
    inner = tube()
    both = el.Mesh(
        np.concatenate([inner.points, inner.points * (2, 1.1, 2)]),
        np.concatenate([inner.faces, inner.faces + len(inner.points)]),
    )
    weights = bone_weights(both, halves(), tips={"high": (0, 1, 0)}, way="heat")
    outside = weights[len(inner.points) :]
    height = both.points[len(inner.points) :, 1]
    assert (outside[height > 0.1].argmax(axis=1) == 1).all()
    assert (outside[height < -0.1].argmax(axis=1) == 0).all()


@pytest.mark.parametrize(
    ("options", "refusal", "sentence"),
    [
        ({"way": "guess"}, OptionError, "way is 'guess'; auto, heat or voxels is needed"),
        ({"influences": 0}, OptionError, "influences is 0; 1 or more is needed"),
        ({"still": ["lo"]}, SceneError, "there is no joint 'lo'; there is 'low'"),
        ({"still": ["low", "high"]}, SceneError, "no joint moves anything"),
        ({"tips": {"tip": (0, 0, 0)}}, SceneError, "there is no joint 'tip'"),
    ],
)
def test_what_cannot_be_bound_is_refused(options, refusal, sentence):
    with pytest.raises(refusal, match=sentence):
        el.bind(tube(), halves(), **options)


def test_a_mesh_of_nothing_is_refused():
    with pytest.raises(GeometryError, match="has no faces"):
        el.bind(el.Mesh(np.zeros((0, 3)), np.zeros((0, 3), int)), halves())
    with pytest.raises(SceneError, match="there are no joints"):
        el.bind(tube(), ())
