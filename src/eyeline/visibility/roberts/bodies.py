"""The convex bodies that hide: each the common inside of half spaces, its sides and its caps.

On the picture's grid sight lines are parallel to the axis of depth. What a convex body hides is the prism
behind it: inside each of its sides, a line of its outline on the screen, and behind each of its caps, the
plane of a near face. Any surface is split into such bodies exactly, for a single face is one: flat, with
three sides and a cap. Faces are taken together where that leaves fewer inequalities and takes nothing away:
a small closed part that is convex is one body, and so are two faces in one plane.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray, read_only
from eyeline.jit import kernel, share, threads
from eyeline.projection.projected import Projected
from eyeline.visibility.roberts.convex_groups import ROUNDING, SMALL, Facing, flat, rounding, slopes
from eyeline.visibility.roberts.mesh_edges import MeshEdges

STEPS = 65535  # of depth, to sort by: fine enough to meet early what hides most, coarse enough to sort fast


@dataclass(frozen=True, eq=False)
class Bodies:
    """Convex bodies, single faces before groups of them; places are in 1/256 pixel."""

    owner: IntArray  # (B,) int32: the uncut face it is, or is a piece of; F + g for the group g of faces
    face: IntArray  # (B,) int32: an uncut face of it
    farthest: FloatArray  # (B,) what is deeper than this is behind all of it, whatever the rounding
    box: IntArray  # (B, 4) int32: left, top, right, bottom
    side_start: IntArray  # (B + 1,) int64
    side: IntArray  # (S, 4) int32: from x, y to x, y; the inside is to the right as one walks along it
    corner: FloatArray  # (S,) the depth where each side begins
    cap_start: IntArray  # (B + 1,) int64
    cap: FloatArray  # (C, 6): x, y, the depth there less all that snapping can have added, its slopes, that
    key: (
        IntArray  # (B,) int64, rising: how many steps of depth a body begins behind `front`, above its number
    )
    front: float  # depth of the nearest corner of all
    step: float  # of depth

    def steps(self, depth: float) -> float:
        """How many steps a depth is behind the nearest corner: what begins later hides nothing there."""
        return (self.front - depth) / self.step


def bodies_of(projected: Projected, edges: MeshEdges, facing: Facing) -> Bodies:
    """Every body that may hide something."""
    count = len(projected.faces)
    single = np.flatnonzero(facing.drawn & (facing.group < 0)).astype(np.int32)
    joined = np.unique(facing.group[facing.group >= 0])
    size, alone = len(single) + len(joined), len(single)
    caps = alone + int(((facing.group >= 0) & ~facing.far).sum())
    arrays = (
        projected.source, edges.start, edges.member, facing.far, facing.turn, facing.group, edges.beyond,
    )  # fmt: skip
    given = (*(read_only(np.ascontiguousarray(array)) for array in arrays), *flat(projected))
    owner, face = np.concatenate([single, count + joined]).astype(np.int32), np.empty(size, np.int32)
    nearest, farthest, box = np.empty(size), np.empty(size), np.empty((size, 4), np.int32)
    side_start, cap_start = np.zeros(size + 1, np.int64), np.zeros(size + 1, np.int64)
    side, corner, cap = np.empty((3 * caps, 4), np.int32), np.empty(3 * caps), np.empty((caps, 6))
    filled = (owner, face, farthest, box, side_start, side, corner, cap_start, cap)
    parts, least = threads() if alone > SMALL else 1, rounding(projected)

    def shape(first: int, end: int) -> None:
        _shape(first, end, least, nearest, *filled, *given)

    share(lambda part: shape(alone * part // parts, alone * (part + 1) // parts), parts)
    shape(alone, size)
    return Bodies(*filled, *nearest_first(nearest))


def nearest_first(depth: FloatArray) -> tuple[IntArray, float, float]:
    """(key, front, step) of bodies with their nearest corners at these depths (B,)."""
    front = float(depth.max(initial=0.0))
    step = (front - float(depth.min(initial=front))) / STEPS or 1.0
    steps = ((front - depth) / step).astype(np.uint16)
    order = np.argsort(steps, kind="stable")
    return (steps[order].astype(np.int64) << 32) | order, front, step


@kernel
def _shape(
    begin, stop, rounding, nearest, owner, face, farthest, box, side_start, side, corner, cap_start,
    cap, source, start, member, far, turn, group, beyond, corners, xy, depth,
):  # fmt: skip
    """Fill bodies begin..stop, single faces or all groups; owner becomes the uncut face a face is cut from.

    A single face has three sides and one cap, so that any of them can be filled before those before it.
    """
    count, sides, caps = turn.shape[0], 3 * begin, begin
    for b in range(begin, stop):
        g = owner[b] - count
        first, end = (np.int64(0), np.int64(1)) if g < 0 else (start[g], start[g + 1])
        left, up, right, down = (
            np.int32(2**31 - 1),
            np.int32(2**31 - 1),
            np.int32(-(2**31)),
            np.int32(-(2**31)),
        )
        front, back = -np.inf, np.inf
        for m in range(first, end):
            f = owner[b] if g < 0 else member[m]
            for c in range(3):
                v = corners[3 * f + c]
                left, right = min(left, xy[2 * v]), max(right, xy[2 * v])
                up, down = min(up, xy[2 * v + 1]), max(down, xy[2 * v + 1])
                front, back = max(front, np.float64(depth[v])), min(back, np.float64(depth[v]))
            if far[f]:
                continue
            face[b] = source[f]
            for c in range(3):
                other = beyond[f, c] if g >= 0 else -1
                if other >= 0 and group[other] == g and not far[other]:
                    continue
                p, q = corners[3 * f + c], corners[3 * f + (c + 1) % 3]
                if turn[f] < 0:
                    p, q = q, p
                side[sides, 0], side[sides, 1] = xy[2 * p], xy[2 * p + 1]
                side[sides, 2], side[sides, 3] = xy[2 * q], xy[2 * q + 1]
                corner[sides] = depth[p]
                sides += 1
            i, j, k = corners[3 * f], corners[3 * f + 1], corners[3 * f + 2]
            x0, y0, z0 = np.int64(xy[2 * i]), np.int64(xy[2 * i + 1]), np.float64(depth[i])
            x1, y1, z1 = np.int64(xy[2 * j]), np.int64(xy[2 * j + 1]), np.float64(depth[j])
            x2, y2, z2 = np.int64(xy[2 * k]), np.int64(xy[2 * k + 1]), np.float64(depth[k])
            down_x, down_y = slopes(x0, y0, z0, x1, y1, z1, x2, y2, z2)
            # Half a unit that its corners were moved by, and half a unit that whatever is behind it was
            doubt = abs(down_x) + abs(down_y) + ROUNDING * max(abs(z0), abs(z1), abs(z2)) + rounding
            cap[caps, 0], cap[caps, 1], cap[caps, 2] = x0, y0, z0 - doubt
            cap[caps, 3], cap[caps, 4], cap[caps, 5] = down_x, down_y, doubt
            caps += 1
        nearest[b], farthest[b] = front, back - ROUNDING * abs(back) - rounding
        box[b, 0], box[b, 1], box[b, 2], box[b, 3] = left, up, right, down
        side_start[b + 1], cap_start[b + 1] = sides, caps
        owner[b] = source[owner[b]] if g < 0 else owner[b]
