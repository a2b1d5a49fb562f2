"""Animated GIF: 256 colours, understood by everything."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

from eyeline.files.whole import refuse_place, whole_file
from eyeline.geometry.arrays import ByteArray
from eyeline.render.encoders.encoder import Job

if TYPE_CHECKING:
    from av.container import OutputContainer

TICKS = 100  # GIF counts hundredths of a second
FASTEST = 50  # frames a second: viewers slow down what asks for more


@dataclass(frozen=True)
class Gif:
    """Every frame has the 256 colours that fit it best, and a fixed dither pattern that does not crawl."""

    name: str = ".gif"
    resumes: bool = False
    dither: str = "bayer:bayer_scale=4"

    @contextmanager
    def __call__(self, path: Path, job: Job, resume: bool = False) -> Iterator[GifSink]:
        """Encode into a file beside `path` that takes its name when complete."""
        import av

        with (
            whole_file(path) as unfinished,
            av.open(str(unfinished), "w", format="gif", options=endless(job)) as container,
        ):
            sink = GifSink(container, job, self.dither)
            yield sink
            sink.flush()

    def check(self, path: Path) -> None:
        """A file needs a folder to be in."""
        refuse_place(path)

    def notes(self, job: Job) -> tuple[str, ...]:
        """Too many frames a second play slower."""
        if job.fps <= FASTEST:
            return ()
        return (f"{job.fps:g} frames a second is more than GIF viewers play; {FASTEST} is the most",)


class GifSink:
    """Frames on their way through a palette into a GIF."""

    def __init__(self, container: OutputContainer, job: Job, dither: str) -> None:
        stream: Any = container.add_stream("gif", rate=TICKS)
        stream.width, stream.height = job.size
        stream.pix_fmt = "pal8"
        stream.time_base = Fraction(1, TICKS)
        self.wanted = range(job.frames)
        self._container, self._stream, self._fps = container, stream, Fraction(job.fps)
        self._graph = palette_graph(job.size, dither)

    def write(self, number: int, pixels: ByteArray) -> None:
        """Encode one frame; its time is rounded to GIF's ticks, so that a long film keeps its speed."""
        import av

        frame = av.VideoFrame.from_ndarray(pixels, format="rgba")
        frame.pts, frame.time_base = round(number * TICKS / self._fps), Fraction(1, TICKS)
        self._graph.push(frame)
        self._drain()

    def flush(self) -> None:
        """Encode what the graph and the codec still hold back."""
        self._graph.push(None)
        self._drain()
        self._container.mux(self._stream.encode(None))

    def _drain(self) -> None:
        import av

        while True:
            try:
                frame = self._graph.pull()
            except (av.BlockingIOError, av.EOFError):
                return
            self._container.mux(self._stream.encode(frame))


def endless(job: Job) -> dict[str, str]:
    """Repeat for ever; the last frame, which no other follows, lasts as long as the rest."""
    return {"loop": "0", "final_delay": str(max(1, round(TICKS / job.fps)))}


def palette_graph(size: tuple[int, int], dither: str) -> Any:
    """FFmpeg's filters from RGBA to 256 colours, a palette for each frame."""
    import av.filter

    graph = av.filter.Graph()
    width, height = size
    source = graph.add(
        "buffer", f"video_size={width}x{height}:pix_fmt=rgba:time_base=1/{TICKS}:pixel_aspect=1/1"
    )
    split = graph.add("split")
    palette = graph.add("palettegen", "stats_mode=single")
    use = graph.add("paletteuse", f"new=1:dither={dither}")
    sink = graph.add("buffersink")
    source.link_to(split)
    split.link_to(palette, 0, 0)
    split.link_to(use, 1, 0)
    palette.link_to(use, 0, 1)
    use.link_to(sink)
    graph.configure()
    return graph


GIF = Gif()
