"""The one formula for depth, beside exact arithmetic; and who owns a centre on an edge."""

from __future__ import annotations

from fractions import Fraction
from itertools import permutations

import numpy as np

from eyeline.geometry.fixedpoint import BEFORE_CENTRE, depth_at, depth_plane, edge_bias


def faces(seed: int, count: int, reach: int) -> list[list[tuple[int, int, float]]]:
    """Clockwise faces of some extent: x, y in 1/256 pixel, depth."""
    random = np.random.default_rng(seed)
    found = []
    while len(found) < count:
        xy = random.integers(-reach, reach, (3, 2)).tolist()
        z = random.uniform(0, 1, 3).astype(np.float32)
        (x0, y0), (x1, y1), (x2, y2) = xy
        if (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0) > reach * reach / 8:
            found.append([(x, y, depth) for (x, y), depth in zip(xy, z, strict=True)])
    return found


def test_depth_is_the_plane_through_the_corners() -> None:
    for corners in faces(1, 50, 1 << 18):
        (x0, y0, z0), (x1, y1, z1), (x2, y2, z2) = [
            [Fraction(float(number)) for number in one] for one in corners
        ]
        a, b, c = depth_plane(*corners[0], *corners[1], *corners[2])
        for x, y in ((3, 5), (-40, 17), (800, 333)):
            px, py = Fraction(256 * x + 128), Fraction(256 * y + 128)
            area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
            first = ((px - x0) * (y2 - y0) - (x2 - x0) * (py - y0)) / area
            second = ((x1 - x0) * (py - y0) - (px - x0) * (y1 - y0)) / area
            exact = float(z0 + first * (z1 - z0) + second * (z2 - z0))
            assert abs(float(depth_at(a, b, c, x, y)) - exact) <= 2 * np.spacing(
                np.float32(max(1, abs(exact)))
            )


def test_a_face_has_one_plane_wherever_its_corners_begin() -> None:
    for corners in faces(2, 200, 5000):
        planes = {depth_plane(*corners[k], *corners[(k + 1) % 3], *corners[(k + 2) % 3]) for k in range(3)}
        assert len(planes) == 1


def test_an_edge_between_two_faces_has_one_owner() -> None:
    """The same edge leads one way around one face, and the other way around its neighbour."""
    for a, b in permutations((-7, -1, 0, 1, 7), 2):
        assert edge_bias(a, b) + edge_bias(-a, -b) == -1
    assert edge_bias(3, -2) == 0  # leads up: a left edge
    assert edge_bias(0, 4) == 0  # leads right: a top edge
    assert edge_bias(0, -4) == -1


def test_the_first_pixel_is_the_first_centre_not_before() -> None:
    for x in range(-600, 600):
        first = (x + BEFORE_CENTRE) >> 8
        assert 256 * first + 128 >= x > 256 * (first - 1) + 128
