"""Animated WebP: a moving picture, with transparency, in an <img>.

Pillow compresses each frame; the container around them is written here, frame by frame, because Pillow
would hold all frames until the end. [WebP Container Specification, "Animation" and "Extended File Format"]
"""

from __future__ import annotations

import io
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import BinaryIO

import numpy as np

from eyeline.errors import OptionError
from eyeline.files.whole import refuse_place, whole_file
from eyeline.geometry.arrays import ByteArray
from eyeline.render.encoders.encoder import Job

HAS_ALPHA, IS_ANIMATED = 0x10, 0x02  # flags of the file
REPLACE = 0x02  # flag of a frame: it replaces what it covers, alpha too
LONGEST_SIDE = 16383  # pixels
TICKS = 1000  # the container counts milliseconds


@dataclass(frozen=True)
class WebP:
    """Every frame holds only the rectangle that changed."""

    name: str = ".webp"
    resumes: bool = False
    quality: int = 85  # 0 to 100
    effort: int = 2  # 0 to 6: 2 takes 0.4 of the time of 4, the default, for a tenth more bytes

    @contextmanager
    def __call__(self, path: Path, job: Job, resume: bool = False) -> Iterator[WebPSink]:
        """Encode into a file beside `path` that takes its name when complete."""
        if max(job.size) > LONGEST_SIDE:
            raise OptionError(f"{path}: {max(job.size)} pixels a side; WebP holds {LONGEST_SIDE} at most")
        with whole_file(path) as unfinished, unfinished.open("wb") as file:
            sink = WebPSink(file, job, self)
            yield sink
            sink.finish()

    def check(self, path: Path) -> None:
        """A file needs a folder to be in."""
        refuse_place(path)

    def notes(self, job: Job) -> tuple[str, ...]:
        """Frames are kept as they are."""
        return ()


WEBP = WebP()


class WebPSink:
    """Frames on their way into a file."""

    def __init__(self, file: BinaryIO, job: Job, encoder: WebP) -> None:
        self.wanted = range(job.frames)
        self._file, self._fps, self._encoder = file, Fraction(job.fps), encoder
        self._shown: ByteArray | None = None  # the frame before
        width, height = job.size
        extended = struct.pack("<I", HAS_ALPHA | IS_ANIMATED) + three(width - 1) + three(height - 1)
        endless = struct.pack("<IH", 0, 0)  # background, loops
        file.write(b"RIFF\0\0\0\0WEBP" + chunk(b"VP8X", extended) + chunk(b"ANIM", endless))

    def write(self, number: int, pixels: ByteArray) -> None:
        """Encode one frame; times are rounded one by one, so that a long film keeps its speed."""
        left, top, right, bottom = changed_part(self._shown, pixels)
        self._shown = pixels
        begin, end = (round(one * TICKS / self._fps) for one in (number, number + 1))
        head = b"".join(
            three(value)
            for value in (left // 2, top // 2, right - left - 1, bottom - top - 1, max(1, end - begin))
        )
        picture = self._compressed(pixels[top:bottom, left:right])
        self._file.write(chunk(b"ANMF", head + bytes([REPLACE]) + picture))

    def finish(self) -> None:
        """Put the length where it belongs."""
        length = self._file.tell()
        self._file.seek(4)
        self._file.write(struct.pack("<I", length - 8))

    def _compressed(self, pixels: ByteArray) -> bytes:
        """The chunks of a still picture that hold its pixels."""
        import PIL.Image

        still = io.BytesIO()
        picture = PIL.Image.fromarray(np.ascontiguousarray(pixels))
        picture.save(still, "WEBP", quality=self._encoder.quality, method=self._encoder.effort, exact=False)
        return b"".join(
            chunk(name, content)
            for name, content in chunks(still.getvalue())
            if name in (b"ALPH", b"VP8 ", b"VP8L")
        )


def changed_part(before: ByteArray | None, now: ByteArray) -> tuple[int, int, int, int]:
    """(left, top, right, bottom) of what differs, at least a pixel; left and top are even, as WebP wants."""
    height, width = now.shape[:2]
    if before is None:
        return 0, 0, width, height
    differs = (before != now).any(axis=2)
    rows, columns = np.flatnonzero(differs.any(axis=1)), np.flatnonzero(differs.any(axis=0))
    if len(rows) == 0:
        return 0, 0, 1, 1
    return int(columns[0]) & ~1, int(rows[0]) & ~1, int(columns[-1]) + 1, int(rows[-1]) + 1


def three(number: int) -> bytes:
    """24 bits, little-endian."""
    return number.to_bytes(3, "little")


def chunk(name: bytes, content: bytes) -> bytes:
    """A named piece of a RIFF file; pieces begin at even places."""
    return name + struct.pack("<I", len(content)) + content + b"\0" * (len(content) % 2)


def chunks(file: bytes) -> Iterator[tuple[bytes, bytes]]:
    """The named pieces of a RIFF file."""
    place = 12
    while place + 8 <= len(file):
        (length,) = struct.unpack_from("<I", file, place + 4)
        yield file[place : place + 4], file[place + 8 : place + 8 + length]
        place += 8 + length + length % 2
