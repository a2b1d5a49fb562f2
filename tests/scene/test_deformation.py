import math

import numpy as np
import pytest

from eyeline.errors import GeometryError, SceneError
from eyeline.geometry import quaternion, transform
from eyeline.motion import Clip, Curve, Track
from eyeline.scene.mesh import Mesh, MorphTarget
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene
from eyeline.scene.skin import Skin

POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [1, 2, 0]], np.float32)
FACES = [[0, 1, 2], [2, 1, 3]]
UPRIGHT = np.tile(np.float32([[0, 0, 1]]), (4, 1))


def strip(**values: object) -> Mesh:
    """Two triangles whose lower points follow joint 0 and whose upper points follow joint 1."""
    joints, influences = [[0], [0], [1], [1]], [[1], [1], [1], [1]]
    return Mesh(POINTS, FACES, UPRIGHT, joints=joints, influences=influences, **values)


def rig(root: np.ndarray | None = None, blending: str = "linear", **values: object) -> Scene:
    """A strip bound to a hip at the origin and a neck one metre above it; its own node stands far away."""
    inverse = np.stack([np.eye(4), np.linalg.inv(transform.compose((0, 1, 0), (0, 0, 0, 1), (1, 1, 1)))])
    nodes = (
        Node("root", matrix=np.eye(4) if root is None else root),
        Node("hip", parent=0),
        Node("neck", parent=1, translation=(0, 1, 0)),
        Node("body", translation=(50, 60, 70), mesh=strip(**values), skin=Skin((1, 2), inverse, blending)),
    )
    quarter = quaternion.from_axis_angle((1, 0, 0), math.pi / 2)
    nod = Track("node", "root/hip/neck", "rotation", Curve([0, 1], [(0, 0, 0, 1), quarter], rotation=True))
    return Scene(nodes, (Clip("nod", [nod]),))


@pytest.mark.parametrize("blending", ["linear", "dual_quaternion"])
def test_skinned_points_follow_their_joints_in_the_world_wherever_their_node_is(blending: str) -> None:
    surface = rig(blending=blending).at(1).surfaces[0]
    assert np.allclose(surface.mesh.points, [[0, 0, 0], [1, 0, 0], [0, 1, 1], [1, 1, 1]], rtol=0, atol=1e-6)
    assert np.allclose(surface.mesh.normals[2], (0, -1, 0), rtol=0, atol=1e-6)
    assert np.array_equal(surface.world_from_mesh, np.eye(4))
    assert not surface.mirrored


def test_a_mirrored_skeleton_mirrors_its_surface() -> None:
    mirror = np.diag([-1.0, 1, 1, 1])
    plain, mirrored = rig().at(0.4).surfaces[0], rig(mirror).at(0.4).surfaces[0]
    assert mirrored.mirrored
    expected = transform.apply(mirror, plain.mesh.points)
    found = transform.apply(mirrored.world_from_mesh, mirrored.mesh.points)
    assert np.allclose(found, expected, rtol=0, atol=1e-6)


def test_what_nothing_bends_stays_the_same_object() -> None:
    mesh = Mesh(POINTS, FACES, targets=[MorphTarget(POINTS)])
    scene = Scene.of(Node("a", mesh=mesh), Node("b", mesh=mesh, weights=(0.0,)))
    assert all(surface.mesh is mesh for surface in scene.surfaces)


def test_a_skinned_mesh_without_joints_stands_at_its_node() -> None:
    mesh = Mesh(POINTS, FACES)
    skin = Skin((0,), np.eye(4)[None])
    surface = Scene.of(Node("a", translation=(1, 2, 3), mesh=mesh, skin=skin)).surfaces[0]
    assert surface.mesh is mesh
    assert surface.world_from_mesh[:3, 3].tolist() == [1, 2, 3]


def test_weights_of_the_node_win_over_those_of_the_mesh() -> None:
    mesh = Mesh(POINTS, FACES, targets=[MorphTarget(np.ones((4, 3), np.float32))], weights=[0.5])
    scene = Scene.of(Node("own", mesh=mesh), Node("other", mesh=mesh, weights=(2.0,)))
    own, other = (surface.mesh.points for surface in scene.surfaces)
    assert np.array_equal(own, POINTS + 0.5)
    assert np.array_equal(other, POINTS + 2)


