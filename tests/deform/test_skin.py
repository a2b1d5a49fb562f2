import math
from typing import Any

import numpy as np
import pytest

from eyeline.deform import skin
from eyeline.errors import GeometryError
from eyeline.geometry import quaternion, transform

BOTH = [skin.linear_blend, skin.dual_quaternion]
ONES = (1.0, 1.0, 1.0)


class Body:
    """Points on a ball, with normals and tangents, each following two of four joints."""

    def __init__(self, count: int = 500, seed: int = 0) -> None:
        rng = np.random.default_rng(seed)
        self.points = rng.normal(size=(count, 3)).astype(np.float32)
        self.normals = (self.points / np.linalg.norm(self.points, axis=1, keepdims=True)).astype(np.float32)
        across = np.cross(self.normals, (0.3, 0.5, 0.7))
        across /= np.linalg.norm(across, axis=1, keepdims=True)
        sides = rng.choice([-1.0, 1.0], (count, 1))
        self.tangents = np.concatenate([across, sides], axis=1).astype(np.float32)
        self.joints = rng.integers(0, 4, (count, 4)).astype(np.int32)
        influences = rng.random((count, 4)) * [1, 1, 0, 0]
        self.influences = (influences / influences.sum(axis=1, keepdims=True)).astype(np.float32)

    def moved(self, skinning: Any, matrices: np.ndarray) -> Any:
        return skinning(
            self.points,
            self.normals,
            self.tangents,
            self.joints,
            self.influences,
            np.asarray(matrices, float),
        )


def screws(seed: int, scale: object = ONES) -> np.ndarray:
    rng = np.random.default_rng(seed)
    turns = quaternion.normalized(rng.normal(size=(4, 4)))
    return transform.compose(rng.normal(size=(4, 3)), turns, np.broadcast_to(scale, (4, 3)))


def alone(matrix: np.ndarray) -> np.ndarray:
    return np.broadcast_to(matrix, (4, 4, 4))


@pytest.mark.parametrize("skinning", BOTH)
def test_joints_that_rest_change_nothing(skinning: Any) -> None:
    body = Body()
    points, normals, tangents = body.moved(skinning, alone(np.eye(4)))
    for found, given in ((points, body.points), (normals, body.normals), (tangents, body.tangents)):
        assert found.dtype == np.float32
        assert np.allclose(found, given, rtol=0, atol=2e-7)


@pytest.mark.parametrize("skinning", BOTH)
def test_a_rigid_joint_keeps_distances(skinning: Any) -> None:
    body = Body()
    points, _, _ = body.moved(skinning, alone(screws(1)[0]))
    before = np.linalg.norm(body.points[1:].astype(float) - body.points[:-1], axis=1)
    after = np.linalg.norm(points[1:].astype(float) - points[:-1], axis=1)
    assert np.allclose(after, before, rtol=0, atol=2e-6)


@pytest.mark.parametrize("skinning", BOTH)
@pytest.mark.parametrize("scale", [ONES, (2.0, 0.5, 3.0), (-1.0, 1.0, 1.0), (-2.0, 0.5, 1.0)])
def test_one_joint_alone_moves_all_as_its_matrix(skinning: Any, scale: tuple[float, ...]) -> None:
    body, matrix = Body(), screws(2, scale)[0]
    points, normals, tangents = body.moved(skinning, alone(matrix))
    upright = body.normals @ np.linalg.inv(matrix[:3, :3])
    along = body.tangents[:, :3] @ matrix[:3, :3].T
    assert np.allclose(points, transform.apply(matrix, body.points), rtol=0, atol=4e-6)
    assert np.allclose(normals, upright / np.linalg.norm(upright, axis=1, keepdims=True), rtol=0, atol=1e-6)
    assert np.allclose(
        tangents[:, :3], along / np.linalg.norm(along, axis=1, keepdims=True), rtol=0, atol=1e-6
    )


def test_a_shearing_joint_alone_moves_all_as_its_matrix() -> None:
    body, matrix = Body(), screws(3)[0]
    matrix[:3, 1] += 0.4 * matrix[:3, 0]
    points, _, _ = body.moved(skin.dual_quaternion, alone(matrix))
    assert np.allclose(points, transform.apply(matrix, body.points), rtol=0, atol=4e-6)


