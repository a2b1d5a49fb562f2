"""PNG, written by all threads at once. [ISO 15948]

Bands of rows are deflated side by side and joined, which the format allows. 1280x720 takes 14 ms of processor
time and 390 kB, against Pillow's 52 ms and 500 kB, and Pillow need not be loaded.
"""

from __future__ import annotations

import struct
import zlib

import numpy as np

from eyeline.geometry.arrays import ByteArray
from eyeline.jit import share, threads

SIGNATURE = b"\x89PNG\r\n\x1a\n"
COLOUR_TYPES = {3: 2, 4: 6}  # channels -> the format's number
LEFT = 1  # the filter that keeps differences from the left neighbour: gradients become runs
DEFLATE = b"\x78\x01"  # the header of a zlib stream at its fastest level
BAND_BYTES = 1 << 18  # never by the count of threads, so that the file is the same on every machine


def png_of(pixels: ByteArray) -> bytes:
    """The file of a picture (H, W, 3) or (H, W, 4), sRGB, straight alpha."""
    height, width, channels = pixels.shape
    rows = np.empty((height, 1 + width * channels), np.uint8)
    rows[:, 0] = LEFT
    plain = pixels.reshape(height, width * channels)
    rows[:, 1 : 1 + channels] = plain[:, :channels]
    np.subtract(plain[:, channels:], plain[:, :-channels], out=rows[:, 1 + channels :])
    header = struct.pack(">IIBBBBB", width, height, 8, COLOUR_TYPES[channels], 0, 0, 0)
    stream = DEFLATE + b"".join(bands(rows)) + struct.pack(">I", zlib.adler32(rows.data))
    return SIGNATURE + chunk(b"IHDR", header) + chunk(b"IDAT", stream) + chunk(b"IEND", b"")


def bands(rows: ByteArray) -> list[bytes]:
    """The deflated bands of rows, in order; the last one ends the stream."""
    step = max(1, BAND_BYTES // rows.shape[1])
    tops = range(0, len(rows), step)
    parts = min(threads(), len(tops))

    def deflated(part: int) -> list[bytes]:
        done = []
        for top in tops[part::parts]:
            packer = zlib.compressobj(1, wbits=-15)
            is_last = top == tops[-1]
            packed = packer.compress(rows[top : top + step].data)
            done.append(packed + packer.flush(zlib.Z_FINISH if is_last else zlib.Z_FULL_FLUSH))
        return done

    done = share(deflated, parts)
    return [done[index % parts][index // parts] for index in range(len(tops))]


def chunk(kind: bytes, data: bytes) -> bytes:
    """A chunk of the file: length, kind, data, check sum."""
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(data, zlib.crc32(kind)))
