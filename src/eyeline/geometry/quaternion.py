"""Unit quaternions x y z w (glTF's order), any number at once: shapes are (..., 4)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from eyeline.errors import GeometryError
from eyeline.geometry.arrays import FloatArray

IDENTITY = (0.0, 0.0, 0.0, 1.0)


def normalized(q: npt.ArrayLike) -> FloatArray:
    """`q` scaled to length one; a zero quaternion becomes the identity."""
    q = np.asarray(q, dtype=np.float64)
    length = np.sqrt((q * q).sum(axis=-1, keepdims=True))
    return np.where(length > 0, q / np.where(length > 0, length, 1), IDENTITY)


def from_axis_angle(axis: npt.ArrayLike, angle: npt.ArrayLike) -> FloatArray:
    """The turn by `angle` (...) radians, right-handed, about the unit `axis` (..., 3)."""
    half = np.asarray(angle, dtype=np.float64)[..., None] / 2
    axis = np.asarray(axis, dtype=np.float64)
    vector = axis * np.sin(half)
    return np.concatenate([vector, np.broadcast_to(np.cos(half), (*vector.shape[:-1], 1))], axis=-1)


def turn(angle: float, axis: npt.ArrayLike = (0, 1, 0)) -> FloatArray:
    """The turn (4,) by an angle in radians, right-handed, about an axis of any length but 0."""
    direction = np.asarray(axis, dtype=np.float64)
    length = np.sqrt((direction * direction).sum())
    if direction.shape != (3,) or not 0 < length < np.inf or not np.isfinite(angle):
        raise GeometryError(
            f"a turn by {angle} about {direction.tolist()}; an angle and a direction are needed"
        )
    return from_axis_angle(direction / length, angle)


def multiply(a: npt.ArrayLike, b: npt.ArrayLike) -> FloatArray:
    """The turn that does `b` first, then `a`."""
    a, b = np.asarray(a, dtype=np.float64), np.asarray(b, dtype=np.float64)
    ax, ay, az, aw = np.moveaxis(a, -1, 0)
    bx, by, bz, bw = np.moveaxis(b, -1, 0)
    return np.stack(
        [
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
            aw * bw - ax * bx - ay * by - az * bz,
        ],
        axis=-1,
    )


def to_matrix(q: npt.ArrayLike) -> FloatArray:
    """Rotation matrices (..., 3, 3) of unit quaternions."""
    x, y, z, w = np.moveaxis(np.asarray(q, dtype=np.float64), -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def from_matrix(matrix: npt.ArrayLike) -> FloatArray:
    """The unit quaternion, w >= 0, of rotation matrices (..., 3, 3)."""
    m = np.asarray(matrix, dtype=np.float64)
    d = m[..., [0, 1, 2], [0, 1, 2]]
    trace = d.sum(axis=-1)
    # Four ways to write the same turn; the one with the largest divisor loses the least.
    squares = np.concatenate([1 + 2 * d - trace[..., None], 1 + trace[..., None]], axis=-1)
    x, y, z = m[..., 2, 1] - m[..., 1, 2], m[..., 0, 2] - m[..., 2, 0], m[..., 1, 0] - m[..., 0, 1]
    xy, yz, zx = m[..., 1, 0] + m[..., 0, 1], m[..., 2, 1] + m[..., 1, 2], m[..., 0, 2] + m[..., 2, 0]
    ways = np.stack(
        [
            np.stack([squares[..., 0], xy, zx, x], axis=-1),
            np.stack([xy, squares[..., 1], yz, y], axis=-1),
            np.stack([zx, yz, squares[..., 2], z], axis=-1),
            np.stack([x, y, z, squares[..., 3]], axis=-1),
        ],
        axis=-2,
    )
    best = squares.argmax(axis=-1)[..., None, None]
    q = normalized(np.take_along_axis(ways, best, axis=-2)[..., 0, :])
    return np.where(q[..., 3:] < 0, -q, q)


def slerp(a: npt.ArrayLike, b: npt.ArrayLike, t: npt.ArrayLike) -> FloatArray:
    """From `a` at t = 0 to `b` at t = 1 along the shorter great arc, at constant speed. [Shoemake85]

    a, b: (..., 4) unit; t: (...). Turns closer than 1e-9 are interpolated straight.
    """
    a, b = np.asarray(a, dtype=np.float64), np.asarray(b, dtype=np.float64)
    t = np.asarray(t, dtype=np.float64)[..., None]
    cosine = (a * b).sum(axis=-1, keepdims=True)
    b = np.where(cosine < 0, -b, b)
    angle = np.arccos(np.clip(np.abs(cosine), 0, 1))
    sine = np.sin(angle)
    close = sine < 1e-9
    safe = np.where(close, 1, sine)
    from_a = np.where(close, 1 - t, np.sin((1 - t) * angle) / safe)
    from_b = np.where(close, t, np.sin(t * angle) / safe)
    return normalized(from_a * a + from_b * b)
