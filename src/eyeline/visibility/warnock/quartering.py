"""Warnock's subdivision: every tile is cut into quarters until an area is simple enough to be filled.

Lists stand on each other in one row of memory. An area moves the faces that it keeps to the front of its own
list; the lists of its quarters follow, each with room for all of them.
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.fixedpoint import CENTRE, UNITS, depth_at, edge_bias
from eyeline.jit import helper, kernel
from eyeline.visibility.warnock.area_lists import (
    APART,
    AREAS,
    COMPARED,
    CONTAIN,
    CUT,
    HIDDEN,
    INTERSECT,
    LOW32,
    SURROUND,
    TILE,
    TILE_BITS,
)
from eyeline.visibility.warnock.relations import (
    CONTAINED,
    DISJOINT,
    SURROUNDING,
    WORDS,
    farthest,
    hides,
    lies,
    plane_of,
)

SMALL = 8  # pixels: an area as narrow and low as this is not cut, but seen pixel by pixel
CUTS = 3  # that lead from TILE to SMALL
EMPTY, SURROUNDED, SINGLE_FACE, SAMPLED = range(4)  # decisions


@kernel
def subdivide(
    part, parts, width, height, starts, entries, words, bound, face, depth, counts, limit, spent, areas,
    firsts,
):  # fmt: skip
    """Fill face and depth (as int32), both flat, and the counters, in tiles part, part + parts, ...

    limit: of relations and comparisons; once all parts together have taken more, it stops.
    spent: (parts,) int64 zeros, how many each part has taken so far.
    areas: (N, 6) int32: left, top, right, bottom, decision, face, of each area that is not cut, a tile's from
    firsts[tile] on; without rows they are not written.
    """
    columns, longest = ((width - 1) >> TILE_BITS) + 1, 0
    for tile in range(starts.shape[0] - 1):
        longest = max(longest, starts[tile + 1] - starts[tile])
    room = np.empty((4 * CUTS + 1) * longest, np.int64)
    keys = np.zeros(TILE * TILE, np.int64)  # of the pixels of a tile
    # Of areas to come: left, top, side, where their list begins and ends, where those of its quarters may
    stack = np.empty((4 * CUTS, 6), np.int64)
    for tile in range(part, starts.shape[0] - 1, parts):
        x, y = (tile % columns) << TILE_BITS, (tile // columns) << TILE_BITS
        count, at = starts[tile + 1] - starts[tile], 0
        for i in range(count):
            room[i] = entries[starts[tile] + i]
        push(stack, 0, 0, 0, TILE, 0, count, count)
        waiting, own = 1, counts[tile]
        while waiting > 0:
            waiting -= 1
            left, top, side = stack[waiting, 0], stack[waiting, 1], stack[waiting, 2]
            begin, end, free = stack[waiting, 3], stack[waiting, 4], stack[waiting, 5]
            right, bottom = min(left + side, width - x) - 1, min(top + side, height - y) - 1
            kept, s = look(
                room, begin, end, left, top, right, bottom, x, y, side > SMALL, words, bound, own,
            )  # fmt: skip
            own[AREAS] += 1
            spent[part] += (end - begin) + (side <= SMALL) * kept * SMALL * SMALL
            if total(spent) > limit:
                return
            if kept > 1 and side > SMALL:
                own[CUT] += 1
                half = side >> 1
                n0, n1, n2, n3 = hand_down(room, begin, kept, free, left + half, top + half)
                after = free + 4 * kept
                # The last comes first: top left, top right, bottom left, bottom right
                for quarter in range(3, -1, -1):
                    u, v = left + half * (quarter & 1), top + half * (quarter >> 1)
                    n = n0 if quarter == 0 else (n1 if quarter == 1 else (n2 if quarter == 2 else n3))
                    if (x + u < width) & (y + v < height):
                        own[APART] += kept - n
                        first = free + quarter * kept
                        push(stack, waiting, u, v, half, first, first + n, after)
                        waiting += 1
                continue
            decision, number = fill(
                room, begin, kept, s, left, top, right, bottom, x, y, words, keys, own
            )  # fmt: skip
            if areas.shape[0] > 0:
                write(areas, firsts[tile] + at, x + left, y + top, x + right, y + bottom, decision, number)
                at += 1
        finish(keys, x, y, min(TILE, width - x), min(TILE, height - y), width, face, depth)


@helper
def total(spent):
    """The sum of all parts."""
    work = np.int64(0)
    for k in range(spent.shape[0]):
        work += spent[k]
    return work


@helper
def push(stack, at, left, top, side, begin, end, free):
    """Put an area on the stack."""
    stack[at, 0], stack[at, 1], stack[at, 2] = left, top, side
    stack[at, 3], stack[at, 4], stack[at, 5] = begin, end, free


@helper
def hand_down(room, begin, kept, free, x, y):
    """Each face to the lists of the quarters it may reach; how many they hold. (x, y): the last quarter."""
    n0, n1, n2, n3 = free, free + kept, free + 2 * kept, free + 3 * kept
    for i in range(begin, begin + kept):
        entry = room[i]
        box = entry >> 32
        in_left, in_top = (box & 127) - 1 < x, ((box >> 7) & 127) - 1 < y
        in_right, in_bottom = ((box >> 14) & 127) - 1 >= x, ((box >> 21) & 127) - 1 >= y
        # Written to all four, and kept where the count goes on: no branch that cannot be foreseen
        room[n0] = entry
        n0 += in_left & in_top
        room[n1] = entry
        n1 += in_right & in_top
        room[n2] = entry
        n2 += in_left & in_bottom
        room[n3] = entry
        n3 += in_right & in_bottom
    return n0 - free, n1 - free - kept, n2 - free - 2 * kept, n3 - free - 3 * kept


@helper
def write(areas, row, left, top, right, bottom, decision, number):
    """Write down an area; right and bottom are then its borders, not its last pixels."""
    areas[row, 0], areas[row, 1], areas[row, 2], areas[row, 3] = left, top, right + 1, bottom + 1
    areas[row, 4], areas[row, 5] = decision, number


@helper
def look(
    room, begin, end, left, top, right, bottom, x, y, large, words, bound, own
):  # fmt: skip
    """Move the faces of room[begin:end] that an area keeps to the front; how many, and who surrounds.

    Through the list, nearest first: disjoint ones go; a surrounding face whose farthest depth is the nearest
    so far hides what its depths at the four corners say, and all that comes when it is nearer than the rest.
    """
    kept, s, before, far = 0, np.int64(-1), 0, np.float32(0)
    apart, contained, surrounding, hidden, compared, last = 0, 0, 0, 0, 0, end
    for i in range(begin, end):
        entry = room[i]
        r = entry & LOW32
        if s >= 0 and bound[r] < far:
            hidden, last = hidden + end - i, i
            break
        box = entry >> 32
        how = lies(
            words, r, (box & 127) - 1, ((box >> 7) & 127) - 1, ((box >> 14) & 127) - 1,
            ((box >> 21) & 127) - 1, left, top, right, bottom, x, y,
        )  # fmt: skip
        if how == DISJOINT:
            apart += 1
            continue
        contained += how == CONTAINED
        surrounding += how == SURROUNDING
        if s >= 0 and large:
            compared += 4
            if hides(words, s, r, x + left, y + top, x + right, y + bottom):
                hidden += 1
                continue
        room[begin + kept] = entry
        if how == SURROUNDING:
            reach = farthest(words, r, x + left, y + top, x + right, y + bottom)
            if s < 0 or reach > far:
                s, far, before = r, reach, kept
        kept += 1
    own[APART] += apart
    own[CONTAIN] += contained
    own[SURROUND] += surrounding
    own[INTERSECT] += last - begin - apart - contained - surrounding
    if s < 0 or not large:
        own[HIDDEN] += hidden
        return kept, s
    # Those before it in the list were not compared with it yet
    left_over = 0
    for i in range(begin, begin + kept):
        if i < begin + before:
            compared += 4
            r = room[i] & LOW32
            if hides(words, s, r, x + left, y + top, x + right, y + bottom):
                hidden += 1
                continue
        room[begin + left_over] = room[i]
        left_over += 1
    own[HIDDEN] += hidden
    own[COMPARED] += compared
    return left_over, s


@helper
def fill(room, begin, kept, s, left, top, right, bottom, x, y, words, keys, own):
    """Fill an area that is not cut: with nothing, one face, or the nearest at each pixel; what it was.

    keys: depth above the inverted face number; the greater is nearer, and of equal depths has the lower face.
    """
    if kept == 1 and s >= 0:
        a, b, c = plane_of(words, s)
        low_half = words[WORDS * s + 6] ^ LOW32
        for row in range(top, bottom + 1):
            for column in range(left, right + 1):
                z = depth_at(a, b, c, x + column, y + row)
                keys[row * TILE + column] = max(key_of(z, low_half), 0)
        return SURROUNDED, words[WORDS * s + 6]
    tests = 0
    for i in range(begin, begin + kept):
        r, box = room[i] & LOW32, room[i] >> 32
        first, top_row = max((box & 127) - 1, left), max(((box >> 7) & 127) - 1, top)
        last, bottom_row = min(((box >> 14) & 127) - 1, right), min(((box >> 21) & 127) - 1, bottom)
        p0, p1, p2 = words[WORDS * r], words[WORDS * r + 1], words[WORDS * r + 2]
        e0, a0, b0 = edge(p1, p2, x + first, y + top_row)
        e1, a1, b1 = edge(p2, p0, x + first, y + top_row)
        e2, a2, b2 = edge(p0, p1, x + first, y + top_row)
        a, b, c = plane_of(words, r)
        low_half = words[WORDS * r + 6] ^ LOW32
        for row in range(top_row, bottom_row + 1):
            f0, f1, f2 = e0, e1, e2
            for column in range(first, last + 1):
                inside = (f0 | f1 | f2) >= 0
                key = key_of(depth_at(a, b, c, x + column, y + row), low_half)
                at = row * TILE + column
                keys[at] = max(keys[at], key if inside else np.int64(0))
                tests += inside
                f0, f1, f2 = f0 + a0, f1 + a1, f2 + a2
            e0, e1, e2 = e0 + b0, e1 + b1, e2 + b2
    if kept > 1:
        own[COMPARED] += tests
        return SAMPLED, np.int64(-1)
    return (SINGLE_FACE, words[WORDS * (room[begin] & LOW32) + 6]) if kept else (EMPTY, np.int64(-1))


@helper
def key_of(depth, low_half):
    """A key; not above 0, which is nothing, where the depth is as far as the back."""
    return (np.int64(np.float32(depth).view(np.int32)) << 32) | low_half


@helper
def finish(keys, x, y, across, down, width, face, depth):
    """Split a tile's keys into faces and depths, and clear them; a key of depth 0 is nothing."""
    for row in range(down):
        for column in range(across):
            key = keys[row * TILE + column]
            bits, at = np.int32(key >> 32), (y + row) * width + x + column
            depth[at] = bits
            face[at] = ~np.int32(key) if bits != 0 else np.int32(-1)
            keys[row * TILE + column] = 0


@helper
def edge(p, q, x, y):
    """The edge function of an edge that leads clockwise at pixel (x, y), and its steps of a pixel."""
    px, py = np.int64(np.int32(p)), p >> 32
    a, b = py - (q >> 32), np.int64(np.int32(q)) - px
    e = a * (x * UNITS + CENTRE - px) + b * (y * UNITS + CENTRE - py) + edge_bias(a, b)
    return e, a * UNITS, b * UNITS
