"""`eyeline expose`: films and onion skins of an exposure sheet."""

from __future__ import annotations

import json
from pathlib import Path

import PIL.Image
import pytest

from eyeline.cli import main


@pytest.fixture
def sheet(tmp_path: Path) -> Path:
    for name, x in (("a", 0), ("b", 16)):
        rect = f'<rect x="{x}" y="4" width="8" height="8"/>'
        (tmp_path / f"{name}.svg").write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" width="32" height="16">{rect}</svg>'
        )
    (tmp_path / "walk.csv").write_text("block\na\ninbetween\nb\n")
    return tmp_path / "walk.csv"


def test_it_makes_a_film(sheet: Path, capfd: pytest.CaptureFixture[str]) -> None:
    out = sheet.with_name("out.gif")
    assert main(["expose", str(sheet), "-o", str(out), "--on", "2", "--size", "64x32", "--json"]) == 0
    told = json.loads(capfd.readouterr().out)
    assert (told["frames"], told["fps"], told["size"]) == (6, 24, [64, 32])
    with PIL.Image.open(out) as film:
        assert (film.size, film.n_frames) == ((64, 32), 6)


def test_it_makes_an_onion_skin(sheet: Path) -> None:
    out = sheet.with_name("onion.png")
    assert main(["expose", str(sheet), "-o", str(out), "--onion", "2"]) == 0
    with PIL.Image.open(out) as skin:
        assert skin.size == (32, 16)


REFUSED = {
    "no film": (["-o", "out.png"], "is no film"),
    "no picture": (["-o", "out.mp4", "--onion", "1"], "an onion skin is one picture"),
    "no frame": (["-o", "out.png", "--onion", "4"], "frame is 4; the sheet has frames 1 to 3"),
    "no size": (["-o", "out.gif", "--size", "large"], "size is 'large'; write it as 1280x720"),
    "no exposure": (["-o", "out.gif", "--on", "0"], "on is 0"),
    "no rate": (["-o", "out.gif", "--fps", "-1"], "fps is -1"),
    "no folder": (["-o", "none/out.gif"], "there is no folder"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_be_done_is_refused_in_a_sentence(
    sheet: Path, name: str, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(sheet.parent)
    options, sentence = REFUSED[name]
    assert main(["expose", "walk.csv", *options]) == 2
    said = capfd.readouterr().err
    assert sentence in said and said.count("\n") == 1
