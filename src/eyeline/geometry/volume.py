"""The volume that a closed surface of triangles encloses."""

from __future__ import annotations

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray


def volume(points: FloatArray, faces: IntArray) -> float:
    """Cubic metres inside the faces (F, 3) over points (V, 3); below 0 where they show their backs outward.

    The sum of the tetrahedra from each face to the middle of the points. Of a surface with holes it is that
    of the cones from their rims to this middle left out.
    """
    if not len(faces):
        return 0.0
    corners = points.astype(np.float64) - points.mean(axis=0, dtype=np.float64)
    a, b, c = (corners[faces[:, k]] for k in range(3))
    return float((a * np.cross(b, c)).sum() / 6)
