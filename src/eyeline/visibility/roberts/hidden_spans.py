"""Every edge against every body near it: two unknowns, linear inequalities, solved in closed form.

A point of an edge is P0 + t (P1 - P0), and on the sight line through it the points nearer to the eye are
alpha > 0 farther along the axis of depth. A body hides the point where some alpha > 0 is inside all its
half spaces. The sides of a body run along the axis: they bind t alone. A cap binds both, but leaves alpha
from 0 up to its height over the edge; there is such an alpha where the height is above 0, and that is linear
in t. So each inequality cuts t from below or from above, and what is left is the interval that is hidden.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import ByteArray, FloatArray, IntArray, read_only
from eyeline.geometry.cells import Passages, passages_of
from eyeline.geometry.fixedpoint import UNITS
from eyeline.geometry.spans import with_span
from eyeline.jit import helper, kernel, share, threads
from eyeline.projection.projected import Projected
from eyeline.visibility.roberts.bodies import Bodies, bodies_of
from eyeline.visibility.roberts.convex_groups import SMALL, facing_of, flat, shown_faces
from eyeline.visibility.roberts.edge_cells import NUMBER, bodies_in, cells_for
from eyeline.visibility.roberts.mesh_edges import MeshEdges, cut_ends

BLOCKS = 8  # of edges for each thread: some are crossed by many bodies
DUST = 1.0  # 1/256 pixel: shorter pieces are what snapping leaves, and go to their neighbours
SPECK = 32.0  # 1/256 pixel: a shorter way across a body from one of its corners needs no certainty of depth
TESTED, TURNED_AWAY, BEHIND_ITSELF = 0, 1, 2  # what is known of an edge before any body is looked at


@dataclass(frozen=True, eq=False)
class Question:
    """All that decides which parts of edges are seen."""

    ends: FloatArray  # (E, 6): x, y (whole 1/256 pixels) and depth of both ends
    own: IntArray  # (E, 2) int32: owners of the bodies an edge belongs to, which do not hide it; -1 is none
    fate: ByteArray  # (E,) TESTED, TURNED_AWAY or BEHIND_ITSELF
    bodies: Bodies
    passages: Passages
    start: IntArray  # int64: where the bodies of each cell begin
    listed: IntArray  # int64: keys of the bodies of all cells


@dataclass(frozen=True, eq=False)
class Pieces:
    """Pieces of edges in the picture, edge after edge, from one end to the other."""

    tests: int  # how often an edge was put before a body
    seen_edge: IntArray  # (N,) int32
    seen: FloatArray  # (N, 4) pixels: x, y, x, y
    hidden_edge: IntArray  # (M,) int32
    hidden: FloatArray  # (M, 4)


def question(projected: Projected, edges: MeshEdges) -> Question:
    """The edges before the camera, and near each of them the bodies."""
    facing = facing_of(projected, edges)
    bodies = bodies_of(projected, edges, facing)
    count = len(edges.edges)
    ends, own, fate = np.empty((count, 6)), np.empty((count, 2), np.int32), np.empty(count, np.uint8)
    arrays = (edges.edges, *flat(projected)[1:], facing.group, facing.far, shown_faces(projected, facing))
    given = (len(facing.turn), *(read_only(array) for array in arrays))
    parts = threads() if count > SMALL else 1
    unplaced = share(lambda part: _place_ends(part, parts, ends, own, fate, *given), parts)
    if any(unplaced):
        rows = np.flatnonzero(~np.isfinite(ends[:, 2::3]).all(axis=1))
        cut = cut_ends(projected, edges.edges[rows], ends[rows].reshape(-1, 2, 3))
        ends[rows] = cut.reshape(-1, 6)
    cells = cells_for(bodies, (projected.width, projected.height))
    return Question(ends, own, fate, bodies, passages_of(ends, cells), *bodies_in(bodies, cells))


def pieces_of(asked: Question) -> Pieces:
    """All pieces of all edges, seen and hidden; what lies outside the picture is neither."""
    count = len(asked.ends)
    blocks = max(1, min(count, BLOCKS * threads()))
    passages, bodies = asked.passages, asked.bodies
    arrays = (
        asked.ends, asked.own, asked.fate, passages.inside, passages.start, passages.cell, passages.span,
        asked.start, asked.listed, bodies.owner, bodies.farthest, bodies.box, bodies.side_start, bodies.side,
        bodies.corner, bodies.cap_start, bodies.cap,
    )  # fmt: skip
    given = (bodies.front, bodies.step, *(read_only(array) for array in arrays))
    found = share(lambda part: _solve(count * part // blocks, count * (part + 1) // blocks, *given), blocks)
    tests = sum(one[4] for one in found)
    return Pieces(tests, *(np.concatenate([one[k] for one in found]) for k in range(4)))


@kernel
def _place_ends(part, parts, ends, own, fate, faces, edges, xy, depth, group, far, shown):
    """Fill ends, own and fate; how many edges have an end that is not placed."""
    unplaced, count = 0, edges.shape[0]
    for s in range(count * part // parts, count * (part + 1) // parts):
        for k in range(2):
            v = edges[s, k]
            ends[s, 3 * k], ends[s, 3 * k + 1], ends[s, 3 * k + 2] = xy[2 * v], xy[2 * v + 1], depth[v]
        unplaced += not (np.isfinite(ends[s, 2]) & np.isfinite(ends[s, 5]))
        seen, behind = False, True
        for k in range(2):
            f = edges[s, 2 + k]
            own[s, k] = -1 if f < 0 else f if group[f] < 0 else faces + group[f]
            seen |= f >= 0 and shown[f]
            behind &= f >= 0 and far[f]
        fate[s] = TURNED_AWAY if not seen else BEHIND_ITSELF if behind else TESTED
    return unplaced


@helper
def solved(at_0, at_1, t0, t1):
    """The part of t0..t1 where a number that is at_0 for t = 0 and at_1 for t = 1 is not below 0."""
    if at_0 < 0.0:
        return (max(t0, at_0 / (at_0 - at_1)), t1) if at_1 > 0.0 else (1.0, 0.0)
    return (t0, min(t1, at_0 / (at_0 - at_1))) if at_1 < 0.0 else (t0, t1)


@helper
def under(at_0, at_1, at_first, at_last, t0, t1):
    """The part of t0..t1 that is under a cap: at_0 and at_1 are how far, less what is in doubt.

    An end that is a corner of the body (at_first, at_last) is not above the cap, whatever the doubt: what is
    hidden begins right there, if any of it is under.
    """
    if at_first | at_last:
        if max(at_0 + t0 * (at_1 - at_0), at_0 + t1 * (at_1 - at_0)) <= 0.0:
            return 1.0, 0.0
        at_0, at_1 = max(at_0, 0.0) if at_first else at_0, max(at_1, 0.0) if at_last else at_1
    return solved(at_0, at_1, t0, t1)


@kernel
def _solve(
    first, end, front, step, ends, own, fate, inside, passage_start, passage_cell, passage_span, list_start,
    listed, owner, farthest, box, side_start, side, corner, cap_start, cap,
):  # fmt: skip
    """(seen edge, seen, hidden edge, hidden, tests) of edges first..end."""
    room, shown, behind, tests = 2 * (end - first) + 16, 0, 0, 0
    seen_edge, seen_at = np.empty(room, np.int32), np.empty((room, 4))
    hidden_edge, hidden_at = np.empty(room, np.int32), np.empty((room, 4))
    hidden, met = np.empty((owner.shape[0] + 1, 2)), np.full(owner.shape[0], -1, np.int32)
    for s in range(first, end):
        begin, stop = max(inside[s, 0], 0.0), min(inside[s, 1], 1.0)
        if not begin < stop:
            continue
        ax, ay, az, bx, by, bz = ends[s, 0], ends[s, 1], ends[s, 2], ends[s, 3], ends[s, 4], ends[s, 5]
        left, right, up, down = min(ax, bx), max(ax, bx), min(ay, by), max(ay, by)
        long = max(right - left, down - up)
        deep, dust, n = (front - min(az, bz)) / step, DUST / long, 0
        own_f, own_g = own[s, 0], own[s, 1]
        passages = range(passage_start[s], passage_start[s + 1])
        if fate[s] != TESTED:
            hidden[0, 0], hidden[0, 1], n = begin, stop, 1
            passages = range(0)
        for passage in passages:
            cell = passage_cell[passage]
            c0, c1 = max(passage_span[passage, 0], begin), min(passage_span[passage, 1], stop)
            covered, changed = False, True
            for at in range(list_start[cell], list_start[cell + 1]):
                if changed:
                    for i in range(n):
                        covered |= (hidden[i, 0] <= c0) & (hidden[i, 1] >= c1)
                    changed = False
                # Nothing is left to hide in this cell, or nothing that begins near enough to hide it
                if covered or float(listed[at] >> 32) > deep:
                    break
                b = listed[at] & NUMBER
                if (box[b, 0] > right) | (box[b, 2] < left) | (box[b, 1] > down) | (box[b, 3] < up):
                    continue
                if (met[b] == s) | (owner[b] == own_f) | (owner[b] == own_g):
                    continue
                met[b] = s
                tests += 1
                t0, t1 = begin, stop
                for k in range(side_start[b], side_start[b + 1]):
                    px, py = float(side[k, 0]), float(side[k, 1])
                    dx, dy = float(side[k, 2]) - px, float(side[k, 3]) - py
                    at_a, at_b = dx * (ay - py) - dy * (ax - px), dx * (by - py) - dy * (bx - px)
                    t0, t1 = solved(at_a, at_b, t0, t1)
                    if not t0 < t1:
                        break
                # Deeper than all of the body, it needs no cap
                if t0 < t1 and max(az + t0 * (bz - az), az + t1 * (bz - az)) >= farthest[b]:
                    at_first, at_last = False, False
                    for k in range(side_start[b], side_start[b + 1]):
                        x, y, z = float(side[k, 0]), float(side[k, 1]), corner[k]
                        at_first |= (x == ax) & (y == ay) & (z == az)
                        at_last |= (x == bx) & (y == by) & (z == bz)
                    short = (at_first | at_last) & ((t1 - t0) * long <= SPECK)
                    for k in range(cap_start[b], cap_start[b + 1]):
                        x, y, p, q = cap[k, 0], cap[k, 1], cap[k, 3], cap[k, 4]
                        z = cap[k, 2] + cap[k, 5] if short else cap[k, 2]
                        over_a = z + p * (ax - x) + q * (ay - y) - az
                        over_b = z + p * (bx - x) + q * (by - y) - bz
                        t0, t1 = under(over_a, over_b, at_first, at_last, t0, t1)
                        if not t0 < t1:
                            break
                if not t0 < t1:
                    continue
                n = with_span(hidden, n, t0, t1, dust)
                changed = True

        # What is seen and what is hidden, by turns; dust goes to its neighbour
        if max(shown, behind) + n + 1 > room:
            more = room + n
            room += more
            seen_edge = np.concatenate((seen_edge, np.empty(more, np.int32)))
            seen_at = np.concatenate((seen_at, np.empty((more, 4))))
            hidden_edge = np.concatenate((hidden_edge, np.empty(more, np.int32)))
            hidden_at = np.concatenate((hidden_at, np.empty((more, 4))))
        place = begin
        for i in range(n + 1):
            t0, t1 = (hidden[i, 0], hidden[i, 1]) if i < n else (stop, stop)
            t0 = t0 if t0 - begin > dust else begin
            t1 = t1 if stop - t1 > dust else stop
            if i < n and t1 - t0 <= dust and (t0 > begin or t1 < stop):
                continue
            if t0 > place:
                seen_edge[shown] = s
                seen_at[shown, 0], seen_at[shown, 1] = ax + place * (bx - ax), ay + place * (by - ay)
                seen_at[shown, 2], seen_at[shown, 3] = ax + t0 * (bx - ax), ay + t0 * (by - ay)
                shown += 1
            if i < n:
                hidden_edge[behind] = s
                hidden_at[behind, 0], hidden_at[behind, 1] = ax + t0 * (bx - ax), ay + t0 * (by - ay)
                hidden_at[behind, 2], hidden_at[behind, 3] = ax + t1 * (bx - ax), ay + t1 * (by - ay)
                behind += 1
            place = t1
    seen, hidden_parts = seen_at[:shown] / UNITS, hidden_at[:behind] / UNITS
    return seen_edge[:shown].copy(), seen, hidden_edge[:behind].copy(), hidden_parts, tests
