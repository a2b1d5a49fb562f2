"""Every program of the gallery runs as it stands, only smaller, and saves something worth a look."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import PIL.Image
import pytest

import house

EXAMPLES = sorted((house.PROJECT / "examples").glob("plot_*.py"))
SMALL = {"SIZE": "(96, 64)", "FPS": "4"}


def smaller(source: str) -> str:
    """The program with small values for the constants that decide how long it takes."""
    for name, value in SMALL.items():
        source = re.sub(rf"^{name} = .*$", f"{name} = {value}", source, flags=re.MULTILINE)
    return source


@pytest.mark.parametrize("file", EXAMPLES, ids=[file.stem for file in EXAMPLES])
def test_example_saves_a_picture(file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    source = smaller(file.read_text())
    assert "SIZE = (96, 64)" in source
    exec(compile(source, str(file), "exec"), {"__name__": "__main__"})

    saved = list(tmp_path.iterdir())
    assert [one.stem for one in saved] == [file.stem.removeprefix("plot_")]
    if saved[0].suffix == ".svg":
        assert saved[0].read_text().count("<path") > 20
        return
    with PIL.Image.open(saved[0]) as picture:
        colours = np.unique(np.asarray(picture.convert("RGB")).reshape(-1, 3), axis=0)
    assert len(colours) > 50


@pytest.mark.parametrize("file", EXAMPLES, ids=[file.stem for file in EXAMPLES])
def test_example_is_short(file: Path) -> None:
    assert len(file.read_text().splitlines()) <= 60
