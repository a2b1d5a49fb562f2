"""Martin Newell's teapot of 1975: the control points of its 32 bicubic Bezier patches. [Newell75, Crow87]

Of the 306 points (290 places) most are others turned or mirrored, so only the outlines are written here:
rim, body, lid and bottom turn about the axis, handle and spout are mirrored in the plane y = 0. z is up.
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.arrays import FloatArray

HEIGHT = 3.15  # of the knob above the table, in Newell's units
QUARTER = 0.56  # a quarter circle's inner control points, as Newell rounded 0.5523
KNOB_QUARTER = 0.5625  # the widest ring of the knob is rounded otherwise: 0.45 of 0.8

# (radius, height) from below and inside to above and outside; four points a patch, neighbours share one
BODY = (
    ((2.0, 0.9), (2.0, 0.45), (1.5, 0.225), (1.5, 0.15)),
    ((1.5, 2.4), (1.75, 1.875), (2.0, 1.35), (2.0, 0.9)),
)
RIM = (((1.4, 2.4), (1.3375, 2.53125), (1.4375, 2.53125), (1.5, 2.4)),)
LID = ((0.0, 3.15), (0.8, 3.15), (0.0, 2.85), (0.2, 2.7)), ((0.2, 2.7), (0.4, 2.55), (1.3, 2.55), (1.3, 2.4))
BOTTOM = (((1.5, 0.15), (1.5, 0.075), (1.425, 0.0), (0.0, 0.0)),)

# Rows run along the part; a row goes half around, from the plane of symmetry to the plane of symmetry
HANDLE = (
    ((-1.6, 0, 2.025), (-1.6, -0.3, 2.025), (-1.5, -0.3, 2.25), (-1.5, 0, 2.25)),
    ((-2.3, 0, 2.025), (-2.3, -0.3, 2.025), (-2.5, -0.3, 2.25), (-2.5, 0, 2.25)),
    ((-2.7, 0, 2.025), (-2.7, -0.3, 2.025), (-3.0, -0.3, 2.25), (-3.0, 0, 2.25)),
    ((-2.7, 0, 1.8), (-2.7, -0.3, 1.8), (-3.0, -0.3, 1.8), (-3.0, 0, 1.8)),
    ((-2.7, 0, 1.575), (-2.7, -0.3, 1.575), (-3.0, -0.3, 1.35), (-3.0, 0, 1.35)),
    ((-2.5, 0, 1.125), (-2.5, -0.3, 1.125), (-2.65, -0.3, 0.9375), (-2.65, 0, 0.9375)),
    ((-2.0, 0, 0.9), (-2.0, -0.3, 0.9), (-1.9, -0.3, 0.6), (-1.9, 0, 0.6)),
)
SPOUT = (
    ((1.7, 0, 1.425), (1.7, -0.66, 1.425), (1.7, -0.66, 0.6), (1.7, 0, 0.6)),
    ((2.6, 0, 1.425), (2.6, -0.66, 1.425), (3.1, -0.66, 0.825), (3.1, 0, 0.825)),
    ((2.3, 0, 2.1), (2.3, -0.25, 2.1), (2.4, -0.25, 2.025), (2.4, 0, 2.025)),
    ((2.7, 0, 2.4), (2.7, -0.25, 2.4), (3.3, -0.25, 2.4), (3.3, 0, 2.4)),
    ((2.8, 0, 2.475), (2.8, -0.25, 2.475), (3.525, -0.25, 2.49375), (3.525, 0, 2.49375)),
    ((2.9, 0, 2.475), (2.9, -0.15, 2.475), (3.45, -0.15, 2.5125), (3.45, 0, 2.5125)),
    ((2.8, 0, 2.4), (2.8, -0.15, 2.4), (3.2, -0.15, 2.4), (3.2, 0, 2.4)),
)


def patches() -> dict[str, FloatArray]:
    """The control points (P, 4, 4, 3) of each part, z up; rows x columns point outwards."""
    return {
        "body": np.concatenate([turned(outline) for outline in (*BODY, *RIM, *BOTTOM)]),
        "lid": np.concatenate([turned(outline) for outline in LID]),
        "handle": mirrored(HANDLE),
        "spout": mirrored(SPOUT),
    }


def turned(outline: tuple[tuple[float, float], ...]) -> FloatArray:
    """(4, 4, 4, 3) the four quarters of an outline (4, 2) that turns about z, as seen from above."""
    radius, height = np.array(outline).T
    inner = np.where(radius == 0.8, KNOB_QUARTER, QUARTER)
    one, part, none = np.ones(4), inner, np.zeros(4)
    x, y = radius * [one, one, part, none], radius * [none, part, one, one]
    quarters = [(x, y), (-y, x), (-x, -y), (y, -x)]
    return np.stack(
        [np.stack([x, y, np.broadcast_to(height, x.shape)], axis=-1)[:, ::-1] for x, y in quarters]
    )


def mirrored(rows: tuple[tuple[tuple[float, float, float], ...], ...]) -> FloatArray:
    """(4, 4, 4, 3) two patches along the part, and their images in the plane y = 0."""
    half = np.array(rows, dtype=np.float64)[:, ::-1]
    image = half[:, ::-1] * (1, -1, 1)
    return np.stack([half[:4], half[3:], image[:4], image[3:]])