def test_every_attribute_morphs() -> None:
    one = np.ones((4, 4), np.float32)
    target = MorphTarget(one[:, :3], normals=-one[:, :3], tangents=one[:, :3], uv=(one[:, :2],), colors=one)
    mesh = Mesh(
        POINTS,
        FACES,
        UPRIGHT,
        np.tile([[1, 0, 0, -1]], (4, 1)),
        [np.zeros((4, 2))] * 2,
        one / 2,
        targets=[target],
    )
    found = Scene.of(Node("a", mesh=mesh, weights=(1.0,))).surfaces[0].mesh
    assert np.array_equal(found.points, POINTS + 1)
    assert np.allclose(found.normals, np.array([[-1, -1, 0]]) / math.sqrt(2), rtol=0, atol=1e-6)
    assert np.allclose(
        found.tangents, [np.array([2, 1, 1, -math.sqrt(6)]) / math.sqrt(6)] * 4, rtol=0, atol=1e-6
    )
    assert np.array_equal(found.uv[0], one[:, :2])
    assert found.uv[1] is mesh.uv[1]
    assert np.array_equal(found.colors, one)


def test_flat_meshes_stay_flat() -> None:
    mesh = Mesh(POINTS, FACES, targets=[MorphTarget(POINTS, normals=UPRIGHT)])
    assert Scene.of(Node("a", mesh=mesh, weights=(1.0,))).surfaces[0].mesh.normals is None


def test_a_mesh_is_morphed_before_its_joints_take_it_along() -> None:
    scene = rig(targets=[MorphTarget(np.tile(np.float32([[0, 0, 1]]), (4, 1)))], weights=[1.0])
    assert np.allclose(scene.at(1).surfaces[0].mesh.points[2], (0, 0, 1), rtol=0, atol=1e-6)


def test_bounds_hold_what_the_joints_moved() -> None:
    bounds = rig().at(1).bounds
    assert np.allclose([bounds.low, bounds.high], [[0, 0, 0], [1, 1, 1]], rtol=0, atol=1e-6)


def test_a_joint_that_the_skin_does_not_have_is_refused() -> None:
    mesh = Mesh(POINTS, FACES, joints=[[0], [0], [5], [0]], influences=np.ones((4, 1)))
    scene = Scene.of(Node("a", mesh=mesh, skin=Skin((0,), np.eye(4)[None])))
    with pytest.raises(GeometryError, match="follow joints 0 to 5; there are 1"):
        _ = scene.surfaces


def test_a_joint_that_is_no_node_is_refused() -> None:
    mesh = Mesh(POINTS, FACES, joints=[[0]] * 4, influences=np.ones((4, 1)))
    scene = Scene.of(Node("a", mesh=mesh, skin=Skin((7,), np.eye(4)[None])))
    with pytest.raises(SceneError, match=r"joints \(7,\); the scene has 1 nodes"):
        _ = scene.surfaces


def test_a_skin_needs_a_matrix_for_each_joint() -> None:
    with pytest.raises(GeometryError, match=r"2 joints and matrices of shape \(1, 4, 4\)"):
        Skin((0, 1), np.eye(4)[None])
    with pytest.raises(GeometryError, match="blends 'cubic'"):
        Skin((0,), np.eye(4)[None], "cubic")


def test_a_target_that_does_not_fit_is_refused() -> None:
    mesh = Mesh(POINTS, FACES, targets=[MorphTarget(POINTS[:2])])
    with pytest.raises(GeometryError, match=r"morph target 0 has shape \(2, 3\); \(4, 3\) is needed"):
        _ = Scene.of(Node("a", mesh=mesh, weights=(1.0,))).surfaces


def test_weights_that_do_not_fit_are_refused() -> None:
    mesh = Mesh(POINTS, FACES, targets=[MorphTarget(POINTS)], name="face")
    scene = Scene.of(Node("a", mesh=mesh, weights=(1.0, 2.0)))
    for use in (lambda: scene.surfaces, lambda: scene.sample([0])):
        with pytest.raises(SceneError, match="node 'a' has 2 weights for 1 morph targets"):
            use()
