"""Opening a file by its suffix."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from eyeline.errors import FileError
from eyeline.files import READERS, load
from files.gltf_builder import Builder


def test_the_way_to_the_model_does_not_matter(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    builder = Builder()
    builder.node(mesh=builder.square())
    builder.write(tmp_path)
    monkeypatch.chdir(tmp_path)
    assert load("model.gltf").face_count == load(Path("./model.gltf")).face_count == 2


@pytest.mark.parametrize(
    ("path", "sentence"),
    [
        ("model.blend", r"^model\.blend: the suffix '\.blend' is not known; eyeline reads .*\.glb, \.gltf"),
        ("absent.glb", r"^absent\.glb: there is no such file in '.*'; check the path$"),
        (".", r"^.*: the suffix '' is not known"),
    ],
)
def test_what_is_no_model_is_refused_by_name(tmp_path: Path, path: str, sentence: str) -> None:
    with pytest.raises(FileError, match=sentence):
        load(tmp_path / path)


def test_a_folder_is_no_model(tmp_path: Path) -> None:
    (tmp_path / "folder.glb").mkdir()
    with pytest.raises(
        FileError, match=r"^folder\.glb: is not a regular file; give the path of a model file$"
    ):
        load(tmp_path / "folder.glb")


def test_a_path_no_system_can_hold_is_refused() -> None:
    with pytest.raises(FileError, match=r"^m+\.glb: .*; check the path and its permissions$"):
        load("m" * 5000 + ".glb")


@pytest.mark.parametrize(
    "suffix", [suffix for suffix, reader in READERS.items() if not reader.several_scenes]
)
def test_a_format_of_one_scene_lets_none_be_chosen(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"model{suffix}"
    path.write_bytes(b"")
    with pytest.raises(
        FileError, match=r"^model.*: scene is 'a', but .* files hold one scene; leave it out$"
    ):
        load(path, scene="a")


def test_suffixes_in_capitals_are_the_same_suffixes(tmp_path: Path) -> None:
    builder = Builder()
    builder.node(mesh=builder.square())
    (tmp_path / "MODEL.GLB").write_bytes(builder.glb())
    assert load(tmp_path / "MODEL.GLB").face_count == 2


def test_reading_does_not_wait_for_the_compiler(tmp_path: Path) -> None:
    builder = Builder()
    builder.node(mesh=builder.square())
    program = f"""
import sys
from eyeline.files import load
load({str(builder.write(tmp_path))!r})
print("numba" in sys.modules)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
