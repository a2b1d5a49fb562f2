"""A folder of numbered PNG frames, which a killed run can continue."""

from __future__ import annotations

import io
import json
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path

from eyeline.errors import FileError
from eyeline.files.whole import whole_file
from eyeline.geometry.arrays import ByteArray
from eyeline.render.encoders.encoder import Job
from eyeline.render.image import Image

MANIFEST = "frames.json"  # says which job the frames belong to
LAST_CHUNK = b"IEND\xaeB`\x82"  # of every PNG, with its check sum


@dataclass(frozen=True)
class PngSequence:
    """frame_00000.png and on; each appears whole, so what a killed run leaves is good."""

    name: str = ""
    resumes: bool = True

    @contextmanager
    def __call__(self, path: Path, job: Job, resume: bool = False) -> Iterator[SequenceSink]:
        """Make the folder; with `resume`, keep the frames in it that are whole and of this job."""
        self.check(path)
        kept = tuple(whole_frames(path, job)) if resume and (path / MANIFEST).exists() else ()
        path.mkdir(exist_ok=True)
        for stale in sorted(set(path.glob("frame_*.png")) - {frame_path(path, number) for number in kept}):
            stale.unlink()
        with whole_file(path / MANIFEST) as manifest:
            manifest.write_text(json.dumps(asdict(job), indent=1) + "\n", encoding="utf-8")
        yield SequenceSink(path, [number for number in range(job.frames) if number not in set(kept)])

    def check(self, path: Path) -> None:
        """Refuse a folder that is none, or that holds frames of somebody else."""
        if not path.parent.is_dir():
            raise FileError(f"{path}: there is no folder {str(path.parent)!r}; make it first")
        if path.exists() and not path.is_dir():
            raise FileError(f"{path}: is a file; frames need a folder, films a suffix such as .mp4")
        if not (path / MANIFEST).exists() and any(path.glob("frame_*.png")):
            raise FileError(
                f"{path}: holds frames but no {MANIFEST}; they are not ours to replace, choose another folder"
            )

    def notes(self, job: Job) -> tuple[str, ...]:
        """Frames are kept as they are."""
        return ()


SEQUENCE = PngSequence()


@dataclass(frozen=True)
class SequenceSink:
    """A folder that lacks some frames."""

    folder: Path
    wanted: Sequence[int]

    def write(self, number: int, pixels: ByteArray) -> None:
        """Write one frame."""
        Image(pixels).save(frame_path(self.folder, number))


def frame_path(folder: Path, number: int) -> Path:
    """Where a frame is kept."""
    return folder / f"frame_{number:05d}.png"


def whole_frames(path: Path, job: Job) -> Iterator[int]:
    """The numbers of the frames in the folder that are complete; refuses frames of another job."""
    try:
        told = json.loads((path / MANIFEST).read_text(encoding="utf-8"))
    except (OSError, ValueError) as reason:
        raise FileError(f"{path / MANIFEST}: cannot be read; start anew without resuming") from reason
    if told != json.loads(json.dumps(asdict(job))):
        raise FileError(f"{path}: holds frames of another film or other options; start anew without resuming")
    for number in range(job.frames):
        if is_whole(frame_path(path, number), job.size):
            yield number


def is_whole(path: Path, size: tuple[int, int]) -> bool:
    """Whether a PNG is there, is of this size, decodes, and ends with its last chunk."""
    import PIL.Image

    try:
        content = path.read_bytes()
        with PIL.Image.open(io.BytesIO(content)) as picture:
            picture.load()
            return picture.size == size and content.endswith(LAST_CHUNK)
    except (OSError, SyntaxError, ValueError):
        return False
