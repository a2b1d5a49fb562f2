"""Single rays: the face that brute force finds, and no way out of a closed mesh."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import soups
from eyeline.geometry.bvh import bvh_of
from eyeline.geometry.crossing import exact_cross
from eyeline.geometry.rays import blocked, first_hits

RAYS = 100_000
by_chance = settings(max_examples=40, deadline=None, derandomize=True)


def unit(random: np.random.Generator, count: int) -> np.ndarray:
    """Directions, evenly over the sphere."""
    vectors = random.normal(size=(count, 3))
    return vectors / np.sqrt((vectors**2).sum(axis=1, keepdims=True))


def cube(cells: int) -> tuple[np.ndarray, np.ndarray]:
    """The closed cube -1..1, its sides cut into squares: rays along its lines meet exact zeros."""
    line = np.linspace(-1, 1, cells + 1)
    at = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).reshape(-1)
    square = np.concatenate(
        [np.stack([at, at + cells + 1, at + cells + 2], 1), np.stack([at, at + cells + 2, at + 1], 1)]
    )
    points, faces = [], []
    for axis in range(3):
        for side in (-1.0, 1.0):
            side_points = np.empty(((cells + 1) ** 2, 3))
            side_points[:, axis] = side
            u, v = np.meshgrid(line, line, indexing="ij")
            side_points[:, (axis + 1) % 3], side_points[:, (axis + 2) % 3] = u.reshape(-1), v.reshape(-1)
            faces.append(square + len(points) * len(side_points))
            points.append(side_points)
    return np.concatenate(points).astype(np.float32), np.concatenate(faces).astype(np.int32)


def ball() -> tuple[np.ndarray, np.ndarray]:
    points, faces = soups.ball(40)
    return points.astype(np.float32), faces.astype(np.int32)


def targets(kind: str, points: np.ndarray, faces: np.ndarray, random: np.random.Generator) -> np.ndarray:
    """Places (RAYS, 3) to aim at."""
    face = faces[random.integers(0, len(faces), RAYS)]
    if kind == "vertices":
        return points[face[:, 0]]
    if kind == "edges":
        return (points[face[:, 0]] + points[face[:, 1]]) * np.float32(0.5)
    return unit(random, RAYS).astype(np.float32) * np.float32(9)


@pytest.mark.parametrize("kind", ["anywhere", "vertices", "edges"])
@pytest.mark.parametrize(
    ("mesh", "scale", "shift"),
    [
        (cube(16), (1, 1, 1), 0.0),
        (ball(), (1, 1, 1), 0.0),
        (ball(), (1e-4, 1e-4, 1e-4), 0.0),
        (ball(), (1, 1, 1e-3), 0.0),
        (ball(), (1, 1, 1), 1000.0),
    ],
)
def test_no_ray_leaves_a_closed_mesh(kind: str, mesh, scale: tuple[float, ...], shift: float) -> None:
    points = (mesh[0] * np.float32(scale) + np.float32(shift)).astype(np.float32)
    random = np.random.default_rng(7)
    tree = bvh_of(points, mesh[1])
    for reach in (0.0, 0.5):  # all from the middle, and from anywhere near it
        origins = unit(random, RAYS) * random.random((RAYS, 1)) * reach * scale + shift
        origins = origins.astype(np.float32)
        directions = targets(kind, points, mesh[1], random) - (origins if kind != "anywhere" else 0)
        far = np.full(RAYS, np.inf, np.float32)
        assert (first_hits(tree, origins, directions).face < 0).sum() == 0
        assert (~blocked(tree, origins, directions, far)).sum() == 0


def test_rays_along_the_axes_from_lines_of_the_mesh_stay_inside() -> None:
    random = np.random.default_rng(1)
    points, faces = cube(16)
    origins = np.linspace(-1, 1, 17)[1:-1][random.integers(0, 15, (RAYS, 3))].astype(np.float32)
    directions = np.zeros((RAYS, 3), np.float32)
    directions[np.arange(RAYS), random.integers(0, 3, RAYS)] = random.choice([-1.0, 1.0], RAYS)
    assert (first_hits(bvh_of(points, faces), origins, directions).face < 0).sum() == 0


def brute_force(corners: np.ndarray, origin: np.ndarray, direction: np.ndarray) -> tuple[int, float, float]:
    """(face, length, the next length) by Cramer's rule over all faces."""
    a, b, c = (corners[:, k].astype(float) - origin for k in range(3))
    normal = np.cross(b - a, c - a)
    volumes = [np.cross(p, q) @ direction for p, q in ((b, c), (c, a), (a, b))]
    inside = np.logical_and.reduce([v > 0 for v in volumes]) | np.logical_and.reduce([v < 0 for v in volumes])
    with np.errstate(divide="ignore", invalid="ignore"):
        length = (normal * a).sum(axis=1) / (normal @ direction)
    length = np.where(inside & (length > 0), length, np.inf)
    order = np.argsort(length, kind="stable")
    first = length[order[0]]
    return (int(order[0]) if np.isfinite(first) else -1), float(first), float(length[order[1]])


