"""Thousands of damaged files: every one is read or refused, soon, in bounded memory."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from data import every
from eyeline.errors import FileError
from eyeline.files import load
from files.damaged_gltf import damaged_gltf
from files.fuzz import fuzz
from files.good_gltf import GOOD


def models(folder: Path) -> list[Path]:
    """Small good files, each in a folder of its own, and the small ones of the real models."""
    made = []
    for name, make in GOOD.items():
        for suffix in ("gltf", "glb"):
            (folder / name / suffix).mkdir(parents=True)
            made.append(make().write(folder / name / suffix, f"{name}.{suffix}"))
    for path in [*every("gltf/*.gltf"), *every("gltf/*.glb")]:
        if path.stat().st_size < 50_000:
            (folder / path.name).mkdir()
            (folder / path.name / path.name).write_bytes(path.read_bytes())
            made.append(folder / path.name / path.name)
            for other in path.parent.glob("*.bin"):
                if other.stem in path.read_text(errors="replace"):
                    (folder / path.name / other.name).write_bytes(other.read_bytes())
    return made


@pytest.mark.parametrize("name", GOOD)
def test_what_is_damaged_was_good(tmp_path: Path, name: str) -> None:
    scene = load(GOOD[name]().write(tmp_path, "good.glb"))
    assert scene.face_count > 0
    for clip in range(len(scene.clips)):
        scene.at(0.5, clip)


def test_damage_is_neither_too_weak_nor_too_strong(tmp_path: Path) -> None:
    read, sentences = 0, set()
    good = [make().glb() for make in GOOD.values()]
    path = tmp_path / "model.glb"
    for run in range(200):
        data = damaged_gltf(good[run % len(good)], random.Random(run))
        assert data is not None
        path.write_bytes(data)
        try:
            load(path)
            read += 1
        except FileError as error:
            sentences.add(str(error))
    assert read > 40
    assert len(sentences) > 60


def test_damaged_files_are_read_or_refused(tmp_path: Path) -> None:
    assert fuzz(models(tmp_path), runs=400, seed=7) == []


@pytest.mark.slow
def test_many_damaged_files_are_read_or_refused(tmp_path: Path) -> None:
    assert fuzz(models(tmp_path), runs=20_000, seed=11) == []
