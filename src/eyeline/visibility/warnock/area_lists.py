"""What Warnock's areas begin with: the faces that may be seen, nearest first, listed for every tile.

A tile is an area of the picture that quartering a great square would reach; its list holds the faces whose
boxes of pixels reach it, but those that a face which surrounds it surely hides.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from eyeline.errors import OptionError
from eyeline.geometry.arrays import FloatArray, IntArray, read_only
from eyeline.geometry.fixedpoint import BEFORE_CENTRE, CENTRE, UNITS, depth_plane, signed_area
from eyeline.jit import helper, in_parts, kernel, share, threads
from eyeline.projection.projected import Projected
from eyeline.visibility.warnock.relations import (
    DISJOINT,
    SURROUNDING,
    WORDS,
    farthest,
    height_at,
    hides,
    lies,
    relation,
    slack_of,
)

TILE_BITS = 6
TILE = 1 << TILE_BITS  # pixels
LAST = (
    4  # faces of a list, with which the next may coincide: a mesh that is there twice has them side by side
)
STEPS = 65535  # of depth, to sort by
MOST_ENTRIES = 1 << 26  # of all lists: half a gigabyte
LOW32 = 0xFFFFFFFF
# Columns of the counters of a tile
AREAS, CUT, SURROUND, INTERSECT, CONTAIN, APART, HIDDEN, COMPARED = range(8)


class Records(NamedTuple):
    """The faces that may be seen, R of them, in order of their numbers."""

    words: IntArray  # (8 R,) int64: three corners y << 32 | x that turn clockwise, a b c of the plane, face
    boxes: IntArray  # (R,) int64: left, top, right, bottom pixel, 16 bits each, the least first
    near: FloatArray  # (R,) float32 no depth of the face is greater
    turned_away: int  # faces that are not here because they show no side that counts
    beside: int  # faces that are not here because their boxes hold no pixel, or one that they do not cover


class Lists(NamedTuple):
    """The faces of every tile, nearest first; an entry is a box in the tile above the number of a record."""

    records: Records
    order: IntArray  # int32: records that coincide with none before them, nearest first in STEPS of depth
    bound: FloatArray  # (R,) float32: no depth of a record, or of one that comes after it, is greater
    starts: IntArray  # (T + 1,) where the entries of each tile begin
    entries: IntArray  # int64
    counts: IntArray  # (T, 8) int64: what was counted for each tile so far


def records_of(projected: Projected) -> Records:
    """The faces that show a side that counts, and have a pixel in their box."""
    parts, count = threads(), len(projected.faces)
    faces, sides = read_only(projected.faces).reshape(-1), read_only(projected.sides)
    xy, depth = read_only(projected.xy.view(np.int64)).reshape(-1), read_only(projected.depth)
    uncut, pieces = projected.face_count, read_only(projected.piece_source)
    live, counts = np.empty(count, np.int32), np.zeros((parts, 3), np.int64)
    share(
        lambda part: _keep(
            part, parts, faces, xy, sides, projected.width, projected.height, live, counts[part]
        ),
        parts,
    )
    begins = [count * part // parts for part in range(parts)]
    kept = read_only(
        np.concatenate([live[a : a + int(n)] for a, n in zip(begins, counts[:, 0], strict=True)])
    )
    size = len(kept)
    made = Records(
        cache_lines(size), np.empty(size, np.int64), np.empty(size, np.float32),
        int(counts[:, 1].sum()), int(counts[:, 2].sum()),
    )  # fmt: skip
    share(
        lambda part: _set_up(
            part, parts, kept, faces, xy, depth, uncut, pieces, projected.width, projected.height, *made[:3]
        ),
        parts,
    )
    return made


def cache_lines(count: int) -> IntArray:
    """(8 count,) int64 that begin at a cache line, so that every record is one."""
    memory = np.empty(WORDS * (count + 1), np.int64)
    first = -memory.ctypes.data // memory.itemsize % WORDS
    return memory[first : first + WORDS * count]


def lists_of(projected: Projected, records: Records) -> Lists:
    """Every tile's faces; refused are more entries than MOST_ENTRIES."""
    order = distinct(records, nearest_first(records.near))
    width, height, parts = projected.width, projected.height, threads()
    boxes, near = np.empty(len(order), np.int64), np.empty(len(order), np.float32)
    in_parts(parts, _gather, order, read_only(records.boxes), read_only(records.near), boxes, near)
    # As the list is sorted in steps only: the greatest depth of what comes after counts too
    sorted_bound = np.maximum.accumulate(near[::-1])[::-1].copy()
    bound = np.empty_like(records.near)
    in_parts(parts, _scatter, order, sorted_bound, bound)
    tiles = (((width - 1) >> TILE_BITS) + 1) * (((height - 1) >> TILE_BITS) + 1)
    counts, starts = np.zeros((tiles, 8), np.int64), np.zeros(tiles + 1, np.int64)
    given = (
        read_only(order), read_only(boxes), read_only(sorted_bound),
        read_only(records.words), width, height,
    )  # fmt: skip

    def list_all(entries: IntArray, ends: IntArray) -> None:
        share(lambda part: _list(part, parts, *given, entries, ends, counts), parts)

    list_all(np.empty(0, np.int64), starts[1:])
    np.cumsum(starts, out=starts)
    if starts[-1] > MOST_ENTRIES:
        raise OptionError(
            f"warnock would list {starts[-1]:,} faces in {tiles} areas, of which none hides the others; "
            f"it lists at most {MOST_ENTRIES:,}: use method 'zbuffer', or a smaller picture"
        )
    entries = np.empty(int(starts[-1]) + 1, np.int64)  # one more: with none, the second pass would count only
    list_all(entries, starts[:-1].copy())
    return Lists(records, order, bound, starts, entries, counts)


