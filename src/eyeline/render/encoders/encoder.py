"""What every encoder takes and does."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from eyeline.geometry.arrays import ByteArray


@dataclass(frozen=True)
class Job:
    """What is to be encoded: the same job makes the same frames."""

    size: tuple[int, int]  # width, height
    fps: float
    frames: int
    fingerprint: str = ""  # of everything the frames follow from; only for encoders that resume


class Sink(Protocol):
    """An open file, or folder, that takes frames."""

    @property
    def wanted(self) -> Sequence[int]:
        """The numbers of the frames it still lacks, rising."""

    def write(self, number: int, pixels: ByteArray) -> None:
        """Take frame `number`, (H, W, 4); frames come in the order of `wanted`."""


class Encoder(Protocol):
    """A kind of film file: a frozen object with its parameters."""

    @property
    def name(self) -> str:
        """Its key in ENCODERS: the suffix with its point, "" for a folder."""

    @property
    def resumes(self) -> bool:
        """Whether it continues what a killed run left."""

    def __call__(self, path: Path, job: Job, resume: bool = False) -> AbstractContextManager[Sink]:
        """Open `path` for a job; it is complete when the block ends well, and absent or as before if not."""

    def check(self, path: Path) -> None:
        """Refuse a place it cannot write to, before long work begins."""

    def notes(self, job: Job) -> tuple[str, ...]:
        """What it must change about the pictures, a sentence each."""
