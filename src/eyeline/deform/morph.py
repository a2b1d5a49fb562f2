"""Shapes that blend: a base, and what each target adds by its weight. [glTF 2.0, 3.7.2.2]"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from eyeline.errors import GeometryError
from eyeline.geometry.arrays import FloatArray
from eyeline.jit import kernel, share, threads

SHARED = 30_000  # numbers below which a second thread costs more than it brings


def blend(base: FloatArray, deltas: Sequence[FloatArray | None], weights: Sequence[float]) -> FloatArray:
    """base (V, n) float32 plus the weighted sum of deltas (V, n), as float32; target by target in float64.

    A target without deltas, or with weight 0, adds nothing; where none adds, the answer is `base` itself.
    """
    active = _active(base, deltas, weights)
    if not active:
        return base
    flat = np.ascontiguousarray(base, np.float32).reshape(-1)
    total = np.empty(flat.size)
    blended = np.empty_like(flat)
    parts = threads() if flat.size >= SHARED else 1
    ends = [flat.size * part // parts for part in range(parts + 1)]

    def task(part: int) -> None:
        here = slice(ends[part], ends[part + 1])
        total[here] = flat[here]
        for delta, weight in active:
            add(total[here], delta[here], weight)
        blended[here] = total[here]

    share(task, parts)
    return blended.reshape(base.shape)


def blend_directions(
    base: FloatArray, deltas: Sequence[FloatArray | None], weights: Sequence[float]
) -> FloatArray:
    """`blend` for unit normals (V, 3) or tangents (V, 4), made unit again; a tangent's w stays as it is.

    Where the sum is no direction, the base stays.
    """
    directions = base[:, :3]
    if not _active(directions, deltas, weights):
        return base
    sums = blend(directions, deltas, weights)
    lengths = np.sqrt((sums.astype(np.float64) ** 2).sum(axis=1, keepdims=True))
    unit = np.where(lengths > 0, sums / np.where(lengths > 0, lengths, 1), base[:, :3])
    return np.concatenate([unit, base[:, 3:]], axis=1).astype(np.float32)


def _active(
    base: FloatArray, deltas: Sequence[FloatArray | None], weights: Sequence[float]
) -> list[tuple[FloatArray, float]]:
    active = []
    for index, (delta, weight) in enumerate(zip(deltas, weights, strict=True)):
        if delta is None or weight == 0:
            continue
        if delta.shape != base.shape:
            raise GeometryError(f"morph target {index} has shape {delta.shape}; {base.shape} is needed")
        active.append((np.ascontiguousarray(delta, np.float32).reshape(-1), float(weight)))
    return active


@kernel
def add(total, delta, weight):
    """total += weight * delta."""
    for i in range(len(total)):
        total[i] += weight * delta[i]
