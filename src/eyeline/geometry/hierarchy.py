"""Places in a tree: from each node's place against its parent to its place in the world."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from eyeline.errors import GeometryError
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.jit import kernel, share, threads

SHARED = 4096  # places below which a second thread costs more than it brings


def world_from_nodes(
    translation: FloatArray,
    rotation: FloatArray,
    scale: FloatArray,
    parents: IntArray,
    fixed: Mapping[int, FloatArray] | None = None,
) -> FloatArray:
    """(T, N, 4, 4) of (T, N, 3), (T, N, 4) x y z w unit, (T, N, 3); parents (N,) come first, -1 is the world.

    fixed: the nodes that an affine matrix (4, 4) places instead.
    """
    count, nodes = translation.shape[:2]
    if len(parents) != nodes or (parents >= np.arange(nodes)).any() or (parents < -1).any():
        raise GeometryError(
            f"{nodes} nodes have parents {parents.tolist()}; each one's parent comes before it"
        )
    world = np.empty((count, nodes, 4, 4))
    places = dict(fixed or {})
    which = np.full(nodes, -1, dtype=np.int64)
    which[list(places)] = np.arange(len(places))
    matrices = np.array([*places.values()], dtype=np.float64).reshape(-1, 4, 4)
    parts = min(threads(), 1 + count * nodes // SHARED)
    ends = [count * part // parts for part in range(parts + 1)]
    t, r, s = (np.ascontiguousarray(one, dtype=np.float64) for one in (translation, rotation, scale))
    order = np.ascontiguousarray(parents, dtype=np.int32)

    def task(part: int) -> None:
        place(t, r, s, order, which, matrices, ends[part], ends[part + 1], world)

    share(task, parts)
    return world


@kernel
def place(translation, rotation, scale, parents, which, matrices, begin, end, world):
    """world_from_node at times begin to end, parents before children."""
    local = np.empty((4, 4))
    for t in range(begin, end):
        for n in range(len(parents)):
            own = world[t, n]
            if which[n] >= 0:
                for r in range(3):
                    for c in range(4):
                        local[r, c] = matrices[which[n], r, c]
            else:
                x, y, z, w = rotation[t, n, 0], rotation[t, n, 1], rotation[t, n, 2], rotation[t, n, 3]
                sx, sy, sz = scale[t, n, 0], scale[t, n, 1], scale[t, n, 2]
                local[0, 0] = (1.0 - 2.0 * (y * y + z * z)) * sx
                local[0, 1] = 2.0 * (x * y - z * w) * sy
                local[0, 2] = 2.0 * (x * z + y * w) * sz
                local[1, 0] = 2.0 * (x * y + z * w) * sx
                local[1, 1] = (1.0 - 2.0 * (x * x + z * z)) * sy
                local[1, 2] = 2.0 * (y * z - x * w) * sz
                local[2, 0] = 2.0 * (x * z - y * w) * sx
                local[2, 1] = 2.0 * (y * z + x * w) * sy
                local[2, 2] = (1.0 - 2.0 * (x * x + y * y)) * sz
                for r in range(3):
                    local[r, 3] = translation[t, n, r]
            if parents[n] < 0:
                for r in range(3):
                    for c in range(4):
                        own[r, c] = local[r, c]
            else:
                up = world[t, parents[n]]
                for r in range(3):
                    for c in range(4):
                        far = up[r, 3] if c == 3 else 0.0
                        own[r, c] = (
                            up[r, 0] * local[0, c] + up[r, 1] * local[1, c] + up[r, 2] * local[2, c] + far
                        )
            for c in range(4):
                own[3, c] = 1.0 if c == 3 else 0.0
