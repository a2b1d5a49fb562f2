"""Faces become finished fragments and records, sorted into bands of rows: the depth buffer's first half.

Faces go through in chunks whose columns stay in the cache: what cannot be seen is dropped, the rest is set up
in vector instructions. A face within 4x4 pixels becomes its fragments at once; a larger one becomes a record,
drawn later.
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.fixedpoint import BEFORE_CENTRE, CENTRE, depth_at, depth_plane, edge_bias
from eyeline.jit import helper, kernel, trailing_zeros

BLOCK = 512  # a bin is a chain of blocks of so many entries
BAND_BITS = 5  # a band is 32 rows: its keys, 1920 wide, are 480 kB and stay in the second cache
CHUNK = 1024  # faces handled together
BAND_SHIFT = 16 + BAND_BITS  # (y << 16 | x) >> BAND_SHIFT is a pixel's band
WORDS = 8  # int64 of a record, a cache line: three corners y << 32 | x, the plane's a b c, a key's lower half
RECORD = -1  # in the place of a pixel: this entry of a bin is a record
LOW32 = 0xFFFFFFFF


@helper
def make_key(depth, low_half):
    """The greater key is nearer, and of equal depths has the lower face number. 0 is nothing."""
    return (np.int64(np.float32(depth).view(np.int32)) << 32) | low_half


@kernel
def bin_faces(part, parts, faces, xy, depth, sides, uncut, pieces, size, scratch, counts):
    """Bin chunks part, part + parts, ... of the faces; xy: packed y << 32 | x.

    uncut: how many faces are; pieces: which of them each of the other faces is cut from.
    counts: int64 of this part: blocks and records needed, faces turned away, faces beside pixels.
    """
    ends, previous = scratch.ends[part], scratch.previous[part]
    pixels, keys = scratch.pixels[part], scratch.keys[part]
    records = scratch.records[part]
    live, at = np.empty(CHUNK + 1, np.int32), np.empty(6 * CHUNK, np.int32)
    z, plane = np.empty(3 * CHUNK, np.float32), np.empty(3 * CHUNK, np.float64)
    cover, place = np.empty(CHUNK, np.int32), np.empty(CHUNK, np.int32)
    ends[:] = 0
    counts[:] = 0
    counts[0] = 1
    for chunk in range(part, (faces.shape[0] // 3 + CHUNK - 1) // CHUNK, parts):
        first = chunk * CHUNK
        end = min(first + CHUNK, faces.shape[0] // 3)
        own = faces[3 * first : 3 * end]
        m = keep(own, xy, sides if sides.shape[0] == 1 else sides[first:end], live, counts)
        gather(m, own, xy, depth, live, at, z)
        counts[3] += set_up(m, at, z, size[0], size[1], cover, place, plane)
        emit(
            m, first, live, at, cover, place, plane, uncut, pieces,
            ends, previous, pixels, keys, records, counts,
        )  # fmt: skip


@helper
def keep(faces, xy, sides, live, counts):
    """List in `live` the faces that show a side that counts and lie not wholly between pixel centres."""
    step = 0 if sides.shape[0] == 1 else 1
    m, wrong = 0, 0
    for t in range(faces.shape[0] // 3):
        p0, p1, p2 = (
            xy[np.uint32(faces[3 * t])],
            xy[np.uint32(faces[3 * t + 1])],
            xy[np.uint32(faces[3 * t + 2])],
        )
        x0, x1, x2 = np.int64(np.int32(p0)), np.int64(np.int32(p1)), np.int64(np.int32(p2))
        y0, y1, y2 = p0 >> 32, p1 >> 32, p2 >> 32
        left, right = (x1 - x0) * (y2 - y0), (x2 - x0) * (y1 - y0)
        side = np.int32(sides[t * step])
        shown = (((side & 1) != 0) & (left < right)) | (((side & 2) != 0) & (left > right))
        c0, c1, c2 = (x0 + BEFORE_CENTRE) >> 8, (x1 + BEFORE_CENTRE) >> 8, (x2 + BEFORE_CENTRE) >> 8
        r0, r1, r2 = (y0 + BEFORE_CENTRE) >> 8, (y1 + BEFORE_CENTRE) >> 8, (y2 + BEFORE_CENTRE) >> 8
        centred = (((c0 ^ c1) | (c0 ^ c2)) != 0) & (((r0 ^ r1) | (r0 ^ r2)) != 0)
        live[m] = t
        wrong += not shown
        m += shown & centred
    counts[2] += wrong
    counts[3] += faces.shape[0] // 3 - wrong - m
    return m


@helper
def gather(m, faces, xy, depth, live, at, z):
    """Collect the corners of the live faces in columns, clockwise."""
    for j in range(m):
        t = live[j]
        i0, i1, i2 = np.uint32(faces[3 * t]), np.uint32(faces[3 * t + 1]), np.uint32(faces[3 * t + 2])
        p0, p1, p2 = xy[i0], xy[i1], xy[i2]
        x0, x1, x2 = np.int64(np.int32(p0)), np.int64(np.int32(p1)), np.int64(np.int32(p2))
        flip = (x1 - x0) * ((p2 >> 32) - (p0 >> 32)) < (x2 - x0) * ((p1 >> 32) - (p0 >> 32))
        p1, p2 = (p2 if flip else p1), (p1 if flip else p2)
        i1, i2 = (i2 if flip else i1), (i1 if flip else i2)
        at[j], at[CHUNK + j] = np.int32(p0), np.int32(p0 >> 32)
        at[2 * CHUNK + j], at[3 * CHUNK + j] = np.int32(p1), np.int32(p1 >> 32)
        at[4 * CHUNK + j], at[5 * CHUNK + j] = np.int32(p2), np.int32(p2 >> 32)
        z[j], z[CHUNK + j], z[2 * CHUNK + j] = depth[i0], depth[i1], depth[i2]


@helper
def set_up(m, at, z, width, height, cover, place, plane):
    """For every live face its first pixel, its depth plane, and its cover; how many lie beside all pixels.

    cover: which of 4x4 pixels, a bit each; minus the number of rows for a face that is larger. int32 is exact
    for faces within 4x4 pixels; for larger ones it overflows, and the bits are not used.
    """
    one, eight, beside = np.int32(1), np.int32(8), 0
    for j in range(m):
        x0, y0, x1 = at[j], at[CHUNK + j], at[2 * CHUNK + j]
        y1, x2, y2 = at[3 * CHUNK + j], at[4 * CHUNK + j], at[5 * CHUNK + j]
        left = np.int32(np.int32(min(x0, x1, x2) + np.int32(BEFORE_CENTRE)) >> eight)
        right = np.int32((np.int32(max(x0, x1, x2) + np.int32(BEFORE_CENTRE)) >> eight) - one)
        top = np.int32(np.int32(min(y0, y1, y2) + np.int32(BEFORE_CENTRE)) >> eight)
        bottom = np.int32((np.int32(max(y0, y1, y2) + np.int32(BEFORE_CENTRE)) >> eight) - one)
        small = (np.int32(right - left) < 4) & (np.int32(bottom - top) < 4)
        left, top = max(left, np.int32(0)), max(top, np.int32(0))
        w = np.int32(min(right, np.int32(width - 1)) - left)
        h = np.int32(min(bottom, np.int32(height - 1)) - top)
        cx = np.int32(np.int32(left * np.int32(256)) + np.int32(CENTRE))
        cy = np.int32(np.int32(top * np.int32(256)) + np.int32(CENTRE))
        a0, a1, a2 = np.int32(y1 - y2), np.int32(y2 - y0), np.int32(y0 - y1)
        b0, b1, b2 = np.int32(x2 - x1), np.int32(x0 - x2), np.int32(x1 - x0)
        e0 = edge32(a0, b0, np.int32(cx - x1), np.int32(cy - y1))
        e1 = edge32(a1, b1, np.int32(cx - x2), np.int32(cy - y2))
        e2 = edge32(a2, b2, np.int32(cx - x0), np.int32(cy - y0))
        # From here on steps of one pixel; the compiler unrolls both loops
        a0, a1, a2 = np.int32(a0 << eight), np.int32(a1 << eight), np.int32(a2 << eight)
        b0, b1, b2 = np.int32(b0 << eight), np.int32(b1 << eight), np.int32(b2 << eight)
        bits = np.int32(0)
        for r in range(4):
            f0, f1, f2 = e0, e1, e2
            for s in range(4):
                bits |= np.int32(
                    np.int32(np.int32(~(f0 | f1 | f2)) >> np.int32(31)) & np.int32(1 << (4 * r + s))
                )
                f0, f1, f2 = np.int32(f0 + a0), np.int32(f1 + a1), np.int32(f2 + a2)
            e0, e1, e2 = np.int32(e0 + b0), np.int32(e1 + b1), np.int32(e2 + b2)
        columns = np.int32(np.int32(0x1111) * np.int32(15 >> (3 - min(w, np.int32(3)))))
        bits &= columns & np.int32(0xFFFF >> (12 - 4 * min(h, np.int32(3))))
        within = (w >= 0) & (h >= 0)
        beside += not within
        cover[j] = (bits if small else np.int32(-1 - h)) if within else np.int32(0)
        place[j] = np.int32(top << np.int32(16)) | left
        plane[j], plane[CHUNK + j], plane[2 * CHUNK + j] = depth_plane(
            x0, y0, z[j], x1, y1, z[CHUNK + j], x2, y2, z[2 * CHUNK + j]
        )
    return beside


@helper
def edge32(a, b, dx, dy):
    """An edge function in int32, with its bias."""
    return np.int32(np.int32(np.int32(a * dx) + np.int32(b * dy)) + edge_bias(a, b))


@helper
def emit(
    m,
    first,
    live,
    at,
    cover,
    place,
    plane,
    uncut,
    pieces,
    ends,
    previous,
    pixels,
    keys,
    records,
    counts,
):
    """Put small faces' fragments into the bins; of a larger one a record, and an entry for each band."""
    blocks, taken = counts[0], counts[1]
    for j in range(m):
        t = first + live[j]
        low_half = np.int64(t if t < uncut else pieces[t - uncut]) ^ LOW32
        bits = cover[j]
        if bits >= 0:
            while bits != 0:
                bit = trailing_zeros(bits)
                bits = np.int32(bits & np.int32(bits - np.int32(1)))
                p = np.int32(place[j] + np.int32(np.int32(bit & 3) + np.int32(np.int32(bit >> 2) << 16)))
                depth = depth_at(
                    plane[j], plane[CHUNK + j], plane[2 * CHUNK + j], np.int32(p & 65535), p >> 16
                )
                blocks = put(
                    p >> BAND_SHIFT, p, make_key(depth, low_half), ends, previous, pixels, keys, blocks
                )
        else:
            record = taken if WORDS * (taken + 1) <= records.shape[0] else 0
            for band in range(place[j] >> BAND_SHIFT, (((place[j] >> 16) - 1 - bits) >> BAND_BITS) + 1):
                blocks = put(band, np.int32(RECORD), np.int64(record), ends, previous, pixels, keys, blocks)
            words = records[WORDS * record : WORDS * (record + 1)]
            for k in range(3):
                words[k] = (np.int64(at[(2 * k + 1) * CHUNK + j]) << 32) | (
                    np.int64(at[2 * k * CHUNK + j]) & LOW32
                )
                words[3 + k] = np.float64(plane[k * CHUNK + j]).view(np.int64)
            words[6] = low_half
            taken += 1
    counts[0], counts[1] = blocks, taken


@helper
def put(band, pixel, key, ends, previous, pixels, keys, blocks):
    """Add an entry to a band's bin; the number of blocks in use.

    Without room for a new block, entries go to block 0, which nobody reads.
    """
    at = ends[band]
    if at & (BLOCK - 1) == 0:
        block = blocks if blocks < previous.shape[0] else 0
        previous[block] = at
        at = block * BLOCK
        blocks += 1
    pixels[at], keys[at] = pixel, key
    ends[band] = at + 1
    return blocks
