"""The nearest face is the one brute force finds."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from eyeline.geometry.arrays import read_only
from eyeline.geometry.bvh import bvh_of
from eyeline.geometry.nearest import nearest, place_on_triangle


def distance_by_search(point: np.ndarray, triangle: np.ndarray) -> float:
    """The least over the plane's foot, where it is within, and the three edges."""
    a, b, c = triangle
    best = np.inf
    for begin, end in ((a, b), (b, c), (c, a)):
        way = end - begin
        t = np.clip((point - begin) @ way / max(way @ way, 1e-300), 0, 1)
        best = min(best, np.linalg.norm(point - begin - t * way))
    normal = np.cross(b - a, c - a)
    if normal @ normal > 0:
        q, r = np.linalg.lstsq(np.stack([b - a, c - a], axis=1), point - a, rcond=None)[0]
        if q >= 0 and r >= 0 and q + r <= 1:
            best = min(best, abs((point - a) @ normal) / np.linalg.norm(normal))
    return float(best)


@settings(derandomize=True, deadline=None, max_examples=40)
@given(st.integers(0, 2**32 - 1), st.integers(1, 60))
def test_nearest_is_what_brute_force_finds(seed: int, faces: int) -> None:
    random = np.random.default_rng(seed)
    points = random.normal(size=(3 * faces, 3)).astype(np.float32)
    triangles = points.astype(np.float64).reshape(-1, 3, 3)
    places = 2 * random.normal(size=(8, 3))
    tree = bvh_of(read_only(points), np.arange(3 * faces, dtype=np.int32).reshape(-1, 3))
    found = nearest(tree, places)
    for place, face, distance in zip(places, found.face, found.distance, strict=True):
        all_of_them = [distance_by_search(place, triangle) for triangle in triangles]
        np.testing.assert_allclose(distance, min(all_of_them), rtol=1e-6)
        np.testing.assert_allclose(all_of_them[face], min(all_of_them), rtol=1e-6)


def test_without_faces_nothing_is_near() -> None:
    found = nearest(bvh_of(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32)), np.zeros((2, 3)))
    assert found.face.tolist() == [-1, -1] and np.isinf(found.distance).all()


def test_a_triangle_without_area_is_its_edges() -> None:
    q, r = place_on_triangle(0.5, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0)
    assert (q + r, abs(q * 0.0)) == (0.5, 0.0)