@by_chance
@given(seed=st.integers(0, 10**6))
def test_the_first_face_is_the_one_that_brute_force_finds(seed: int) -> None:
    random = np.random.default_rng(seed)
    points = (random.normal(size=(120, 3)) * 10 ** random.uniform(-2, 1, (120, 1))).astype(np.float32)
    faces = random.integers(0, 120, (90, 3)).astype(np.int32)
    origins = random.normal(size=(50, 3)).astype(np.float32)
    directions = unit(random, 50).astype(np.float32)
    directions[::7, 0] = 0
    tree = bvh_of(points, faces)
    hits = first_hits(tree, origins, directions)
    for ray in range(50):
        face, length, after = brute_force(
            points[faces], origins[ray].astype(float), directions[ray].astype(float)
        )
        apart = after - length > 1e-5 * length
        if face < 0 or apart:
            assert hits.face[ray] == face
        assert hits.length[ray] == pytest.approx(length, rel=1e-4)
    reach = np.where(np.isfinite(hits.length), hits.length, 1).astype(np.float32)
    assert np.array_equal(blocked(tree, origins, directions, reach), hits.face >= 0)
    assert not blocked(tree, origins, directions, reach * np.float32(0.999))[hits.face >= 0].any()


def test_equal_lengths_go_to_the_lower_face() -> None:
    points, faces = cube(4)
    random = np.random.default_rng(2)
    directions = unit(random, 1000).astype(np.float32)
    twice = np.concatenate([faces[::-1], faces])
    hits = first_hits(bvh_of(points, twice), np.zeros((1000, 3), np.float32), directions)
    assert (hits.face >= 0).all()
    assert (hits.face < len(faces)).all()


def test_nothing_is_met_where_nothing_stands() -> None:
    tree = bvh_of(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32))
    hits = first_hits(tree, np.zeros((5, 3)), np.ones((5, 3)))
    assert hits.face.tolist() == [-1] * 5
    assert np.isposinf(hits.length).all()
    assert not blocked(tree, np.zeros((5, 3)), np.ones((5, 3)), np.ones(5)).any()


def test_a_flat_face_is_met_by_no_ray() -> None:
    points = np.array([[0, 0, 0], [1, 1, 0], [2, 2, 0], [0, 0, 1]], np.float32)
    tree = bvh_of(points, np.array([[0, 1, 2], [3, 3, 3]], np.int32))
    towards = np.array([[1, 1, -1], [0, 0, 1]], np.float32)
    origins = np.array([[0, 0, 1], [0, 0, 0.5]], np.float32)
    assert first_hits(tree, origins, towards).face.tolist() == [-1, -1]


@by_chance
@given(seed=st.integers(0, 10**6))
def test_the_sign_of_a_cross_product_is_exact(seed: int) -> None:
    """Nearly parallel vectors, beside Python's whole numbers."""
    random = np.random.default_rng(seed)
    ax, ay = (int(one) for one in random.integers(2**51, 2**52, 2))
    factor = int(random.integers(1, 3))
    bx, by = ax * factor + int(random.integers(-1, 2)), ay * factor + int(random.integers(-1, 2))
    truth = ax * by - ay * bx
    assert np.sign(exact_cross(float(ax), float(ay), float(bx), float(by))) == np.sign(truth)
