"""Thousands of bent files: every one is read or refused, soon, in bounded memory."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from eyeline.files import load
from files import fuzz
from files.good_gltf import GOOD

PROJECT = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize("name", GOOD)
def test_what_the_fuzzer_bends_is_good(tmp_path: Path, name: str) -> None:
    scene = load(GOOD[name]().write(tmp_path, "good.glb"))
    assert scene.face_count > 0
    for clip in range(len(scene.clips)):
        scene.at(0.5, clip)


def test_bent_files_are_read_or_refused(tmp_path: Path) -> None:
    files = [
        make().write(tmp_path, f"{name}.{suffix}")
        for name, make in GOOD.items()
        for suffix in ("gltf", "glb")
    ]
    outcome = fuzz.fuzz(load, files, runs=600, seed=7)
    assert outcome.defects == ()
    # Otherwise the mutations are too weak, or too strong, to test anything
    assert outcome.read > 60 and outcome.refused > 200 and len(outcome.sentences) > 60


@pytest.mark.slow
def test_twenty_thousand_bent_files_are_read_or_refused_in_bounded_memory() -> None:
    program = [sys.executable, "-W", "error", str(PROJECT / "tests" / "files" / "fuzz.py"), "gltf", "20000"]
    done = subprocess.run(program, capture_output=True, text=True, timeout=3000, cwd=PROJECT)
    assert done.returncode == 0, done.stdout[-4000:] + done.stderr[-4000:]
    assert "20000 runs" in done.stdout and " 0 defects" in done.stdout
