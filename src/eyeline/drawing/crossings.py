"""Where faces of different parts pass through each other.

Which edge pierces which face is read off signs of volumes. A volume is computed from its points in the order
of their numbers and a zero counts as positive: every caller finds the same sign, so that the lines of
neighbouring faces meet at the same edges, and no line ends inside a face. [Edelsbrunner90]
"""

from __future__ import annotations

import numpy as np

from eyeline.drawing.choice import normal
from eyeline.drawing.kinds import INTERSECTION
from eyeline.drawing.model import Model
from eyeline.drawing.near_pairs import near_pairs
from eyeline.drawing.strokes import Strokes
from eyeline.geometry.arrays import IntArray, read_only
from eyeline.jit import helper, kernel, share, threads

CONTACT = 2.0**-22  # what counts as touching, as a part of the largest coordinate: a step or two of float32


def crossing_strokes(model: Model, rows: IntArray) -> Strokes | None:
    """Strokes along which some faces (N,) pass through faces of other parts; None if there is none."""
    if len(rows) == 0 or model.part[rows].min() == model.part[rows].max():
        return None
    pairs = near_pairs(model, rows)
    count = len(pairs)
    if count == 0:
        return None
    contact = CONTACT * float(np.abs(model.points).max())
    ends, touch, found = np.empty((count, 2, 3)), np.empty((count, 2, 3), np.int64), np.zeros(count, np.bool_)
    arrays = (read_only(model.points), read_only(model.faces), read_only(model.edges))
    parts = threads() if count > 1 << 10 else 1
    share(
        lambda part: _cross(
            part, parts, *arrays, read_only(model.face_edges), pairs, contact, ends, touch, found
        ),
        parts,
    )
    pairs, ends, touch = pairs[found], ends[found], touch[found]
    low, high, face = touch.reshape(-1, 3).T
    edge = np.unique(low * len(model.points) + high, return_inverse=True)[1]
    name = np.unique(edge * len(model.faces) + face, return_inverse=True)[1] + len(model.points)
    return Strokes(
        ends, np.zeros_like(ends), np.full(len(pairs), INTERSECTION, np.uint8), model.surface[pairs[:, 0]],
        pairs, touch[..., [0, 1]].reshape(-1, 4).astype(np.int32), name.reshape(-1, 2),
    )  # fmt: skip


@helper
def above(i, j, k, m):
    """1 or -1: the side of plane ijk that m is on; each is (number, x, y, z)."""
    sign = 1
    if i[0] > j[0]:
        i, j, sign = j, i, -sign
    if k[0] > m[0]:
        k, m, sign = m, k, -sign
    if i[0] > k[0]:
        i, k, sign = k, i, -sign
    if j[0] > m[0]:
        j, m, sign = m, j, -sign
    if j[0] > k[0]:
        j, k, sign = k, j, -sign
    nx, ny, nz = normal(i[1], i[2], i[3], j[1], j[2], j[3], k[1], k[2], k[3])
    volume = nx * (m[1] - i[1]) + ny * (m[2] - i[2]) + nz * (m[3] - i[3])
    return sign if volume >= 0.0 else -sign


@helper
def height(a, b, c, p):
    """Distance of p from the plane abc, with sign; each is (number, x, y, z)."""
    nx, ny, nz = normal(a[1], a[2], a[3], b[1], b[2], b[3], c[1], c[2], c[3])
    over = nx * (p[1] - a[1]) + ny * (p[2] - a[2]) + nz * (p[3] - a[3])
    return over / np.sqrt(nx * nx + ny * ny + nz * nz)


@kernel
def _cross(part, parts, points, faces, edges, face_edges, pairs, contact, ends, touch, found):
    """For each pair the two places where an edge of one pierces the other; not found where they only touch.

    touch: for each end the edge, as two vertices, and the face that meet there.
    """
    count, highs = pairs.shape[0], np.empty(3)
    for i in range(count * part // parts, count * (part + 1) // parts):
        n, passing = 0, True
        for turned in range(2):
            f, g = pairs[i, turned], pairs[i, 1 - turned]
            a, b, c = faces[g, 0], faces[g, 1], faces[g, 2]
            at_a = (a, points[a, 0], points[a, 1], points[a, 2])
            at_b = (b, points[b, 0], points[b, 1], points[b, 2])
            at_c = (c, points[c, 0], points[c, 1], points[c, 2])
            for k in range(3):
                u = faces[f, k]
                highs[k] = height(at_a, at_b, at_c, (u, points[u, 0], points[u, 1], points[u, 2]))
            lowest, highest = min(highs[0], highs[1], highs[2]), max(highs[0], highs[1], highs[2])
            below, over, level = lowest < -contact, highest > contact, 0
            if (lowest > contact) | (highest < -contact):
                passing = False
                break
            for k in range(3):
                u, v = faces[f, k], faces[f, (k + 1) % 3]
                high_u, high_v = highs[k], highs[(k + 1) % 3]
                if u > v:
                    u, v, high_u, high_v = v, u, high_v, high_u
                at_u = (u, points[u, 0], points[u, 1], points[u, 2])
                at_v = (v, points[v, 0], points[v, 1], points[v, 2])
                if (abs(high_u) <= contact) & (abs(high_v) <= contact):
                    level = k + 1
                if n == 3 or above(at_a, at_b, at_c, at_u) == above(at_a, at_b, at_c, at_v):
                    continue
                first = above(at_u, at_v, at_a, at_b)
                if first != above(at_u, at_v, at_b, at_c) or first != above(at_u, at_v, at_c, at_a):
                    continue
                if max(abs(high_u), abs(high_v)) > contact:
                    if n < 2:
                        for x in range(3):
                            step = (points[v, x] - points[u, x]) * high_u / (high_u - high_v)
                            ends[i, n, x] = points[u, x] + step
                        touch[i, n, 0], touch[i, n, 1], touch[i, n, 2] = u, v, g
                    n += 1
            if not (below and over):
                # f only reaches the plane of g: does the face beyond its level edge go on to the other side?
                edge = face_edges[f, level - 1] if level > 0 else -1
                h = -1 if edge < 0 else (edges[edge, 3] if edges[edge, 2] == f else edges[edge, 2])
                beyond = False
                if h >= 0:
                    for k in range(3):
                        w = faces[h, k]
                        if (w != edges[edge, 0]) & (w != edges[edge, 1]):
                            high = height(at_a, at_b, at_c, (w, points[w, 0], points[w, 1], points[w, 2]))
                            beyond = high > contact if below else high < -contact
                passing &= beyond
        long = 0.0
        if passing and n == 2:
            for x in range(3):
                long = max(long, abs(ends[i, 0, x] - ends[i, 1, x]))
        found[i] = passing and long > contact
