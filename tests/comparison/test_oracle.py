"""The judge of methods: every face is looked at where it may be, and only there."""

from __future__ import annotations

import numpy as np
import pytest

import soups
from eyeline.comparison.oracle import screened, truth

SIZE = (48, 32)


@pytest.mark.parametrize("seed", range(40))
def test_nothing_is_covered_beyond_a_face_s_box(seed: int) -> None:
    faces = screened(*soups.around_the_eye(seed), SIZE, "none")
    rows, columns = (places.reshape(-1) + 0.5 for places in np.mgrid[: SIZE[1], : SIZE[0]])
    for face, (left, top, right, bottom) in enumerate(faces.boxes):
        _, maybe, _, _ = faces.at(columns, rows, np.full(len(columns), face))
        outside = ~((left < columns) & (columns < right) & (top < rows) & (rows < bottom))
        assert not (maybe & outside).any(), face


@pytest.mark.parametrize("seed", range(12))
def test_a_pixel_is_as_decidable_alone_as_in_the_picture(seed: int) -> None:
    scene, camera = soups.around_the_eye(seed)
    faces, whole = screened(scene, camera, SIZE), truth(scene, camera, SIZE).decidable
    alone = [[faces.is_decidable(column, row) for column in range(SIZE[0])] for row in range(SIZE[1])]
    assert np.array_equal(whole, alone)
    assert whole.mean() > 0.3


@pytest.mark.parametrize("block", [1, 1000])
def test_how_many_faces_are_looked_at_together_does_not_matter(
    block: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = soups.around_the_eye(3)
    together = truth(*seen, SIZE)
    monkeypatch.setattr("eyeline.comparison.oracle.BLOCK", block)
    alone = truth(*seen, SIZE)
    assert np.array_equal(alone.face, together.face)
    assert np.array_equal(alone.decidable, together.decidable)
