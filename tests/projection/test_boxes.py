"""What is told of a box holds for every vertex in it, and for the depth of every covered centre."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

import oracle
from eyeline.geometry.fixedpoint import CENTRE, greatest_depth
from eyeline.projection.boxes import box_on_grid, is_out_of_view
from eyeline.projection.vertices import place
from eyeline.scene.camera import Camera

SIZE = (200, 120)

by_chance = settings(max_examples=300, deadline=None, derandomize=True)
seeds = st.integers(0, 10**6)


def boxed(seed: int) -> tuple[np.ndarray, np.ndarray, tuple[np.float32, ...]]:
    """(clip_from_mesh, points with the corners of their box, the box): small and large, about the eye."""
    random = np.random.default_rng(seed)
    lens = {"height": 3.0, "near": -2.0, "far": 9.0} if seed % 3 == 2 else {"fov": 1.1, "near": 0.2}
    camera = Camera.look_at(random.normal(size=3), random.normal(size=3), **lens)
    matrix = camera.clip_from_eye(SIZE[0] / SIZE[1]) @ camera.eye_from_world
    low = random.normal(size=3) * 10 ** random.uniform(-1, 1.5)
    high = low + 10 ** random.uniform(-4, 1, 3) * (random.random(3) < 0.9)
    low, high = low.astype(np.float32), high.astype(np.float32)
    points = (low + (high - low) * random.random((50, 3))).astype(np.float32).clip(low, high)
    corners = np.array(np.meshgrid(*zip(low, high, strict=True))).reshape(3, -1).T.astype(np.float32)
    return matrix, np.concatenate([points, corners]), (*low, *high)


def placed(matrix: np.ndarray, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    xy, depth = np.empty((len(points), 2), np.int32), np.empty(len(points), np.float32)
    place(points, matrix, SIZE, xy, depth)
    return xy, depth


@by_chance
@given(seed=seeds)
def test_every_vertex_in_a_box_falls_where_the_box_says(seed: int) -> None:
    matrix, points, box = boxed(seed)
    m = tuple(matrix.astype(np.float32).reshape(-1))
    half = (np.float32(side * CENTRE) for side in SIZE)
    sure, left, top, right, bottom, far, near = box_on_grid(m, *half, box)
    xy, depth = placed(matrix, points)
    if sure:
        assert np.isfinite(depth).all()
        assert (xy >= (left, top)).all()
        assert (xy <= (right, bottom)).all()
        assert far <= depth.min()
        assert depth.max() <= near


@by_chance
@given(seed=seeds)
def test_no_vertex_in_a_box_out_of_view_is_in_the_picture(seed: int) -> None:
    matrix, points, box = boxed(seed)
    if is_out_of_view(tuple(matrix.astype(np.float32).reshape(-1)), *SIZE, box):
        xy, depth = placed(matrix, points)
        within = (depth < np.inf) & (xy >= -256).all(axis=1) & (xy <= np.array(SIZE) * 256 + 256).all(axis=1)
        assert not within.any()


def test_boxes_are_both_sure_and_out_of_view_often_enough_to_tell() -> None:
    sure, out = 0, 0
    for seed in range(300):
        matrix, _, box = boxed(seed)
        m = tuple(matrix.astype(np.float32).reshape(-1))
        sure += bool(box_on_grid(m, *(np.float32(side * CENTRE) for side in SIZE), box)[0])
        out += bool(is_out_of_view(m, *SIZE, box))
    assert 50 < sure < 290
    assert 50 < out < 290


@by_chance
@given(seed=seeds, thin=st.booleans(), far_away=st.booleans())
def test_no_depth_of_a_face_exceeds_the_bound_of_its_box(seed: int, thin: bool, far_away: bool) -> None:
    """Slivers too, whose slope is steep, and faces far beyond the picture, where columns are large."""
    random = np.random.default_rng(seed)
    reach = 2**23 - 1 if far_away else 256 * 40
    xy = random.integers(-reach, reach, (3, 2))
    if thin:
        xy[2] = xy[1] + random.integers(-2, 3, 2)
    z = (random.random(3) * 10 ** random.uniform(-6, 0)).astype(np.float32)
    covered, depth = oracle.one_face(xy.astype(np.int32), z, 3, (40, 40))
    across, down = np.ptp(xy, axis=0)
    bound = greatest_depth(z.min(), z.max(), int(across), int(down))
    assert bound >= z.max()
    if covered.any():
        assert depth[covered].max() <= bound


def test_of_a_level_box_the_bound_is_its_depth() -> None:
    for depth in np.random.default_rng(0).random(100).astype(np.float32):
        assert greatest_depth(depth, depth, 1 << 24, 1 << 24) == depth
