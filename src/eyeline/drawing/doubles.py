"""Strokes that lie on each other in space: where two bodies lie flush, one of their edges is enough.

Strokes with the same ends are told by their ends (`strokes.once`); here are those that overlap in part.
"""

from __future__ import annotations

import numpy as np

from eyeline.drawing.grid import Grid
from eyeline.drawing.hiding import DUST, Spans
from eyeline.drawing.strokes import Strokes
from eyeline.geometry.arrays import FloatArray, IntArray, read_only
from eyeline.geometry.cells import Passages
from eyeline.jit import kernel

APART = 2.0  # grid units: strokes that lie on each other are no farther apart, for ends are whole units


def without_doubles(spans: Spans, strokes: Strokes, grid: Grid, passages: Passages) -> Spans:
    """Spans less what lies on a stroke of a heavier kind, or of the same kind and a lower number."""
    order = np.argsort(passages.cell, kind="stable")
    stroke = np.repeat(np.arange(len(strokes.kind), dtype=np.int32), np.diff(passages.start))[order]
    ends = np.ascontiguousarray(strokes.screen.reshape(-1, 6))
    row, part = _doubles(
        read_only(stroke),
        read_only(passages.cell[order]),
        read_only(ends),
        read_only(strokes.kind),
        *grid.slack,
    )
    return subtracted(spans, row, part) if len(row) else spans


def subtracted(spans: Spans, row: IntArray, part: FloatArray) -> Spans:
    """Spans less parts (K, 2) of the strokes in row (K,)."""
    touched = np.isin(spans.row, row)
    rows, ends, seen = [spans.row[~touched]], [spans.ends[~touched]], [spans.seen[~touched]]
    for index in np.flatnonzero(touched):
        begin, stop = spans.ends[index].tolist()
        taken = part[row == spans.row[index]]
        left = []
        for low, high in sorted(map(tuple, taken.tolist())):
            if low > begin:
                left.append((begin, min(low, stop)))
            begin = max(begin, high)
        left = [pair for pair in [*left, (begin, stop)] if pair[0] < pair[1]]
        rows.append(np.full(len(left), spans.row[index], np.int32))
        ends.append(np.array(left).reshape(-1, 2))
        seen.append(np.full(len(left), spans.seen[index]))
    whole = Spans(np.concatenate(rows), np.concatenate(ends), np.concatenate(seen))
    order = np.lexsort((whole.ends[:, 0], whole.row))
    return Spans(whole.row[order], whole.ends[order], whole.seen[order])


@kernel
def _doubles(stroke, cell, ends, kind, slack, slope):
    """(row, part): parts in 0..1 of strokes that lie on a stroke to be drawn before them.

    stroke, cell: passages of cells by strokes, cell after cell.
    """
    row, part, found, begin = np.empty(64, np.int32), np.empty((64, 2)), 0, 0
    for i in range(stroke.shape[0]):
        if cell[i] != cell[begin]:
            begin = i
        for j in range(begin, i):
            s, r = stroke[i], stroke[j]
            if kind[r] > kind[s] or (kind[r] == kind[s] and r > s):
                s, r = r, s
            ax, ay, az = ends[s, 0], ends[s, 1], ends[s, 2]
            dx, dy, dz = ends[s, 3] - ax, ends[s, 4] - ay, ends[s, 5] - az
            square = dx * dx + dy * dy
            if square < DUST * DUST:
                continue
            # How far the other's line is from this one, along it and across it, at both of its ends
            t0 = ((ends[r, 0] - ax) * dx + (ends[r, 1] - ay) * dy) / square
            t1 = ((ends[r, 3] - ax) * dx + (ends[r, 4] - ay) * dy) / square
            low, high = max(min(t0, t1), 0.0), min(max(t0, t1), 1.0)
            if high <= low or (high - low) * (high - low) * square < DUST * DUST:
                continue
            on = True
            for k in range(2):
                t = high if k else low
                u = (t - t0) / (t1 - t0)
                x = ends[r, 0] + u * (ends[r, 3] - ends[r, 0]) - ax - t * dx
                y = ends[r, 1] + u * (ends[r, 4] - ends[r, 1]) - ay - t * dy
                z = ends[r, 2] + u * (ends[r, 5] - ends[r, 2]) - az - t * dz
                steep = slack + slope * abs(az) + abs(dz) / np.sqrt(square)
                on &= (x * x + y * y <= APART * APART) & (abs(z) <= APART * steep)
            if on:
                if found == row.shape[0]:
                    row, part = np.concatenate((row, row)), np.concatenate((part, part))
                row[found], part[found, 0], part[found, 1] = s, low, high
                found += 1
    return row[:found].copy(), part[:found].copy()
