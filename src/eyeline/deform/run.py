"""Vertices through a plan in one pass: each batch goes through all steps while it is in a core's cache."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from eyeline.deform.block import BATCH, SIZE, WIDTH, Work, finish
from eyeline.deform.plan import Plan
from eyeline.errors import GeometryError
from eyeline.geometry.arrays import FloatArray, read_only
from eyeline.jit import share, threads

Deformed = tuple[FloatArray, FloatArray | None, FloatArray | None]  # points, normals, tangents

SHARED = 2 * BATCH  # vertices below which a second thread costs more than it brings


def deformed(
    plan: Plan, points: FloatArray, normals: FloatArray | None, tangents: FloatArray | None
) -> Deformed:
    """Points (V, 3), unit normals (V, 3) and tangents (V, 4) after all steps.

    As float32, or float64 where the points are; what was given itself where there is no step.
    """
    kind = np.float64 if np.asarray(points).dtype == np.float64 else np.float32
    given = [
        _rows(one, width, kind, what)
        for one, width, what in ((points, 3, "points"), (normals, 3, "normals"), (tangents, 4, "tangents"))
    ]
    count = len(given[0])
    if any(one is not None and len(one) != count for one in (normals, tangents)):
        raise GeometryError(f"points, normals and tangents must be {count} rows each")
    steps = plan.steps_for(count)
    if not steps:
        return points, normals, tangents
    outs = [np.empty(one.shape, kind) for one in given]
    batches = -(-count // BATCH)
    parts = min(threads(), batches) if count >= SHARED else 1
    side = -1.0 if plan.mirrored else 1.0

    def task(part: int) -> None:
        work = Work()
        for batch in range(batches * part // parts, batches * (part + 1) // parts):
            work.take(given[0], batch * BATCH, min(count, (batch + 1) * BATCH))
            for step in steps:
                step(work)
            finish(work.state, work.begin, work.end, side, given[1], given[2], *outs)

    share(task, parts)
    return outs[0], None if normals is None else outs[1], None if tangents is None else outs[2]


def jacobians(plan: Plan, points: FloatArray) -> FloatArray:
    """(V, 3, 3) float64: how each coordinate of a moved point grows with each coordinate of the given one."""
    given = _rows(points, 3, np.float64, "points")
    steps = plan.steps_for(len(given))
    found = np.empty((len(given), 3, 3))
    work = Work()
    for begin in range(0, len(given), BATCH):
        work.take(given, begin, min(len(given), begin + BATCH))
        for step in steps:
            step(work)
        blocks = work.state.reshape(-1, SIZE // WIDTH, WIDTH)[:, 3:]
        rows = blocks.transpose(0, 2, 1).reshape(-1, 3, 3)
        found[work.begin : work.end] = rows[: work.end - work.begin]
    return found


def _rows(values: FloatArray | None, width: int, kind: npt.DTypeLike, what: str) -> FloatArray:
    if values is None:
        return read_only(np.empty((0, width), kind))
    rows = np.ascontiguousarray(values, kind)
    if rows.ndim != 2 or rows.shape[1] != width:
        raise GeometryError(f"{what} have shape {rows.shape}; (V, {width}) is needed")
    return read_only(rows)