def distinct(records: Records, order: IntArray) -> IntArray:
    """`order` without what coincides with one of the LAST faces before it, if that has the lower number."""
    again = np.empty(len(order), np.bool_)
    given = read_only(order), read_only(records.boxes), read_only(records.words), again
    return order[~again] if any(in_parts(threads(), _find_again, *given)) else order


def nearest_first(near: FloatArray) -> IntArray:
    """Records by nearest depth, in equal steps of what the picture can show, each step in order of number."""
    shown = np.clip(near, 0, 1)
    least, most = shown.min(initial=1), shown.max(initial=0)
    step = max(float(most - least), 2.0**-60) / STEPS
    return np.argsort(((most - shown) / step).astype(np.uint16), kind="stable").astype(np.int32)


@kernel
def _find_again(part, parts, order, boxes, words, again):
    """Fill again: whether a face coincides with one of the LAST before it; how many do in this part."""
    count, total = 0, order.shape[0]
    for i in range(total * part // parts, total * (part + 1) // parts):
        r = np.int64(order[i])
        box, coincides = boxes[r], False
        for k in range(max(i - LAST, 0), i):
            q = np.int64(order[k])
            if boxes[q] == box and words[WORDS * q + 6] <= words[WORDS * r + 6]:
                alike = True
                for word in range(6):
                    alike &= words[WORDS * q + word] == words[WORDS * r + word]
                coincides |= alike
        again[i] = coincides
        count += coincides
    return count


@kernel
def _gather(part, parts, order, boxes, near, sorted_boxes, sorted_near):
    """Boxes and nearest depths in the order of the list."""
    total = order.shape[0]
    for i in range(total * part // parts, total * (part + 1) // parts):
        sorted_boxes[i], sorted_near[i] = boxes[order[i]], near[order[i]]


@kernel
def _scatter(part, parts, order, sorted_bound, bound):
    """Bounds by number of the record."""
    total = order.shape[0]
    for i in range(total * part // parts, total * (part + 1) // parts):
        bound[order[i]] = sorted_bound[i]


@kernel
def _keep(part, parts, faces, xy, sides, width, height, live, counts):
    """List in `live`, from this part's first face on, those that may be seen; counts: kept, away, beside."""
    total = faces.shape[0] // 3
    first, end = total * part // parts, total * (part + 1) // parts
    step = 0 if sides.shape[0] == 1 else 1
    m, away = first, 0
    for t in range(first, end):
        p0, p1, p2 = xy[faces[3 * t]], xy[faces[3 * t + 1]], xy[faces[3 * t + 2]]
        x0, x1, x2 = np.int64(np.int32(p0)), np.int64(np.int32(p1)), np.int64(np.int32(p2))
        y0, y1, y2 = p0 >> 32, p1 >> 32, p2 >> 32
        area = signed_area(x0, y0, x1, y1, x2, y2)
        side = sides[t * step]
        if not (((side & 1) != 0) & (area < 0)) | (((side & 2) != 0) & (area > 0)):
            away += 1
            continue
        left, right = max((min(x0, x1, x2) + BEFORE_CENTRE) >> 8, 0), (max(x0, x1, x2) + BEFORE_CENTRE) >> 8
        top, bottom = max((min(y0, y1, y2) + BEFORE_CENTRE) >> 8, 0), (max(y0, y1, y2) + BEFORE_CENTRE) >> 8
        w, h = min(right, width) - left, min(bottom, height) - top
        if (w <= 0) | (h <= 0):
            continue
        if (w == 1) & (h == 1):
            p1, p2 = (p1 if area > 0 else p2), (p2 if area > 0 else p1)
            if relation(p0, p1, p2, left * UNITS + CENTRE, top * UNITS + CENTRE, 0, 0) == DISJOINT:
                continue
        live[m] = t
        m += 1
    counts[0], counts[1], counts[2] = m - first, away, end - first - away - (m - first)


@kernel
def _set_up(part, parts, live, faces, xy, depth, uncut, pieces, width, height, words, boxes, near):
    """Fill the records of the faces `live`."""
    total = live.shape[0]
    for r in range(total * part // parts, total * (part + 1) // parts):
        t = np.int64(live[r])
        i0, i1, i2 = faces[3 * t], faces[3 * t + 1], faces[3 * t + 2]
        p0, p1, p2 = xy[i0], xy[i1], xy[i2]
        x0, x1, x2 = np.int64(np.int32(p0)), np.int64(np.int32(p1)), np.int64(np.int32(p2))
        if signed_area(x0, p0 >> 32, x1, p1 >> 32, x2, p2 >> 32) < 0:
            i1, i2, p1, p2, x1, x2 = i2, i1, p2, p1, x2, x1
        y0, y1, y2 = p0 >> 32, p1 >> 32, p2 >> 32
        a, b, c = depth_plane(x0, y0, depth[i0], x1, y1, depth[i1], x2, y2, depth[i2])
        at = WORDS * r
        words[at], words[at + 1], words[at + 2] = p0, p1, p2
        words[at + 3], words[at + 4] = np.float64(a).view(np.int64), np.float64(b).view(np.int64)
        words[at + 5], words[at + 6] = np.float64(c).view(np.int64), t if t < uncut else pieces[t - uncut]
        left, top = (min(x0, x1, x2) + BEFORE_CENTRE) >> 8, (min(y0, y1, y2) + BEFORE_CENTRE) >> 8
        right = min(((max(x0, x1, x2) + BEFORE_CENTRE) >> 8), width) - 1
        bottom = min(((max(y0, y1, y2) + BEFORE_CENTRE) >> 8), height) - 1
        boxes[r] = max(left, 0) | (max(top, 0) << 16) | (right << 32) | (bottom << 48)
        # The plane as it was rounded, at the corners: it is no higher between them
        most = max(at_corner(a, b, c, x0, y0), at_corner(a, b, c, x1, y1), at_corner(a, b, c, x2, y2))
        near[r] = np.float32(most + slack_of(a, b, c))


@helper
def at_corner(a, b, c, x, y):
    """The height of a plane at a snapped corner."""
    return height_at(a, b, c, np.float64(x - CENTRE) / UNITS, np.float64(y - CENTRE) / UNITS)


@kernel
def _list(part, parts, order, boxes, bound, words, width, height, entries, ends, counts):
    """List the faces of tiles in rows part, part + parts, ...; without room, count them in `ends` only.

    boxes, bound: of the records in their order, not of the records by number.
    A face is left out of a tile where the surrounding face that is so far the nearest surely hides it.
    """
    columns, rows = ((width - 1) >> TILE_BITS) + 1, ((height - 1) >> TILE_BITS) + 1
    fills = entries.shape[0] > 0
    found, far = np.full(columns * rows, -1, np.int32), np.empty(columns * rows, np.float32)
    own = np.arange(rows) % parts == part  # its rows of tiles: asked of a table, for a division takes long
    for i in range(order.shape[0]):
        box = boxes[i]
        left, top, right, bottom = box & 65535, (box >> 16) & 65535, (box >> 32) & 65535, box >> 48
        r = np.int64(order[i])
        for row in range(top >> TILE_BITS, (bottom >> TILE_BITS) + 1):
            if not own[row]:
                continue
            for column in range(left >> TILE_BITS, (right >> TILE_BITS) + 1):
                tile, x, y = row * columns + column, column << TILE_BITS, row << TILE_BITS
                s = np.int64(found[tile])
                w, h = min(TILE, width - x) - 1, min(TILE, height - y) - 1
                first_x, first_y = max(left - x, -1), max(top - y, -1)
                last_x, last_y = min(right - x, TILE), min(bottom - y, TILE)
                hidden, compared = s >= 0 and bound[i] < far[tile], 0
                if not hidden:
                    how = lies(words, r, first_x, first_y, last_x, last_y, 0, 0, w, h, x, y)
                    if how == DISJOINT:
                        counts[tile, APART] += fills
                        continue
                    if s >= 0:
                        hidden, compared = hides(words, s, r, x, y, x + w, y + h), 4
                    if how == SURROUNDING and not hidden:
                        reach = farthest(words, r, x, y, x + w, y + h)
                        if s < 0 or reach > far[tile]:
                            found[tile], far[tile] = r, reach
                if hidden:
                    counts[tile, HIDDEN] += fills
                    counts[tile, COMPARED] += compared * fills
                    continue
                if fills:
                    packed = (
                        (first_x + 1) | ((first_y + 1) << 7) | ((last_x + 1) << 14) | ((last_y + 1) << 21)
                    )
                    entries[ends[tile]] = (packed << 32) | r
                ends[tile] += 1
