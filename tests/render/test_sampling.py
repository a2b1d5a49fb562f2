from __future__ import annotations

import pytest

from eyeline.errors import OptionError
from eyeline.render.sampling import sample_positions

COUNTS = [1, 2, 4, 8, 16]


@pytest.mark.parametrize("count", COUNTS)
def test_every_sample_has_its_own_row_and_column(count: int) -> None:
    positions = sample_positions(count)
    assert len(positions) == count
    assert len({x for x, _ in positions}) == count
    assert len({y for _, y in positions}) == count


@pytest.mark.parametrize("count", COUNTS)
def test_samples_lie_in_the_pixel_and_around_its_centre(count: int) -> None:
    positions = sample_positions(count)
    assert all(-128 <= offset < 128 for position in positions for offset in position)
    # Their mean is off by at most half a step of the pattern's grid: pictures do not shift with the count.
    assert all(abs(sum(axis)) <= 8 * count for axis in zip(*positions, strict=True))


@pytest.mark.parametrize("count", [0, 3, -1, 32, 5])
def test_other_counts_are_refused(count: int) -> None:
    with pytest.raises(OptionError, match=f"samples is {count}; 1, 2, 4, 8, 16"):
        sample_positions(count)
