"""Active edges: where a face's left and right edge cross a row, exactly.

A face enters with its edges' functions; each row then takes one multiplication an edge. Which two of the
three edges are active changes at the rows of the second and third corner.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.geometry.fixedpoint import BEFORE_CENTRE, CENTRE, UNITS, depth_at, depth_plane, edge_bias
from eyeline.jit import helper

WORDS = 12  # float64 of a face: its plane a b c, and three for each edge
TURNS = 4  # int32 of a face: the rows of its second and third corner, its last row, the row where it entered
LOW32 = 0xFFFFFFFF


class Room(NamedTuple):
    """Working memory of one part: M faces of a band, W columns, R rows of a band."""

    lines: FloatArray  # (WORDS * M,)
    turns: IntArray  # (TURNS * M,) int32
    number: IntArray  # (M,) int64, scene face << 32 | face: of equal depths the lower is seen
    first: IntArray  # (M,) int32, the columns of a face's segment on the row
    last: IntArray  # (M,) int32
    near: FloatArray  # (M,) float32, the greatest depth of the segment
    following: IntArray  # (M,) int32, another segment that begins at the same column; -1 is none
    active: IntArray  # (M,) int32, all slots: those of active faces first
    heap: IntArray  # (M,) int32, hidden segments, the greatest depth on top
    rivals: IntArray  # (M,) int32, segments to be compared with the one in front
    order: IntArray  # (M,) int32, faces by the row where they enter
    begins: IntArray  # (R + 1,) int32, where those of each row begin
    heads: IntArray  # (W,) int32, a segment that begins at the column; -1 is none, as between rows


def room_for(faces: int, width: int, rows: int) -> Room:
    """Memory for so many faces and columns, and rows of a band."""
    lists = (np.empty(faces, np.int32) for _ in range(6))
    first, last, following, heap, rivals, order = lists
    active = np.arange(faces, dtype=np.int32)
    return Room(
        np.empty(WORDS * faces), np.empty(TURNS * faces, np.int32), np.empty(faces, np.int64),
        first, last, np.empty(faces, np.float32), following, active, heap, rivals, order,
        np.empty(rows + 1, np.int32), np.full(width, -1, np.int32),
    )  # fmt: skip


@helper
def enter(slot, corners, z, last_row, y, lines, turns):
    """Set up a face at the row y where it enters, in a slot of the room.

    corners: packed y << 32 | x, three; z: their depths.
    """
    p0, p1, p2 = corners
    z0, z1, z2 = z
    x0, x1, x2 = np.int64(np.int32(p0)), np.int64(np.int32(p1)), np.int64(np.int32(p2))
    y0, y1, y2 = p0 >> 32, p1 >> 32, p2 >> 32
    # Clockwise; without branches, since which corner is on top is anybody's guess
    flip = (x1 - x0) * (y2 - y0) < (x2 - x0) * (y1 - y0)
    x1, x2 = (x2 if flip else x1), (x1 if flip else x2)
    y1, y2 = (y2 if flip else y1), (y1 if flip else y2)
    z1, z2 = (z2 if flip else z1), (z1 if flip else z2)
    at = WORDS * slot
    lines[at], lines[at + 1], lines[at + 2] = depth_plane(x0, y0, z0, x1, y1, z1, x2, y2, z2)
    # From the top on
    second, third = (y1 < y0) & (y1 <= y2), (y2 < y0) & (y2 < y1)
    x0, x1, x2 = turned(x0, x1, x2, second, third)
    y0, y1, y2 = turned(y0, y1, y2, second, third)
    lines[at + 3], lines[at + 4], lines[at + 5] = crossing(x0, y0, x1, y1, y)
    lines[at + 6], lines[at + 7], lines[at + 8] = crossing(x1, y1, x2, y2, y)
    lines[at + 9], lines[at + 10], lines[at + 11] = crossing(x2, y2, x0, y0, y)
    turns[TURNS * slot] = np.int32((y1 + BEFORE_CENTRE) >> 8)
    turns[TURNS * slot + 1] = np.int32((y2 + BEFORE_CENTRE) >> 8)
    turns[TURNS * slot + 2] = np.int32(last_row)
    turns[TURNS * slot + 3] = np.int32(y)


@helper
def turned(first, second, third, from_second, from_third):
    """Three numbers in their cycle, from the first on or from another."""
    return (
        second if from_second else (third if from_third else first),
        third if from_second else (first if from_third else second),
        first if from_second else (second if from_third else third),
    )


@helper
def crossing(x0, y0, x1, y1, y):
    """(e, step, inverse) of an edge that leads clockwise: at row y, r rows down, it is crossed at a column.

    floor((e + step r) inverse) is the last pixel inside a right edge; minus the first inside a left one. That
    is exact: e has half a unit more than the edge function, so that no quotient is whole, and within the
    picture none is rounded to the other side of a whole number.
    """
    a, b = y0 - y1, x1 - x0
    e = a * (CENTRE - x0) + b * (UNITS * y + CENTRE - y0) + edge_bias(a, b)
    # A level edge crosses no row
    return np.float64(e) + 0.5, np.float64(UNITS * b), 1.0 / np.float64(UNITS * max(abs(a), 1))


@helper
def cross(slot, y, width, lines, turns):
    """(first, last, near) of an active face on a row: its columns and its greatest depth.

    It has no pixels there if the first comes after the last.
    """
    # Unsigned, an index needs no look whether it counts from the end
    at, turn = np.uint32(WORDS * slot), np.uint32(TURNS * slot)
    right = np.uint32(at + (3 if y < turns[turn] else 6))
    left = np.uint32(at + (9 if y < turns[np.uint32(turn + 1)] else 6))
    r = np.float64(y - turns[np.uint32(turn + 3)])
    low = -np.floor((lines[left] + lines[np.uint32(left + 1)] * r) * lines[np.uint32(left + 2)])
    high = np.floor((lines[right] + lines[np.uint32(right + 1)] * r) * lines[np.uint32(right + 2)])
    first = np.int32(min(max(low, 0.0), np.float64(width)))
    last = np.int32(max(min(high, np.float64(width - 1)), -1.0))
    a, b, c = lines[at], lines[np.uint32(at + 1)], lines[np.uint32(at + 2)]
    # Rounded, a line still never turns back: its greatest depth is at one of its ends
    return first, last, max(depth_at(a, b, c, first, y), depth_at(a, b, c, last, y))
