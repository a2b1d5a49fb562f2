"""The judge of methods: every face is looked at where it may be, and only there."""

from __future__ import annotations

import numpy as np
import pytest

import soups
from eyeline.comparison.oracle import against, boxes, clip_corners, is_decidable, truth

SIZE = (48, 32)


@pytest.mark.parametrize("seed", range(40))
def test_nothing_is_covered_beyond_a_face_s_box(seed: int) -> None:
    scene, camera = soups.around_the_eye(seed)
    corners, sides = clip_corners(scene, camera, SIZE, "none")
    rows, columns = np.mgrid[: SIZE[1], : SIZE[0]] + 0.5
    for face, box in enumerate(boxes(corners, SIZE)):
        _, maybe, _, _ = against(corners[face], sides[face], columns, rows, SIZE)
        if box is not None:
            maybe[box] = False
        assert not maybe.any(), face


@pytest.mark.parametrize("seed", range(12))
def test_a_pixel_is_as_decidable_alone_as_in_the_picture(seed: int) -> None:
    scene, camera = soups.around_the_eye(seed)
    corners, sides = clip_corners(scene, camera, SIZE, "auto")
    whole = truth(scene, camera, SIZE).decidable
    alone = [
        [is_decidable(corners, sides, SIZE, column, row) for column in range(SIZE[0])]
        for row in range(SIZE[1])
    ]
    assert np.array_equal(whole, alone)
    assert whole.mean() > 0.3
