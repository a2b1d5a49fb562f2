"""Compressed video through FFmpeg's libraries."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from eyeline.files.whole import refuse_place, whole_file
from eyeline.geometry.arrays import ByteArray
from eyeline.render.encoders.encoder import Job
from eyeline.render.image import Image

if TYPE_CHECKING:
    from av.container import OutputContainer

BT709, STUDIO_RANGE = 1, 1  # ITU-T H.273's numbers: primaries, transfer and matrix of HDTV; luma 16 to 235
FINEST_RATE = 1001  # the greatest denominator of a frame rate: NTSC's 24000/1001


@dataclass(frozen=True)
class Video:
    """A container with one stream of pictures."""

    name: str  # suffix
    container: str
    codec: str
    pixel_format: str
    options: Mapping[str, str] = field(default_factory=dict)  # of the codec
    container_options: Mapping[str, str] = field(default_factory=dict)
    even: bool = True  # colours are kept for 2x2 pixels, so both sides must be even
    resumes: bool = False

    @contextmanager
    def __call__(self, path: Path, job: Job, resume: bool = False) -> Iterator[VideoSink]:
        """Encode into a file beside `path` that takes its name when complete."""
        import av

        with (
            whole_file(path) as unfinished,
            av.open(
                str(unfinished), "w", format=self.container, options=dict(self.container_options)
            ) as container,
        ):
            sink = VideoSink(self, container, job)
            yield sink
            sink.flush()

    def check(self, path: Path) -> None:
        """A file needs a folder to be in."""
        refuse_place(path)

    def notes(self, job: Job) -> tuple[str, ...]:
        """Odd sides grow."""
        padded = self.padded(job.size)
        if padded == job.size:
            return ()
        shown = [f"{width}x{height}" for width, height in (job.size, padded)]
        return (
            f"{shown[0]} becomes {shown[1]}: {self.name} needs even sides; the last row or column repeats",
        )

    def padded(self, size: tuple[int, int]) -> tuple[int, int]:
        """The size of the frames in the file."""
        return (size[0] + size[0] % 2, size[1] + size[1] % 2) if self.even else size


class VideoSink:
    """Frames on their way into a container."""

    def __init__(self, video: Video, container: OutputContainer, job: Job) -> None:
        rate = Fraction(job.fps).limit_denominator(FINEST_RATE)
        stream: Any = container.add_stream(video.codec, rate=rate, options=dict(video.options))
        stream.width, stream.height = video.padded(job.size)
        stream.pix_fmt = video.pixel_format
        context = stream.codec_context
        context.color_primaries = context.color_trc = context.colorspace = BT709
        context.color_range = STUDIO_RANGE
        self.wanted = range(job.frames)
        self._container, self._stream, self._format = container, stream, video.pixel_format

    def write(self, number: int, pixels: ByteArray) -> None:
        """Encode one frame."""
        import av

        bottom, right = self._stream.height - pixels.shape[0], self._stream.width - pixels.shape[1]
        if bottom or right:
            pixels = np.pad(pixels, ((0, bottom), (0, right), (0, 0)), mode="edge")
        image = Image(pixels)
        if image.is_opaque:
            frame = av.VideoFrame.from_numpy_buffer(np.ascontiguousarray(pixels), format="rgba")
        else:
            frame = av.VideoFrame.from_ndarray(image.opaque, format="rgb24")
        frame = frame.reformat(format=self._format, dst_colorspace=BT709)
        frame.pts = number
        frame.time_base = 1 / self._stream.codec_context.framerate
        self._container.mux(self._stream.encode(frame))

    def flush(self) -> None:
        """Encode what the codec still holds back."""
        self._container.mux(self._stream.encode(None))