@pytest.mark.parametrize("skinning", BOTH)
def test_a_mirror_turns_the_side_of_tangents_only(skinning: Any) -> None:
    body = Body()
    _, normals, tangents = body.moved(skinning, alone(np.diag([-1.0, 1, 1, 1])))
    assert np.allclose(normals, body.normals * [-1, 1, 1], rtol=0, atol=1e-6)
    assert np.array_equal(tangents[:, 3], -body.tangents[:, 3])


@pytest.mark.parametrize("skinning", BOTH)
def test_normals_stay_upright_on_stretched_surfaces(skinning: Any) -> None:
    body = Body()
    _, normals, tangents = body.moved(skinning, screws(4, (3.0, 1.0, 0.3)))
    assert np.abs((normals * tangents[:, :3]).sum(axis=1)).max() < 1e-6


def test_linear_blending_is_the_mean_of_the_joints() -> None:
    body, matrices = Body(), screws(5, (2.0, 1.0, 0.5))
    points, _, _ = body.moved(skin.linear_blend, matrices)
    each = np.einsum("vkij,vj->vki", matrices[body.joints][..., :3, :3], body.points.astype(float))
    each += matrices[body.joints][..., :3, 3]
    expected = (each * body.influences[..., None]).sum(axis=1)
    assert np.allclose(points, expected, rtol=0, atol=2e-6)


def test_dual_quaternions_equal_the_slow_twin() -> None:
    """Kavan's formula, one vertex after the other, in plain quaternions."""
    body, matrices = Body(60), screws(6)
    found, _, _ = body.moved(skin.dual_quaternion, matrices)
    shift, turn, _ = transform.decompose(matrices)
    half = quaternion.multiply(np.concatenate([shift / 2, np.zeros((4, 1))], axis=1), turn)
    for point, joints, influences, answer in zip(
        body.points, body.joints, body.influences, found, strict=True
    ):
        heaviest = turn[joints[influences.argmax()]]
        sides = np.where((turn[joints] * heaviest).sum(axis=1) < 0, -1, 1) * influences
        real, dual = (sides[:, None] * turn[joints]).sum(axis=0), (sides[:, None] * half[joints]).sum(axis=0)
        length = np.linalg.norm(real)
        conjugate = real * [-1, -1, -1, 1] / length
        moved = quaternion.multiply(quaternion.multiply(real / length, [*point, 0]), conjugate)
        moved += 2 * quaternion.multiply(dual / length, conjugate)
        assert np.allclose(answer, moved[:3], rtol=0, atol=2e-6)


def test_a_twist_shared_by_two_joints_keeps_its_girth_in_dual_quaternions_and_loses_it_in_matrices() -> None:
    half_turn = quaternion.from_axis_angle((1, 0, 0), math.radians(170))
    matrices = transform.compose(np.zeros((2, 3)), np.stack([(0, 0, 0, 1), half_turn]), np.ones((2, 3)))
    ring = np.array([[0, 1, 0]], np.float32)
    joints, influences = np.array([[0, 1]], np.int32), np.array([[0.5, 0.5]], np.float32)
    linear, _, _ = skin.linear_blend(ring, None, None, joints, influences, matrices)
    screw, _, _ = skin.dual_quaternion(ring, None, None, joints, influences, matrices)
    assert math.isclose(np.linalg.norm(linear), math.cos(math.radians(85)), rel_tol=1e-6)
    assert math.isclose(np.linalg.norm(screw), 1, rel_tol=1e-6)


def test_opposite_quaternions_of_near_turns_take_the_short_way() -> None:
    """Just below and just above a half turn, w has either sign in the matrices' own quaternions."""
    angles = np.radians([179, 181])
    turns = quaternion.from_axis_angle((0, 0, 1), angles)
    matrices = transform.compose(np.zeros((2, 3)), turns, np.ones((2, 3)))
    point = np.array([[1, 0, 0]], np.float32)
    joints, influences = np.array([[0, 1]], np.int32), np.array([[0.5, 0.5]], np.float32)
    found, _, _ = skin.dual_quaternion(point, None, None, joints, influences, matrices)
    assert np.allclose(found, [[-1, 0, 0]], rtol=0, atol=1e-6)


