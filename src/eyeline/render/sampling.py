"""Where in a pixel the samples of antialiasing lie."""

from __future__ import annotations

from eyeline.errors import OptionError

# Every row and every column of the pixel's grid holds one sample (n rooks), so that near-horizontal and
# near-vertical edges get as many grey levels as there are samples. The standard multisample positions of
# [Direct3D 11, D3D11_STANDARD_MULTISAMPLE_PATTERN], in 1/16 pixel from its centre.
SIXTEENTHS: dict[int, tuple[tuple[int, int], ...]] = {
    1: ((0, 0),),
    2: ((4, 4), (-4, -4)),
    4: ((-2, -6), (6, -2), (-6, 2), (2, 6)),
    8: ((1, -3), (-1, 3), (5, 1), (-3, -5), (-5, 5), (-7, -1), (3, 7), (7, -7)),
    16: (
        (1, 1), (-1, -3), (-3, 2), (4, -1), (-5, -2), (2, 5), (5, 3), (3, -5),
        (-2, 6), (0, -7), (-4, -6), (-6, 4), (-8, 0), (7, -4), (6, 7), (-7, -8),
    ),
}  # fmt: skip


def sample_positions(samples: int) -> tuple[tuple[int, int], ...]:
    """(dx, dy) of each sample, 1/256 pixel from the pixel's centre."""
    if samples not in SIXTEENTHS:
        raise OptionError(
            f"samples is {samples}; {', '.join(map(str, SIXTEENTHS))} samples a pixel are there"
        )
    return tuple((16 * dx, 16 * dy) for dx, dy in SIXTEENTHS[samples])
