"""Every broken mesh file is refused in its one sentence, and damage at random finds nothing else."""

from __future__ import annotations

import re
import time
from pathlib import Path

import pytest

from eyeline.errors import FileError
from eyeline.files import load
from files import broken_meshes, good_meshes
from files.fuzz import fuzz

SECONDS = 5.0


def written(folder: Path, files: dict[str, bytes]) -> Path:
    """The files in a folder; the first is the model."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in files.items():
        (folder / name).write_bytes(content)
    return folder / next(iter(files))


@pytest.mark.parametrize("what", broken_meshes.TABLE)
def test_broken_file_is_refused_in_its_sentence(what, tmp_path):
    files, sentence = broken_meshes.TABLE[what]
    model = written(tmp_path, files)
    begin = time.monotonic()
    with pytest.raises(FileError) as refusal:
        load(model)
    assert time.monotonic() - begin < SECONDS
    said = str(refusal.value)
    assert said.startswith(f"{model.name}: ")
    assert re.search(sentence, said), said
    assert "\n" not in said and len(said) < 300


def test_folder_and_missing_file_are_refused(tmp_path):
    (tmp_path / "folder.obj").mkdir()
    for name in ("folder.obj", "absent.stl"):
        with pytest.raises(FileError, match=name):
            load(tmp_path / name)


def models(folder: Path) -> list[Path]:
    return [written(folder / name.replace(".", "-"), files) for name, files in good_meshes.every().items()]


def test_damaged_files_are_read_or_refused(tmp_path):
    assert fuzz(models(tmp_path), runs=300, seed=7) == []


@pytest.mark.slow
def test_many_damaged_files_are_read_or_refused(tmp_path):
    assert fuzz(models(tmp_path), runs=20_000, seed=11) == []
