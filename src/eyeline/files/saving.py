"""Scenes to files by suffix. Writers are imported when their first file is asked for."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, cast

from eyeline.errors import EyelineError, FileError
from eyeline.files.whole import refuse_place

if TYPE_CHECKING:
    from eyeline.scene.scene import Scene


@dataclass(frozen=True)
class Sampling:
    """How finely motion is written that the format has no keys for.

    fps: times a second at which constraints and deformers are asked. tolerance: how far keys may be from
    them, as a part of the range of the values; of 1 for turns.
    """

    fps: float = 60.0
    tolerance: float = 1e-4

    def __post_init__(self) -> None:
        """Refuse what makes no keys."""
        if not (math.isfinite(self.fps) and self.fps > 0):
            raise FileError(f"fps is {self.fps}; more than 0 frames a second are needed")
        if not 0 < self.tolerance < 1:
            raise FileError(f"tolerance is {self.tolerance}; a part between 0 and 1 is needed")


@dataclass(frozen=True)
class Writer:
    """A file format, and the module whose `save` writes it."""

    name: str
    module: str

    def __call__(self, scene: Scene, path: Path, sampling: Sampling) -> tuple[str, ...]:
        """Write the file; answers a sentence for each thing that it does not hold."""
        return cast("tuple[str, ...]", import_module(self.module).save(scene, path, sampling))


GLTF = Writer("glTF 2.0", "eyeline.files.gltf.writing.writer")

WRITERS: dict[str, Writer] = {".glb": GLTF, ".gltf": GLTF}


def save(scene: Scene, path: str | os.PathLike[str], sampling: Sampling | None = None) -> tuple[str, ...]:
    """Write a scene to a file; its suffix decides the writer, in capitals or not.

    The file appears whole or not at all. Answers a sentence for each thing that is sampled, or lost.
    """
    path = Path(path)
    writer = writer_of(path)
    refuse_place(path)
    try:
        return writer(scene, path, sampling or Sampling())
    except FileError:
        raise
    except EyelineError as error:
        raise FileError(f"{path.name}: {error}") from error


def writer_of(path: Path) -> Writer:
    """The writer of a file, by its suffix."""
    writer = WRITERS.get(path.suffix.lower())
    if writer is None:
        known = ", ".join(sorted(WRITERS))
        raise FileError(f"the suffix {path.suffix!r} is not known; eyeline writes {known}")
    return writer
