"""4x4 transforms of column vectors, float64, any number at once: shapes are (..., 4, 4).

Names read right to left and cancel: `clip_from_world = clip_from_eye @ eye_from_world`.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from eyeline.errors import GeometryError
from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray

NEXT, LAST = [1, 2, 0], [2, 0, 1]  # of three axes: the one after each, and the one after that


def identity() -> FloatArray:
    """The transform that changes nothing."""
    return np.eye(4)


def compose(translation: npt.ArrayLike, rotation: npt.ArrayLike, scale: npt.ArrayLike) -> FloatArray:
    """Scale first, then rotate, then translate. (..., 3), (..., 4) x y z w, (..., 3) -> (..., 4, 4)."""
    translation, scale = np.asarray(translation, np.float64), np.asarray(scale, np.float64)
    turned = quaternion.to_matrix(rotation) * scale[..., None, :]
    matrix = np.zeros((*turned.shape[:-2], 4, 4))
    matrix[..., :3, :3] = turned
    matrix[..., :3, 3] = translation
    matrix[..., 3, 3] = 1
    return matrix


def product(a: FloatArray, b: FloatArray) -> FloatArray:
    """a @ b of matrices (..., n, k) and (..., k, m), summed in order: BLAS rounds as the machine likes."""
    terms = a[..., :, :, None] * b[..., None, :, :]
    total = terms[..., 0, :].copy()
    for k in range(1, terms.shape[-2]):
        total += terms[..., k, :]
    return total


def inverse(matrix: FloatArray) -> FloatArray:
    """The affine matrix (4, 4) that undoes this one, without LAPACK, which rounds as the machine likes."""
    axes = matrix[:3, :3].T
    # The cross products of each two axes
    a, b = axes[NEXT], axes[LAST]
    rows = a[:, NEXT] * b[:, LAST] - a[:, LAST] * b[:, NEXT]
    undone = identity()
    undone[:3, :3] = rows / product(rows[:1], matrix[:3, :1])
    undone[:3, 3:] = -product(undone[:3, :3], matrix[:3, 3:])
    return undone


def determinants(matrices: FloatArray) -> FloatArray:
    """(...) of matrices (..., 3, 3) or the turning parts of (..., 4, 4), without LAPACK."""
    (ax, bx, cx), (ay, by, cy), (az, bz, cz) = np.moveaxis(matrices[..., :3, :3], (-2, -1), (0, 1))
    found: FloatArray = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    return found


def decompose(matrix: npt.ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
    """(translation, rotation, scale) of matrices without shear; a mirror becomes a negative x scale."""
    m = np.asarray(matrix, dtype=np.float64)
    scale = np.sqrt((m[..., :3, :3] ** 2).sum(axis=-2))
    scale[..., 0] = np.where(np.linalg.det(m[..., :3, :3]) < 0, -scale[..., 0], scale[..., 0])
    axes = m[..., :3, :3] / np.where(scale == 0, 1, scale)[..., None, :]
    return m[..., :3, 3].copy(), quaternion.from_matrix(axes), scale


def apply(matrix: npt.ArrayLike, points: npt.ArrayLike) -> FloatArray:
    """Points (..., N, 3) moved by an affine matrix (..., 4, 4)."""
    m, p = np.asarray(matrix, np.float64), np.asarray(points, np.float64)
    return p @ np.swapaxes(m[..., :3, :3], -1, -2) + m[..., None, :3, 3]


def apply_to_vectors(matrix: npt.ArrayLike, vectors: npt.ArrayLike) -> FloatArray:
    """Directions (..., N, 3) turned and scaled by a matrix, not moved."""
    m, v = np.asarray(matrix, np.float64), np.asarray(vectors, np.float64)
    return v @ np.swapaxes(m[..., :3, :3], -1, -2)


def look_at(eye: npt.ArrayLike, target: npt.ArrayLike, up: npt.ArrayLike = (0, 1, 0)) -> FloatArray:
    """world_from_eye for an eye that looks along -z at `target`, y up as far as it can.

    Refused: an eye on its target, and an `up` along the view.
    """
    eye, target, up = (np.asarray(v, np.float64) for v in (eye, target, up))
    back = eye - target
    distance = np.sqrt((back * back).sum())
    if not np.isfinite(distance) or distance == 0:
        raise GeometryError(f"eye {eye.tolist()} and target {target.tolist()} must be two finite points")
    back = back / distance
    right = np.cross(up, back)
    sine = np.sqrt((right * right).sum())
    if not sine > 1e-9 * np.sqrt((up * up).sum()):
        raise GeometryError(f"up {up.tolist()} lies along the view; choose another direction")
    right = right / sine
    matrix = identity()
    matrix[:3, :3] = np.stack([right, np.cross(back, right), back], axis=-1)
    matrix[:3, 3] = eye
    return matrix


def is_mirror(matrix: FloatArray) -> bool:
    """Whether a transform turns the winding of faces."""
    return bool(np.linalg.det(matrix[:3, :3]) < 0)
