"""Which parts of strokes are seen: each face hides an interval of a stroke, in closed form, and they add up.

Neighbouring faces hide intervals that meet in the same bits, for whether and where a line crosses a side
follows from whole numbers. A face never hides the strokes that lie in it, nor an end that lies on it: that is
known from what meets in the mesh, not from depths. It hides only what is certainly behind it, wherever within
a unit of the grid the points were.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.drawing.cells import listed_faces
from eyeline.drawing.grid import Grid, turn
from eyeline.drawing.hiders import Hiders
from eyeline.drawing.model import Model
from eyeline.drawing.strokes import Strokes
from eyeline.geometry.arrays import BoolArray, FloatArray, IntArray, read_only
from eyeline.geometry.cells import Passages
from eyeline.geometry.spans import with_span
from eyeline.jit import helper, kernel, share, threads

BLOCKS = 16  # of strokes for each thread: some are crossed by many faces
DUST = 8  # grid units, a thousandth of a pixel: shorter pieces are what roundings leave
SPECK = (
    512.0  # grid units: a line that leaves a face it touches, and is behind it, no longer needs no certainty
)


@dataclass(frozen=True, eq=False)
class Spans:
    """Pieces of strokes in the picture, stroke after stroke, from one end to the other."""

    row: IntArray  # (N,) int32: the stroke
    ends: FloatArray  # (N, 2) where in 0..1 along it, on the screen
    seen: BoolArray  # (N,)


def spans_of(strokes: Strokes, model: Model, grid: Grid, passages: Passages, hiders: Hiders) -> Spans:
    """All pieces of all strokes, seen and hidden; what lies outside the picture is neither."""
    listed = listed_faces(hiders)
    count = len(strokes.kind)
    blocks = max(1, min(count, BLOCKS * threads()))
    arrays = (
        strokes.screen.reshape(-1, 6), strokes.own, strokes.touch, passages.start, passages.cell,
        passages.span, passages.inside, hiders.corners, hiders.nearest, hiders.source, model.faces,
        model.screen, model.outside, *listed,
    )  # fmt: skip
    given = (*(read_only(np.ascontiguousarray(array)) for array in arrays), *grid.slack)
    found = share(
        lambda block: _spans(count * block // blocks, count * (block + 1) // blocks, *given),
        blocks,
    )
    return Spans(*(np.concatenate(parts) for parts in zip(*found, strict=True)))


@kernel
def _spans(
    first, end, strokes, own, touch, passage_start, passage_cell, passage_span, inside, corners, nearest,
    source, faces, screen, outside, list_start, listed, slack, slope,
):  # fmt: skip
    """(row, ends, seen) of strokes first..end."""
    room = 256
    row, ends, seen = np.empty(room, np.int32), np.empty((room, 2)), np.empty(room, np.bool_)
    hidden, count = np.empty((nearest.shape[0] + 1, 2)), 0
    for s in range(first, end):
        ax, ay, az, bx, by, bz = (
            strokes[s, 0], strokes[s, 1], strokes[s, 2], strokes[s, 3], strokes[s, 4], strokes[s, 5],
        )  # fmt: skip
        begin, stop = max(inside[s, 0], 0.0), min(inside[s, 1], 1.0)
        if not begin < stop:
            continue
        n, deep, long = 0, max(az, bz), max(abs(bx - ax), abs(by - ay))
        own_f, own_g = own[s, 0], own[s, 1]
        a0, a1, b0, b1 = touch[s, 0], touch[s, 1], touch[s, 2], touch[s, 3]
        for passage in range(passage_start[s], passage_start[s + 1]):
            cell = passage_cell[passage]
            c0, c1 = max(passage_span[passage, 0], begin), min(passage_span[passage, 1], stop)
            for at in range(list_start[cell], list_start[cell + 1]):
                f = listed[at]
                if nearest[f] >= deep:
                    continue
                covered = False
                for i in range(n):
                    covered |= (hidden[i, 0] <= c0) & (hidden[i, 1] >= c1)
                if covered:
                    break
                t0, t1 = span_across(
                    corners[f, 0], corners[f, 1], corners[f, 3], corners[f, 4], corners[f, 6], corners[f, 7],
                    ax, ay, bx, by,
                )  # fmt: skip
                g = source[f]
                if (not t0 < t1) | (g == own_f) | (g == own_g):
                    continue
                p, q, r = faces[g, 0], faces[g, 1], faces[g, 2]
                at_a, at_b = on_face(p, q, r, a0, a1), on_face(p, q, r, b0, b1)
                if at_a & at_b:
                    continue
                u, v = (a0, a1) if at_a else (b0, b1)
                if (at_a | at_b) & (u != v):
                    # It ends on an edge of this face: hidden only on the side of its own face along that edge
                    h = own_f
                    if own_g >= 0 and not on_face(faces[h, 0], faces[h, 1], faces[h, 2], u, v):
                        h = own_g
                    i, j = faces[h, 0] + faces[h, 1] + faces[h, 2] - u - v, p + q + r - u - v
                    if on_face(faces[h, 0], faces[h, 1], faces[h, 2], u, v) and not (
                        outside[u] | outside[v] | outside[i] | outside[j]
                    ):
                        ux, uy, vx, vy = screen[u, 0], screen[u, 1], screen[v, 0], screen[v, 1]
                        here = turn(ux, uy, vx, vy, screen[i, 0], screen[i, 1])
                        there = turn(ux, uy, vx, vy, screen[j, 0], screen[j, 1])
                        if ((here < 0.0) & (there > 0.0)) | ((here > 0.0) & (there < 0.0)):
                            continue
                sure = (not (at_a | at_b)) or (t1 - t0) * long > SPECK
                t0, t1 = span_behind(
                    corners[f, 0], corners[f, 1], corners[f, 2], corners[f, 3], corners[f, 4], corners[f, 5],
                    corners[f, 6], corners[f, 7], corners[f, 8], ax, ay, az, bx, by, bz, at_a, at_b, t0, t1,
                    sure, slack, slope,
                )  # fmt: skip
                if not t0 < t1:
                    continue
                n = with_span(hidden, n, t0, t1, 0.0)

        # What is seen and what is hidden, by turns; dust goes to its neighbour
        while count + 2 * n + 2 > room:
            row, ends, seen = (
                np.concatenate((row, row)),
                np.concatenate((ends, ends)),
                np.concatenate((seen, seen)),
            )
            room *= 2
        place, own_first = begin, count
        for i in range(2 * n + 1):
            until = stop if i == 2 * n else min(max(hidden[i // 2, i % 2], begin), stop)
            shown = i % 2 == 0
            if until > place and ((until - place) * long >= DUST or (begin == place and until == stop)):
                if count > own_first and seen[count - 1] == shown:
                    ends[count - 1, 1] = until
                else:
                    row[count], seen[count] = s, shown
                    ends[count, 0] = begin if count == own_first else ends[count - 1, 1]
                    ends[count, 1] = until
                    count += 1
            elif count > own_first:
                ends[count - 1, 1] = max(until, ends[count - 1, 1])
            place = max(place, until)
    return row[:count].copy(), ends[:count].copy(), seen[:count].copy()


@helper
def on_face(a, b, c, p, q):
    """Whether p and q are among the corners a, b, c."""
    return ((a == p) | (b == p) | (c == p)) & ((a == q) | (b == q) | (c == q))


@helper
def side_window(px, py, qx, qy, ax, ay, bx, by, t0, t1):
    """The part of t0..t1 in which ab is to the right of pq or on it; empty if only an end touches it."""
    at_a, at_b = turn(px, py, qx, qy, ax, ay), turn(px, py, qx, qy, bx, by)
    if (at_a <= 0.0) & (at_b <= 0.0) & ((at_a < 0.0) | (at_b < 0.0)):
        return 1.0, 0.0
    if at_a < 0.0:
        return max(t0, at_a / (at_a - at_b)), t1
    if at_b < 0.0:
        return t0, min(t1, at_a / (at_a - at_b))
    return t0, t1


@helper
def span_across(x0, y0, x1, y1, x2, y2, ax, ay, bx, by):
    """Where ab runs inside a face or on its border, on the screen; empty if in no more than a point."""
    t0, t1 = side_window(x2, y2, x0, y0, ax, ay, bx, by, 0.0, 1.0)
    if t0 < t1:
        t0, t1 = side_window(x0, y0, x1, y1, ax, ay, bx, by, t0, t1)
    if t0 < t1:
        t0, t1 = side_window(x1, y1, x2, y2, ax, ay, bx, by, t0, t1)
    return t0, t1


@helper
def span_behind(
    px, py, pz, qx, qy, qz, rx, ry, rz, ax, ay, az, bx, by, bz, at_a, at_b, t0, t1, sure, slack, slope
):  # fmt: skip
    """The part of t0..t1 in which ab is behind the face pqr; sure: is so wherever its points were rounded to.

    An end that touches the face (at_a, at_b) lies in its plane, whatever the rounding says.
    """
    unit = slack + slope * max(abs(pz), abs(qz), abs(rz))
    if (not at_a) & (not at_b) and min(az + t0 * (bz - az), az + t1 * (bz - az)) > max(pz, qz, rz) + unit:
        return t0, t1
    qx, qy, qz, rx, ry, rz = qx - px, qy - py, qz - pz, rx - px, ry - py, rz - pz
    nx, ny, area = qy * rz - qz * ry, qz * rx - qx * rz, qx * ry - qy * rx
    if area == 0.0:
        return 1.0, 0.0
    behind_a = 0.0 if at_a else nx * (ax - px) + ny * (ay - py) + area * (az - pz)
    behind_b = 0.0 if at_b else nx * (bx - px) + ny * (by - py) + area * (bz - pz)
    behind_0, behind_1 = behind_a + t0 * (behind_b - behind_a), behind_a + t1 * (behind_b - behind_a)
    if max(behind_0, behind_1) <= (abs(nx) + abs(ny) + area * unit if sure else 0.0):
        return 1.0, 0.0
    if behind_0 < 0.0:
        t0 = max(t0, behind_a / (behind_a - behind_b))
    if behind_1 < 0.0:
        t1 = min(t1, behind_a / (behind_a - behind_b))
    return t0, t1
