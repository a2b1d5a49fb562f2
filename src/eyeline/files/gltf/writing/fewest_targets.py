"""Shapes that a surface takes over time, as the fewest morph targets that make them all."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Blend:
    """K targets, how much of each makes each of T shapes, and how far the worst vertex is from its place."""

    targets: FloatArray  # (K, V, 3) metres, float32; the greatest move of each is that of one weight
    weights: FloatArray  # (T, K)
    error: float  # metres


def fewest_targets(moves: FloatArray, tolerance: float) -> Blend:
    """The principal shapes of moves (T, V, 3) from the shape at rest, until no vertex is off by more.

    They are found among the T x T products of the moves: of all sets of as many targets these leave the least
    sum of squares; how many are needed is decided by the worst vertex.
    """
    count = len(moves)
    rows = moves.reshape(count, -1).astype(np.float64)
    _, mixtures = np.linalg.eigh(rows @ rows.T)
    targets: list[FloatArray] = []
    weights: list[FloatArray] = []
    left = rows.copy()
    error = _worst(left)
    for mixture in mixtures.T[::-1]:
        if error <= tolerance:
            break
        target = mixture @ rows
        size = np.sqrt(np.square(target.reshape(-1, 3)).sum(axis=1).max(initial=0.0))
        if size == 0:
            break
        # In 32 bits, as the file has it, so that the error is that of the file
        stored = (target / size).astype(np.float32)
        left -= np.outer(mixture * size, stored)
        targets.append(stored.reshape(-1, 3))
        weights.append(mixture * size)
        error = _worst(left)
    shape = (0, *moves.shape[1:])
    return Blend(
        np.stack(targets) if targets else np.zeros(shape, np.float32),
        np.stack(weights, axis=1) if weights else np.zeros((count, 0)),
        error,
    )


def _worst(left: FloatArray) -> float:
    """The greatest length of (T, 3 V) differences, vertex by vertex."""
    return float(np.sqrt(np.square(left.reshape(len(left), -1, 3)).sum(axis=2).max(initial=0.0)))


def carried(weights: FloatArray, moves: FloatArray) -> FloatArray:
    """(K, V, 3) float32 what targets do to normals, so that the same weights come nearest to `moves`."""
    rows = moves.reshape(len(moves), -1).astype(np.float64)
    found, *_ = np.linalg.lstsq(weights, rows, rcond=None)
    return found.reshape(-1, *moves.shape[1:]).astype(np.float32)
