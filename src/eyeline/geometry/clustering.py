"""A binary tree over boxes, from the bottom up: neighbours on a curve whose joint box is least become one.

Round after round every box looks at some places to its left and right; those that choose each other are
merged. The trees are nearly as good as those built top down, and everything is done in rows. [Meister18]
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.jit import in_parts, kernel

RADIUS = 8  # places to each side that are looked at
ROUNDS = 100  # after which neighbours are merged as they stand: sizes can be such that few choose each other
SLOTS = 8  # children of a wide node
CHUNK = 1024  # boxes looked at together
FEW = 4096  # boxes: fewer are not worth a second thread
FAR = np.float32(1e18)  # beside boxes of size 1


def clustered(boxes: FloatArray, parts: int) -> tuple[IntArray, FloatArray]:
    """child (L - 1, 2), the two halves of nodes L, L + 1 ... above leaves 0 .. L - 1, and cost (L, 8).

    boxes: (6, L) float32, low and high corners in 0..1, along the curve. cost[0] is that of any leaf;
    cost[q - L + 1, s] is the least area of wide nodes over node q if it may take s + 1 slots of one.
    """
    leaves = boxes.shape[1]
    child, cost = np.empty((leaves, 2), np.int32), np.zeros((leaves, SLOTS), np.float32)
    rows, others = np.empty((2, 6, leaves + 2 * RADIUS), np.float32)
    rows[:, RADIUS:-RADIUS] = boxes
    ids, later = np.arange(leaves, dtype=np.int32), np.empty(leaves, np.int32)
    mate, place, made = np.empty((3, leaves), np.int32)
    count, top, rounds = leaves, leaves, 0
    while count > 1:
        shared = parts if count > FEW else 1
        for side in (slice(0, RADIUS), slice(count + RADIUS, count + 2 * RADIUS)):
            rows[:3, side], rows[3:, side] = -FAR, FAR
        if rounds < ROUNDS:
            in_parts(shared, choose_mates, rows, count, mate)
        else:
            mate[:count] = (np.arange(count) ^ 1) % count
        left, above = place_clusters(mate, count, top, place, made)
        plan, now, then = (mate, place, made), (rows, ids), (others, later)
        in_parts(shared, merge, count, leaves, plan, now, then, child, cost)
        count, top, rounds = left, above, rounds + 1
        rows, others, ids, later = others, rows, later, ids
    return child, cost


@kernel
def choose_mates(part, parts, rows, count, mate):
    """mate[i]: the box within RADIUS places of box i whose union with it has the least area.

    Ties go to the nearer place, then to pairs that start in even blocks: a total order of pairs, so that
    some always choose each other.
    """
    best, step = np.empty(CHUNK, np.float32), np.empty(CHUNK, np.int32)
    area = np.empty(CHUNK + RADIUS, np.float32)
    chunks = (count + CHUNK - 1) // CHUNK
    for chunk in range(chunks * part // parts, chunks * (part + 1) // parts):
        first = chunk * CHUNK
        size = min(count - first, CHUNK)
        for i in range(size):
            best[i] = np.float32(np.inf)
        block = np.int32(1)
        for s in range(1, RADIUS + 1):
            block = np.int32(2 * block) if s >= 2 * block else block
            d, begin, here = np.int32(s), first + RADIUS - s, first + RADIUS
            end = here + size
            ax, ay, az = rows[0, begin:end], rows[1, begin:end], rows[2, begin:end]
            bx, by, bz = rows[3, begin:end], rows[4, begin:end], rows[5, begin:end]
            cx, cy, cz = rows[0, here:], rows[1, here:], rows[2, here:]
            dx, dy, dz = rows[3, here:], rows[4, here:], rows[5, here:]
            # area[i] is that of boxes first - s + i and first + i together
            for i in range(size + s):
                x = (bx[i] if bx[i] > dx[i] else dx[i]) - (ax[i] if ax[i] < cx[i] else cx[i])
                y = (by[i] if by[i] > dy[i] else dy[i]) - (ay[i] if ay[i] < cy[i] else cy[i])
                z = (bz[i] if bz[i] > dz[i] else dz[i]) - (az[i] if az[i] < cz[i] else cz[i])
                area[i] = x * y + y * z + z * x
            ahead = area[s:]
            for i in range(size):
                index = np.int32(first + i)
                even = ((index & block) == 0) | (((index - d) & block) != 0)
                forward = (ahead[i] < area[i]) | ((ahead[i] == area[i]) & even)
                least = ahead[i] if forward else area[i]
                step[i] = (d if forward else np.int32(-d)) if least < best[i] else step[i]
                best[i] = least if least < best[i] else best[i]
        for i in range(size):
            mate[first + i] = np.int32(first + i) + step[i]


@kernel
def place_clusters(mate, count, top, place, made):
    """Where each box goes in the next round, and the node it becomes if it starts a pair; both totals."""
    left = 0
    for i in range(count):
        place[i], made[i] = left, top
        mutual = mate[mate[i]] == i
        left += (not mutual) | (i < mate[i])
        top += mutual & (i < mate[i])
    return left, top


@kernel
def merge(part, parts, count, leaves, plan, now, then, child, cost):
    """Move boxes that stay alone, and join those that chose each other: the next round's boxes."""
    mate, place, made = plan
    rows, ids = now
    later_rows, later_ids = then
    for i in range(count * part // parts, count * (part + 1) // parts):
        j, to = mate[i], place[i]
        if mate[j] != i:
            later_ids[to] = ids[i]
            for k in range(6):
                later_rows[k, to + RADIUS] = rows[k, i + RADIUS]
        elif i < j:
            node, a, b = made[i], ids[i], ids[j]
            later_ids[to], child[node - leaves, 0], child[node - leaves, 1] = node, a, b
            for k in range(3):
                later_rows[k, to + RADIUS] = min(rows[k, i + RADIUS], rows[k, j + RADIUS])
                later_rows[k + 3, to + RADIUS] = max(rows[k + 3, i + RADIUS], rows[k + 3, j + RADIUS])
            x = later_rows[3, to + RADIUS] - later_rows[0, to + RADIUS]
            y = later_rows[4, to + RADIUS] - later_rows[1, to + RADIUS]
            z = later_rows[5, to + RADIUS] - later_rows[2, to + RADIUS]
            # The least cost of each number of slots, shared between the halves [Ylitie17]
            node, a, b = node - leaves + 1, max(a - leaves + 1, 0), max(b - leaves + 1, 0)
            for s in range(1, SLOTS):
                best = cost[a, 0] + cost[b, s - 1]
                for k in range(1, s):
                    best = min(best, cost[a, k] + cost[b, s - 1 - k])
                cost[node, s] = best
            # On one slot the node is a wide one itself
            cost[node, 0] = cost[node, SLOTS - 1] + (x * y + y * z + z * x)
            for s in range(1, SLOTS):
                cost[node, s] = min(cost[node, s], cost[node, s - 1])
