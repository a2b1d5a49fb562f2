"""Equal rows are found, and no others."""

from __future__ import annotations

import numpy as np
import pytest

from eyeline.geometry.weld import first_alike, welded


@pytest.mark.parametrize(("count", "spread"), [(0, 1), (1, 1), (300, 3), (300, 2**31 - 1), (5000, 12)])
def test_first_alike_is_the_first_of_equal_rows(count: int, spread: int) -> None:
    random = np.random.default_rng(count)
    rows = random.integers(-spread, spread, (count, 3)).astype(np.int32)
    known: dict[tuple[int, ...], int] = {}
    assert first_alike(rows).tolist() == [
        known.setdefault(tuple(row), k) for k, row in enumerate(rows.tolist())
    ]


def test_both_ways_of_welding_agree() -> None:
    rows = np.random.default_rng(5).integers(0, 6, (400, 3)).astype(np.float32) / 7
    first, index = welded(rows)
    assert first_alike(rows.view(np.int32)).tolist() == first[index].tolist()
