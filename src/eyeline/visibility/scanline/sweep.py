"""A row becomes spans: a sweep over its columns keeps the face in front, until it ends or is overtaken.

Segments wait at their first column. Those that are hidden but go on are kept in a heap, the greatest depth on
top: when the front ends, only those whose greatest depth reaches the new front's least are compared.
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray, read_only
from eyeline.geometry.fixedpoint import depth_at
from eyeline.jit import helper, kernel, share, threads
from eyeline.projection.projected import Projected
from eyeline.visibility.scanline.active_edges import TURNS, WORDS, cross, enter, room_for
from eyeline.visibility.scanline.edge_table import LAST_ROW, ROW_BITS, EdgeTable
from eyeline.visibility.scanline.overtaking import overtaken


def scan(projected: Projected, table: EdgeTable, face: IntArray, depth: FloatArray) -> IntArray:
    """Fill face and depth, (H, W); the most active edges of a row, the spans and the depth comparisons."""
    parts, most = threads(), int(np.diff(table.starts).max())
    vertices = read_only(projected.xy.view(np.int64)).reshape(-1), read_only(projected.depth)
    faces, pieces = read_only(projected.faces).reshape(-1), read_only(projected.piece_source)
    mesh = faces, *vertices, projected.face_count, pieces
    rows = table.rows, table.starts, table.entries, table.shift
    picture = projected.width, projected.height, face.reshape(-1), depth.reshape(-1)
    work = np.zeros((parts, 8), dtype=np.int64)

    def scan_part(part: int) -> None:
        room = room_for(most, projected.width, 1 << table.shift)
        scan_bands(part, parts, mesh, rows, picture, room, work[part])

    share(scan_part, parts)
    return np.array([work[:, 0].max(), *work[:, 1:3].sum(axis=0)])


@kernel
def scan_bands(part, parts, mesh, table, picture, room, work):
    """Fill the rows of bands part, part + parts, ...

    work: int64, most active edges of a row, spans, depth comparisons.
    """
    faces, xy, depth, uncut, pieces = mesh
    rows, starts, entries, shift = table
    width, height, seen_face, seen_depth = picture
    lines, turns, active = room.lines, room.turns, room.active
    first, last, near, following, heads = room.first, room.last, room.near, room.following, room.heads
    for band in range(part, starts.shape[0] - 1, parts):
        row0 = band << shift
        own = entries[starts[band] : starts[band + 1]]
        bucket(own, rows, row0, room.begins, room.order)
        count, entered = 0, 0
        for y in range(row0, min(height, row0 + (1 << shift))):
            # Edges that begin on this row become active
            while entered < room.begins[y - row0 + 1]:
                f, slot = room.order[entered], active[count]
                i, j, k = np.uint32(faces[3 * f]), np.uint32(faces[3 * f + 1]), np.uint32(faces[3 * f + 2])
                enter(
                    slot,
                    (xy[i], xy[j], xy[k]),
                    (depth[i], depth[j], depth[k]),
                    rows[f] & LAST_ROW,
                    y,
                    lines,
                    turns,
                )
                source = np.int64(f if f < uncut else pieces[f - uncut])
                room.number[slot] = source << 32 | np.int64(f)
                count, entered = count + 1, entered + 1
            work[0] = max(work[0], 2 * count)
            staying = 0
            for n in range(count):
                slot = np.uint32(active[n])
                begin, end, nearest = cross(slot, y, width, lines, turns)
                if begin <= end:
                    first[slot], last[slot], near[slot] = begin, end, nearest
                    following[slot] = heads[np.uint32(begin)]
                    heads[np.uint32(begin)] = slot
                # Slots of faces that end here are the next to be taken, while they are in the cache
                active[n], active[staying] = active[staying], slot
                staying += turns[TURNS * slot + 2] > y
            count = staying
            spans, tries = sweep(
                y, room, seen_face[y * width : (y + 1) * width], seen_depth[y * width : (y + 1) * width]
            )
            work[1] += spans
            work[2] += tries


@helper
def bucket(entries, rows, row0, begins, order):
    """Sort the faces of a band by the row where they enter; begins: where those of each row begin."""
    begins[:] = 0
    for n in range(entries.shape[0]):
        begins[max((rows[entries[n]] >> ROW_BITS) - row0, 0) + 1] += 1
    for r in range(1, begins.shape[0]):
        begins[r] += begins[r - 1]
    # Each place moves on as it is taken: from the end backwards, so that what is left are the beginnings
    for n in range(entries.shape[0] - 1, -1, -1):
        r = max((rows[entries[n]] >> ROW_BITS) - row0, 0) + 1
        begins[r] -= 1
        order[begins[r]] = entries[n]
    for r in range(1, begins.shape[0]):
        begins[r - 1] = begins[r]
    begins[begins.shape[0] - 1] = entries.shape[0]


@helper
def sweep(y, room, seen_face, seen_depth):
    """Fill a row; how many spans it has and how many depth comparisons that took."""
    heads, following, last = room.heads, room.following, room.last
    lines, near, number, heap, rivals = room.lines, room.near, room.number, room.heap, room.rivals
    width, size, front, x = heads.shape[0], 0, -1, 0
    until, least, shown, spans, comparisons = 0, np.float32(0), -2, 0, 0
    while x < width:
        fresh, count, arrival = front < 0, 0, heads[x]
        heads[x] = -1
        if fresh:
            # The greatest depth that is left or begins here
            while size > 0 and last[heap[0]] < x:
                size = pop(heap, size, near, number)
            slot, begins = arrival, False
            if size > 0:
                front = heap[0]
            while slot >= 0:
                if front < 0 or before(slot, front, near, number):
                    front, begins = slot, True
                slot = following[slot]
            if front >= 0 and not begins:
                size = pop(heap, size, near, number)
        # Its rivals are those that begin here; and once, when it comes to the front, those that reach it
        while arrival >= 0:
            if arrival != front:
                rivals[count] = arrival
                count += 1
            arrival = following[arrival]
        while front >= 0:
            at = WORDS * front
            a, b, c = lines[at], lines[at + 1], lines[at + 2]
            if fresh:
                until = last[front] + 1
                least = min(depth_at(a, b, c, x, y), depth_at(a, b, c, last[front], y))
                while size > 0 and near[heap[0]] >= least:
                    slot = heap[0]
                    size = pop(heap, size, near, number)
                    rivals[count] = slot
                    count += last[slot] >= x
            # Until where it leads; rivals go on that are nearer somewhere, or end later
            fresh, going, nearest, place, nearest_depth = False, 0, -1, 0, np.float32(0)
            for n in range(count):
                slot = rivals[n]
                other, end = WORDS * slot, min(last[slot], last[front])
                meets = end + 1
                if near[slot] >= least:
                    meets, tries = overtaken(
                        a, c + b * np.float64(y),
                        lines[other], lines[other + 2] + lines[other + 1] * np.float64(y),
                        number[front] < number[slot], x, end,
                    )  # fmt: skip
                    comparisons += tries
                if meets > end and last[slot] <= last[front]:
                    continue
                if meets <= end:
                    until = min(until, meets)
                if meets == x:
                    own = depth_at(lines[other], lines[other + 1], lines[other + 2], x, y)
                    if (
                        nearest < 0
                        or own > nearest_depth
                        or (own == nearest_depth and number[slot] < number[nearest])
                    ):
                        nearest, nearest_depth, place = slot, own, going
                rivals[going] = slot
                going += 1
            count = going
            if nearest < 0:
                break
            # Somebody is nearer at this very column: the nearest of them comes to the front
            rivals[place], front, fresh = front, nearest, True
        for n in range(count):
            size = push(rivals[n], heap, size, near, number)
        # A span, until something begins or the lead is over
        stop = x + 1
        while stop < (until if front >= 0 else width) and heads[stop] < 0:
            stop += 1
        changes, shown = fill(front, x, stop, y, shown, lines, number, seen_face, seen_depth)
        spans += changes
        x = stop
        if front >= 0 and x == until:
            if x <= last[front]:
                size = push(front, heap, size, near, number)
            front = -1
    return spans, comparisons


@helper
def fill(front, x, stop, y, shown, lines, number, seen_face, seen_depth):
    """Fill columns x..stop - 1 with the front; how many spans begin there, and the last face shown."""
    if front < 0:
        seen_face[x:stop] = -1
        seen_depth[x:stop] = 0
        return np.int64(shown != -1), -1
    a, b, c = lines[WORDS * front], lines[WORDS * front + 1], lines[WORDS * front + 2]
    source = np.int64(number[front] >> 32)
    if min(depth_at(a, b, c, x, y), depth_at(a, b, c, stop - 1, y)) > 0:
        for column in range(x, stop):
            seen_face[column] = source
            seen_depth[column] = depth_at(a, b, c, column, y)
        return np.int64(shown != source), source
    # Depth 0 is as far as the back, which is nothing
    changes = 0
    for column in range(x, stop):
        own = depth_at(a, b, c, column, y)
        face = source if own > 0 else -1
        changes += face != shown
        shown = face
        seen_face[column] = face
        seen_depth[column] = own if own > 0 else np.float32(0)
    return changes, shown


# --- a heap of segments -----------------------------------------------------------------------------------


@helper
def before(slot, other, near, number):
    """Whether a segment reaches nearer than another; of equal ones the lower number."""
    return (near[slot] > near[other]) | ((near[slot] == near[other]) & (number[slot] < number[other]))


@helper
def push(slot, heap, size, near, number):
    """Put a segment into a heap; its size."""
    at = size
    while at > 0 and before(slot, heap[(at - 1) >> 1], near, number):
        heap[at] = heap[(at - 1) >> 1]
        at = (at - 1) >> 1
    heap[at] = slot
    return size + 1


@helper
def pop(heap, size, near, number):
    """Take the top from a heap; its size. [Floyd64]"""
    size -= 1
    slot, at = heap[size], 0
    while True:
        child = 2 * at + 1
        if child >= size:
            break
        if child + 1 < size and before(heap[child + 1], heap[child], near, number):
            child += 1
        if not before(heap[child], slot, near, number):
            break
        heap[at] = heap[child]
        at = child
    heap[at] = slot
    return size
