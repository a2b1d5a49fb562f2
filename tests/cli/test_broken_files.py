"""Every broken model through the command line: exit 2, one line, nothing written."""

from __future__ import annotations

from pathlib import Path

import pytest

from commands import ended
from eyeline.cli import main
from files import broken_meshes
from files.bent_gltf import Broken
from files.broken_gltf import BROKEN

# Compiling kernels or starting processes for each would take minutes; a few go the whole way.
WHOLE_WAY = BROKEN[:: max(1, len(BROKEN) // 4)]


def refused(folder: Path, model: Path, capfd: pytest.CaptureFixture[str]) -> None:
    before = sorted(folder.rglob("*"))
    assert main(["render", str(model), "-o", str(folder / "out.png"), "--json"]) == 2
    out, error = capfd.readouterr()
    assert out == ""
    assert error.startswith("eyeline: ") and error.count("\n") == 1 and model.name in error, error
    assert sorted(folder.rglob("*")) == before


@pytest.mark.parametrize("broken", [pytest.param(one, id=one.name) for one in BROKEN])
def test_a_broken_gltf_is_refused(tmp_path: Path, capfd: pytest.CaptureFixture[str], broken: Broken) -> None:
    refused(tmp_path, broken.write(tmp_path), capfd)


@pytest.mark.parametrize("what", broken_meshes.TABLE)
def test_a_broken_mesh_is_refused(tmp_path: Path, capfd: pytest.CaptureFixture[str], what: str) -> None:
    files, _ = broken_meshes.TABLE[what]
    for name, content in files.items():
        (tmp_path / name).write_bytes(content)
    refused(tmp_path, tmp_path / next(iter(files)), capfd)


@pytest.mark.parametrize("broken", [pytest.param(one, id=one.name) for one in WHOLE_WAY])
def test_a_process_refuses_it_too(tmp_path: Path, broken: Broken) -> None:
    model = broken.write(tmp_path)
    before = sorted(tmp_path.rglob("*"))
    code, out, error = ended(tmp_path, "render", model.name, "-o", "out.mp4", "--turntable", "1")
    assert (code, out, error.count("\n")) == (2, "", 1)
    assert error.startswith(f"eyeline: {model.name}: ")
    assert sorted(tmp_path.rglob("*")) == before
