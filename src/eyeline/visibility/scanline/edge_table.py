"""The edge table: which faces come in at which row, sorted into bands of rows.

Watkins keeps edges in pairs, a face's left one and right one on the row: a face is their entry. It is entered
in every band that it reaches, so that bands can be scanned by themselves.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from eyeline.geometry.arrays import IntArray, read_only
from eyeline.geometry.fixedpoint import BEFORE_CENTRE
from eyeline.jit import kernel, share, threads
from eyeline.projection.projected import Projected

MOST_BANDS = 64  # of a picture: what a face that reaches over all of it takes is bounded
LEAST_SHIFT = 4  # a band is at least 16 rows
ROW_BITS = 14  # first row << ROW_BITS | last row
LAST_ROW = (1 << ROW_BITS) - 1
NONE = -1  # in the place of rows: the face has none


class EdgeTable(NamedTuple):
    """Faces by band, those of a band by number: B bands of 1 << shift rows, N entries."""

    rows: IntArray  # (F,) int32: first row << ROW_BITS | last row of a face, clipped to the picture, or NONE
    starts: IntArray  # (B + 1,) int64, where the entries of each band begin
    entries: IntArray  # (N,) int32, faces
    shift: int
    turned: int  # faces turned away
    beside: int  # faces beside all pixels
    edges: int  # that cross the centres of a row


def edge_table(projected: Projected) -> EdgeTable:
    """All faces of a picture that may cover a pixel, where their edges come in."""
    shift = LEAST_SHIFT
    while (projected.height - 1) >> shift >= MOST_BANDS:
        shift += 1
    faces, sides = read_only(projected.faces).reshape(-1), read_only(projected.sides)
    corners, size = read_only(projected.xy.view(np.int64)).reshape(-1), (projected.width, projected.height)
    parts, bands = threads(), ((projected.height - 1) >> shift) + 1
    rows = np.empty(len(projected.faces), dtype=np.int32)
    counts = np.zeros((parts, 3 + bands), dtype=np.int64)
    share(lambda part: find_rows(part, parts, faces, corners, sides, size, shift, rows, counts[part]), parts)
    # Within a band first the entries of part 0, then of part 1: in the faces' order for any number of parts
    ends = np.cumsum(counts[:, 3:].T).reshape(bands, parts)
    places = np.ascontiguousarray((ends - counts[:, 3:].T).T)
    entries = np.empty(int(ends[-1, -1]), dtype=np.int32)
    share(lambda part: enter_faces(part, parts, rows, shift, places[part], entries), parts)
    starts = np.concatenate([[0], ends[:, -1]])
    turned, beside, edges = (int(count) for count in counts[:, :3].sum(axis=0))
    return EdgeTable(rows, starts, entries, shift, turned, beside, edges)


@kernel
def find_rows(part, parts, faces, xy, sides, size, shift, rows, counts):
    """The rows of faces of this part; xy: packed y << 32 | x.

    counts: int64, faces turned away, faces beside pixels, edges, then the entries of every band.
    """
    width, height = size
    step = 0 if sides.shape[0] == 1 else 1
    for f in range(rows.shape[0] * part // parts, rows.shape[0] * (part + 1) // parts):
        p0, p1 = xy[np.uint32(faces[3 * f])], xy[np.uint32(faces[3 * f + 1])]
        p2 = xy[np.uint32(faces[3 * f + 2])]
        x0, x1, x2 = np.int64(np.int32(p0)), np.int64(np.int32(p1)), np.int64(np.int32(p2))
        y0, y1, y2 = p0 >> 32, p1 >> 32, p2 >> 32
        left, right = (x1 - x0) * (y2 - y0), (x2 - x0) * (y1 - y0)
        side = sides[f * step]
        shown = (((side & 1) != 0) & (left < right)) | (((side & 2) != 0) & (left > right))
        r0 = min(max((y0 + BEFORE_CENTRE) >> 8, 0), height)
        r1 = min(max((y1 + BEFORE_CENTRE) >> 8, 0), height)
        r2 = min(max((y2 + BEFORE_CENTRE) >> 8, 0), height)
        top, bottom = min(r0, r1, r2), max(r0, r1, r2) - 1
        first = max((min(x0, x1, x2) + BEFORE_CENTRE) >> 8, 0)
        last = min(((max(x0, x1, x2) + BEFORE_CENTRE) >> 8) - 1, width - 1)
        within = (top <= bottom) & (first <= last)
        rows[f] = (top << ROW_BITS | bottom) if shown & within else NONE
        if not shown:
            counts[0] += 1
        elif not within:
            counts[1] += 1
        else:
            counts[2] += np.int64(r0 != r1) + np.int64(r1 != r2) + np.int64(r2 != r0)
            for band in range(top >> shift, (bottom >> shift) + 1):
                counts[3 + band] += 1


@kernel
def enter_faces(part, parts, rows, shift, places, entries):
    """Write faces of this part at the next place of every band that they reach."""
    for f in range(rows.shape[0] * part // parts, rows.shape[0] * (part + 1) // parts):
        if rows[f] != NONE:
            for band in range(rows[f] >> ROW_BITS >> shift, ((rows[f] & LAST_ROW) >> shift) + 1):
                entries[places[band]] = f
                places[band] += 1