@pytest.mark.parametrize("skinning", BOTH)
def test_influences_count_as_parts_of_their_sum(skinning: Any) -> None:
    body = Body()
    whole = body.moved(skinning, screws(7))
    body.influences = body.influences * np.float32(4)
    for found, expected in zip(body.moved(skinning, screws(7)), whole, strict=True):
        assert np.array_equal(found, expected)


@pytest.mark.parametrize("skinning", BOTH)
def test_a_vertex_without_influence_follows_its_first_joint(skinning: Any) -> None:
    body, matrices = Body(), screws(8)
    body.influences = np.zeros_like(body.influences)
    points, _, _ = body.moved(skinning, matrices)
    expected = [
        transform.apply(matrices[j], p[None])[0] for j, p in zip(body.joints[:, 0], body.points, strict=True)
    ]
    assert np.allclose(points, expected, rtol=0, atol=2e-6)


@pytest.mark.parametrize("skinning", BOTH)
def test_a_joint_of_no_size_leaves_numbers(skinning: Any) -> None:
    body = Body()
    matrix = transform.compose((1, 2, 3), (0, 0, 0, 1), (0, 0, 0))
    points, normals, tangents = body.moved(skinning, alone(matrix))
    assert np.allclose(points, (1, 2, 3), rtol=0, atol=1e-6)
    assert np.array_equal(normals, body.normals)
    assert np.array_equal(tangents, body.tangents)


@pytest.mark.parametrize("skinning", BOTH)
@pytest.mark.parametrize("influences", [1, 4, 8])
def test_any_number_of_influences(skinning: Any, influences: int) -> None:
    """The same joint, named over and over, is that joint alone."""
    body, matrices = Body(), screws(9)
    body.joints = np.repeat(body.joints[:, :1], influences, axis=1)
    body.influences = np.full((len(body.points), influences), 1 / influences, np.float32)
    points, _, _ = body.moved(skinning, matrices)
    each = np.stack(
        [
            transform.apply(matrices[j], p[None])[0]
            for j, p in zip(body.joints[:, 0], body.points, strict=True)
        ]
    )
    assert np.allclose(points, each, rtol=0, atol=4e-6)


@pytest.mark.parametrize("skinning", BOTH)
def test_what_a_mesh_lacks_is_not_made(skinning: Any) -> None:
    body = Body()
    given = (body.points, None, None, body.joints, body.influences, screws(10))
    points, normals, tangents = skinning(*given)
    assert normals is None
    assert tangents is None
    assert np.array_equal(points, body.moved(skinning, screws(10))[0])


@pytest.mark.parametrize("skinning", BOTH)
def test_threads_do_not_change_a_byte(skinning: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    body = Body(5000)
    answers = []
    for count in (1, 2, 3):
        monkeypatch.setattr(skin, "threads", lambda count=count: count)
        answers.append([one.tobytes() for one in body.moved(skinning, screws(11, (1.0, 2.0, 1.0)))])
    assert answers[0] == answers[1] == answers[2]


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"joints": np.full((500, 4), 4)}, "follow joints 4 to 4; there are 4"),
        ({"joints": np.full((500, 4), -1)}, "follow joints -1 to -1"),
        ({"joints": np.zeros((500, 3))}, "must both be (500, K)"),
        ({"joints": np.zeros((500, 0)), "influences": np.zeros((500, 0))}, "must both be (500, K), K > 0"),
        ({"points": np.zeros((400, 3))}, "must both be (400, K)"),
        ({"normals": np.zeros((400, 3))}, "500 rows each"),
    ],
)
def test_arrays_that_do_not_fit_are_refused(change: dict[str, np.ndarray], sentence: str) -> None:
    body = Body()
    for name, array in change.items():
        setattr(body, name, array)
    for skinning in BOTH:
        with pytest.raises(GeometryError) as refusal:
            body.moved(skinning, alone(np.eye(4)))
        assert sentence in str(refusal.value)
