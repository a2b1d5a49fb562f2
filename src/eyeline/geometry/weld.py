"""Vertices at one place made one."""

from __future__ import annotations

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray, read_only
from eyeline.jit import helper, kernel

WORD = 0xFFFFFFFF  # 32 bits
MULTIPLIER = 0x5BD1E995  # odd, 31 bits, as many of them set as not


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


def first_alike(rows: IntArray) -> IntArray:
    """(N,) int32: for each of the rows (N, K) int32 the number of the first that equals it."""
    first = np.empty(len(rows), dtype=np.int32)
    slots = 1 << max(4, (2 * len(rows)).bit_length())
    _first_alike(read_only(np.ascontiguousarray(rows)), np.full(slots, -1, dtype=np.int32), first)
    return first


@helper
def mixing(number):
    """A number below 2**32 as another one, all of whose bits depend on all bits: a step of a hash.

    What it multiplies stays below 2**63, so that uncompiled it is the same.
    """
    product = number * MULTIPLIER
    return (product ^ (product >> 29)) & WORD


@kernel
def _first_alike(rows, table, first):
    """Fill first. `table` is a hash table of rows, all -1."""
    mask = table.shape[0] - 1
    for row in range(rows.shape[0]):
        mixed = 0
        for k in range(rows.shape[1]):
            mixed = mixing(mixed ^ (np.int64(rows[row, k]) & WORD))
        slot = mixed & mask
        found = False
        while table[slot] >= 0 and not found:
            found = True
            for k in range(rows.shape[1]):
                found &= rows[table[slot], k] == rows[row, k]
            if not found:
                slot = (slot + 1) & mask
        if not found:
            table[slot] = row
        first[row] = table[slot]
