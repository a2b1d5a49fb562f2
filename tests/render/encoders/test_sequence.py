from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from eyeline.errors import FileError
from eyeline.render.encoders.encoder import Job
from eyeline.render.encoders.sequence import MANIFEST, SEQUENCE, frame_path

JOB = Job((16, 8), 24, 6, "f" * 64)


def frame(number: int) -> np.ndarray:
    return np.full((8, 16, 4), 40 * number + 15, np.uint8)


def written(folder: Path, job: Job = JOB, resume: bool = False, until: int = 99) -> list[int]:
    """The numbers that were wanted and written."""
    taken = []
    with SEQUENCE(folder, job, resume) as sink:
        for number in sink.wanted:
            if number >= until:
                break
            sink.write(number, frame(number))
            taken.append(number)
    return taken


def test_only_the_missing_frames_are_made_again(tmp_path: Path) -> None:
    folder = tmp_path / "frames"
    assert written(folder, until=3) == [0, 1, 2]
    assert written(folder, resume=True) == [3, 4, 5]
    assert written(folder, resume=True) == []


def test_a_broken_frame_is_made_again(tmp_path: Path) -> None:
    folder = tmp_path / "frames"
    written(folder)
    whole = frame_path(folder, 2).read_bytes()
    frame_path(folder, 2).write_bytes(whole[:-20])
    frame_path(folder, 4).write_bytes(b"")
    assert written(folder, resume=True) == [2, 4]
    assert frame_path(folder, 2).read_bytes() == whole


@pytest.mark.parametrize("other", [{"fingerprint": "0" * 64}, {"fps": 25}, {"frames": 7}, {"size": (8, 8)}])
def test_frames_of_another_job_are_refused(tmp_path: Path, other: dict[str, object]) -> None:
    folder = tmp_path / "frames"
    written(folder, until=3)
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    with pytest.raises(FileError, match="start anew without resuming"):
        written(folder, replace(JOB, **other), resume=True)
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


def test_a_broken_manifest_is_refused(tmp_path: Path) -> None:
    folder = tmp_path / "frames"
    written(folder, until=3)
    (folder / MANIFEST).write_text("{")
    with pytest.raises(FileError, match="cannot be read"):
        written(folder, resume=True)


def test_starting_anew_leaves_no_frame_of_a_longer_film(tmp_path: Path) -> None:
    folder = tmp_path / "frames"
    written(folder)
    (folder / "notes.txt").write_text("mine")
    written(folder, replace(JOB, frames=2))
    assert sorted(path.name for path in folder.iterdir()) == [
        "frame_00000.png", "frame_00001.png", MANIFEST, "notes.txt",
    ]  # fmt: skip


def test_frames_of_somebody_else_are_not_touched(tmp_path: Path) -> None:
    (tmp_path / "frame_00000.png").write_bytes(b"not ours")
    with pytest.raises(FileError, match="not ours to replace"):
        written(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["frame_00000.png"]


def test_a_folder_that_cannot_be_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(FileError, match="is a file"):
        written(tmp_path / "file")
    with pytest.raises(FileError, match="no folder"):
        written(tmp_path / "none" / "frames")
