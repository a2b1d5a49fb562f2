"""Vertices at one place made one."""

from __future__ import annotations

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray


def welded(rows: FloatArray | IntArray) -> tuple[IntArray, IntArray]:
    """(first, index): the first of each kind of equal rows (N, K), in order, and which kind (N,) each row is.

    Equal is to the bit, but for minus zero, which is zero: no two different points are pulled together.
    """
    plain = np.ascontiguousarray(rows + rows.dtype.type(0))
    keys = plain.view(np.dtype((np.void, plain.dtype.itemsize * plain.shape[1]))).reshape(-1)
    _, first, index = np.unique(keys, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty(len(order), dtype=np.int32)
    rank[order] = np.arange(len(order), dtype=np.int32)
    return first[order], rank[index.reshape(-1)]
