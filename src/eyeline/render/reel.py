"""A reel: pictures in a row, wherever they come from, as a film."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from eyeline.errors import OptionError
from eyeline.geometry.arrays import ByteArray
from eyeline.render.overlap import overlapped

if TYPE_CHECKING:
    from eyeline.render.encoders.encoder import Job
    from eyeline.render.image import Image


class Pictures(Protocol):
    """Pictures by number, 0 and on."""

    def __len__(self) -> int: ...
    def __getitem__(self, number: int, /) -> Image:
        """The picture of a number."""


Progress = Callable[[int, int], None]  # frames done, frames in all


@dataclass(frozen=True, eq=False)
class Reel:
    """Pictures of one size, shown one after the other.

    pictures: a list, or anything that has a length and makes the picture of a number when it is asked.
    """

    pictures: Pictures
    fps: float = 24

    def __post_init__(self) -> None:
        """Refuse a reel of nothing."""
        if len(self.pictures) == 0:
            raise OptionError("a reel of no pictures is no film; give it one or more")
        if not 0 < self.fps <= 1000:
            raise OptionError(f"fps is {self.fps:g}; more than 0 and at most 1000 frames a second are needed")

    def __len__(self) -> int:
        return len(self.pictures)

    def __getitem__(self, number: int) -> Image:
        return self.pictures[number]

    def __iter__(self) -> Iterator[Image]:
        return (self.pictures[number] for number in range(len(self)))

    def save(self, path: str | Path, *, progress: Progress | None = None) -> Path:
        """Write .mp4, .webm, .gif or animated .webp, or a folder of PNG frames if there is no suffix.

        It appears whole or not at all. Refused: pictures of several sizes.
        """
        from eyeline.render.encoders import encoder_for
        from eyeline.render.encoders.encoder import Job

        path, first = Path(path), self.pictures[0]
        encoder = encoder_for(path)
        job = Job(first.size, self.fps, len(self))
        with encoder(path, job) as sink:
            overlapped(self._made(job, first, progress), lambda item: sink.write(*item))
        return path

    def _made(self, job: Job, first: Image, progress: Progress | None) -> Iterator[tuple[int, ByteArray]]:
        for number in range(len(self)):
            picture = self.pictures[number] if number else first
            if picture.size != job.size:
                raise OptionError(
                    f"picture {number} has {picture.size[0]}x{picture.size[1]} pixels and the first"
                    f" {job.size[0]}x{job.size[1]}; all of a reel have one size"
                )
            yield number, picture.pixels
            if progress:
                progress(number + 1, len(self))
