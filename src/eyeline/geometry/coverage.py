"""Which pixels a face covers, in Python's own whole numbers, written to be read."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from eyeline.geometry.fixedpoint import BEFORE_CENTRE, CENTRE, UNITS

Corner = tuple[int, int, float]  # x and y in 1/256 pixel, depth
Rectangle = tuple[int, int, int, int]  # left, top, right, bottom, pixels; the borders are inside


def clockwise(corners: Sequence[Corner], sides: int) -> list[Corner] | None:
    """The corners of a face in clockwise order; None if it shows no side that counts.

    sides: 1 counts where a face turns counter-clockwise on the screen, 2 where it turns clockwise, 3 both.
    """
    (x0, y0, _), (x1, y1, _), (x2, y2, _) = corners
    area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    if area == 0 or not sides & (2 if area > 0 else 1):
        return None
    return list(corners) if area > 0 else [corners[0], corners[2], corners[1]]


def box_of(corners: Sequence[Corner], within: Rectangle) -> tuple[range, range]:
    """The columns and rows of a rectangle's pixels whose centres a face can cover."""
    left, top, right, bottom = within
    (x0, x1), (y0, y1) = (
        ((min(line) + BEFORE_CENTRE) >> 8, (max(line) + BEFORE_CENTRE) >> 8)
        for line in ([corner[0] for corner in corners], [corner[1] for corner in corners])
    )
    return range(max(x0, left), min(x1, right + 1)), range(max(y0, top), min(y1, bottom + 1))


def covered(corners: Sequence[Corner], within: Rectangle) -> Iterator[tuple[int, int]]:
    """The pixels (x, y) of a rectangle whose centres are inside a face, or on a top or left edge of it."""
    columns, rows = box_of(corners, within)
    edges = []
    for (ax, ay, _), (bx, by, _) in zip(corners, [*corners[1:], corners[0]], strict=True):
        a, b = ay - by, bx - ax
        left_or_top = a > 0 or (a == 0 and b > 0)
        edges.append((a, b, ax, ay, 0 if left_or_top else 1))
    for y in rows:
        for x in columns:
            px, py = UNITS * x + CENTRE, UNITS * y + CENTRE
            if all(a * (px - ax) + b * (py - ay) >= least for a, b, ax, ay, least in edges):
                yield x, y
