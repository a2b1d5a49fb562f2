"""Every command on input that cannot be used: exit 2, one sentence, nothing written."""

from __future__ import annotations

from pathlib import Path

import pytest

from eyeline.cli import main

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A working folder with a good model and several bad ones; the command runs inside."""
    (tmp_path / "good.obj").write_text(TRIANGLE)
    (tmp_path / "empty.glb").touch()
    (tmp_path / "model.docx").write_text("words")
    (tmp_path / "folder.obj").mkdir()
    monkeypatch.chdir(tmp_path)
    return tmp_path


SCENES = {
    "missing file": ("none.glb", "none.glb"),
    "a folder": ("folder.obj", "folder.obj"),
    "an empty file": ("empty.glb", "empty.glb"),
    "an unknown suffix": ("model.docx", "model.docx"),
    "an unknown sample": ("sample:teapott", "'teapot'"),
    "a sample without a name": ("sample:", "sample"),
    "no name": ("", ""),
    "a null byte": ("a\0b.glb", ""),
}

OPTIONS = {
    "size of nothing": (["--size", "0x0"], "0"),
    "size too wide": (["--size", "99999999x1"], "99999999"),
    "size too much": (["--size", "16384x16384"], "16384x16384"),
    "size without a height": (["--size", "640"], "'640'"),
    "negative size": (["--size", "-5x5"], "'-5x5'"),
    "size of words": (["--size", "bigxsmall"], "bigxsmall"),
    "size with other digits": (["--size", "٣x٣"], "1280x720"),
    "three samples": (["--samples", "3"], "samples is 3"),
    "no samples": (["--samples", "0"], "samples is 0"),
    "samples of words": (["--samples", "many"], "many"),
    "unknown style": (["--style", "shiny"], "'shiny'"),
    "unknown method": (["--method", "zbufer"], "'zbuffer'"),
    "unknown clip": (["--clip", "walk"], "'walk'"),
    "unknown camera": (["--camera", "front"], "'front'"),
    "camera beyond the last": (["--camera", "7"], "7"),
    "background of no colour": (["--background", "bluish"], "'bluish'"),
    "exposure nan": (["--exposure", "nan"], "nan"),
    "exposure of words": (["--exposure", "bright"], "bright"),
    "unknown option": (["--shiny"], "--shiny"),
    "a second scene": (["good.obj"], "good.obj"),
}

STILLS = {
    "time nan": (["--time", "nan"], "nan"),
    "time inf": (["--time", "inf"], "inf"),
    "fps of a picture": (["--fps", "24"], "--fps"),
    "turntable of a picture": (["--turntable", "2"], "--turntable"),
    "resume of a picture": (["--resume"], "--resume"),
}

DRAWINGS = {
    "no kind of edge": (["--edges", "outline,shade"], "'shade'"),
    "no edges": (["--edges", ","], "edges is empty"),
    "hidden lines of another kind": (["--hidden", "dotted"], "'dotted'"),
    "crease of more than half a turn": (["--crease", "200"], "200"),
    "crease nan": (["--crease", "nan"], "nan"),
    "crease of words": (["--crease", "sharp"], "'sharp'"),
    "size of nothing": (["--size", "0x9"], "0"),
    "size too wide": (["--size", "99999x9"], "99999"),
    "time nan": (["--time", "nan"], "nan"),
    "unknown clip": (["--clip", "walk"], "'walk'"),
    "unknown camera": (["--camera", "front"], "'front'"),
    "an option of pictures": (["--samples", "4"], "--samples"),
    "a picture": (["-o", "out.png"], ".svg"),
    "no suffix": (["-o", "out"], ".svg"),
    "a missing folder": (["-o", "none/out.svg"], "none"),
    "a folder": (["-o", "folder.svg"], "folder.svg"),
}

FILMS = {
    "no clip and no end": ([], "--turntable"),
    "fps 0": (["--end", "1", "--fps", "0"], "fps is 0"),
    "negative fps": (["--end", "1", "--fps", "-24"], "fps is -24"),
    "fps nan": (["--end", "1", "--fps", "nan"], "nan"),
    "fps inf": (["--end", "1", "--fps", "inf"], "inf"),
    "end before start": (["--start", "2", "--end", "1"], "from 2 to 1"),
    "end nan": (["--end", "nan"], "nan"),
    "endless": (["--end", "inf"], "inf"),
    "end in a million years": (["--end", "3e13"], "frames"),
    "start nan": (["--start", "nan", "--end", "1"], "nan"),
    "turntable 0": (["--turntable", "0"], "turntable is 0"),
    "turntable negative": (["--turntable", "-1"], "turntable is -1"),
    "turntable nan": (["--turntable", "nan"], "nan"),
    "time of a film": (["--end", "1", "--time", "0"], "--time"),
    "resume of a film": (["--end", "1", "--resume"], "resumed"),
}

OUTPUTS = {
    "a missing folder": ("none/a.png", "none"),
    "a film in a missing folder": ("none/a.mp4", "none"),
    "frames in a missing folder": ("none/frames", "none"),
    "a folder": ("folder.obj", ".obj"),
    "an unknown suffix": ("a.docx", ".docx"),
    "no film": ("a.mp3", ".mp3"),
    "frames into a file": ("Makefile", "Makefile"),
}


def refused(capfd: pytest.CaptureFixture[str], folder: Path, arguments: list[str], word: str) -> None:
    before = sorted(folder.rglob("*"))
    assert main(arguments) == 2
    out, error = capfd.readouterr()
    assert out == ""
    assert error.startswith("eyeline: ") and error.count("\n") == 1 and error.endswith("\n"), error
    assert word in error, error
    assert "Traceback" not in error and "defect" not in error
    assert sorted(folder.rglob("*")) == before


@pytest.mark.parametrize("case", SCENES)
@pytest.mark.parametrize(
    "command",
    [
        ["render", "-o", "out.png"],
        ["render", "-o", "out.mp4", "--end", "1"],
        ["draw", "-o", "out.svg"],
        ["info"],
    ],
)
def test_a_scene_that_cannot_be_read(
    folder: Path, capfd: pytest.CaptureFixture[str], command: list[str], case: str
) -> None:
    scene, word = SCENES[case]
    refused(capfd, folder, [*command, scene], word)


@pytest.mark.parametrize("case", OPTIONS)
@pytest.mark.parametrize(
    "output", [["-o", "out.png"], ["-o", "out.mp4", "--end", "1"], ["-o", "frames", "--end", "1"]]
)
def test_an_option_that_cannot_be_used(
    folder: Path, capfd: pytest.CaptureFixture[str], output: list[str], case: str
) -> None:
    options, word = OPTIONS[case]
    refused(capfd, folder, ["render", "good.obj", *output, *options], word)


@pytest.mark.parametrize("case", STILLS)
def test_an_option_that_no_picture_takes(folder: Path, capfd: pytest.CaptureFixture[str], case: str) -> None:
    options, word = STILLS[case]
    refused(capfd, folder, ["render", "good.obj", "-o", "out.png", *options], word)


@pytest.mark.parametrize("case", DRAWINGS)
def test_an_option_that_no_drawing_takes(folder: Path, capfd: pytest.CaptureFixture[str], case: str) -> None:
    options, word = DRAWINGS[case]
    (folder / "folder.svg").mkdir()
    refused(capfd, folder, ["draw", "good.obj", "-o", "out.svg", *options], word)


@pytest.mark.parametrize("case", FILMS)
def test_an_option_that_no_film_takes(folder: Path, capfd: pytest.CaptureFixture[str], case: str) -> None:
    options, word = FILMS[case]
    refused(capfd, folder, ["render", "good.obj", "-o", "out.mp4", *options], word)


@pytest.mark.parametrize("case", OUTPUTS)
def test_an_output_that_cannot_be_written(folder: Path, capfd: pytest.CaptureFixture[str], case: str) -> None:
    output, word = OUTPUTS[case]
    (folder / "Makefile").touch()
    refused(capfd, folder, ["render", "good.obj", "-o", output], word)


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        (["rendr"], "rendr"),
        (["render"], "SCENE"),
        (["render", "good.obj"], "--output"),
        (["info"], "SCENE"),
        (["info", "good.obj", "--size", "1x1"], "--size"),
        (["doctor", "--cold"], "--cold"),
        (["doctor", "good.obj"], "good.obj"),
        (["demo", "-o", "none/demo"], "none/demo"),
        (["demo", "-o", "good.obj"], "good.obj"),
        (["demo", "--size", "0x0"], "0"),
        (["demo", "--fps", "nan"], "nan"),
        (["demo", "--samples", "3"], "samples is 3"),
    ],
)
def test_a_command_that_cannot_be(
    folder: Path, capfd: pytest.CaptureFixture[str], arguments: list[str], word: str
) -> None:
    refused(capfd, folder, arguments, word)
