"""What only a real process can show: exit codes, signals, pipes, and what is left behind."""

from __future__ import annotations

import json
import signal
from pathlib import Path

import av
import PIL.Image
import pytest

import eyeline as el
from commands import LONGEST_WAIT, ended, started, wait_until

SMALL = ["--size", "64x48", "--samples", "1", "--style", "flat"]
ENDLESS = ["render", "sample:cube", "--turntable", "100000", *SMALL]


def test_a_picture_is_made_without_a_word_in_a_pipe(tmp_path: Path) -> None:
    assert ended(tmp_path, "render", "sample:cube", "-o", "a.png", *SMALL) == (0, "", "")
    with PIL.Image.open(tmp_path / "a.png") as picture:
        assert picture.size == (64, 48)
    assert [path.name for path in tmp_path.iterdir()] == ["a.png"]


def test_a_film_has_the_frames_that_were_asked_for(tmp_path: Path) -> None:
    options = ["--turntable", "1", "--fps", "12", *SMALL]
    code, out, error = ended(tmp_path, "render", "sample:cube", "-o", "a.mp4", "--json", *options)
    assert (code, error) == (0, "")
    told = json.loads(out)
    assert {**told, "seconds": 0} == {
        "path": "a.mp4", "frames": 12, "fps": 12.0, "size": [64, 48], "notes": [], "seconds": 0,
    }  # fmt: skip
    with av.open(str(tmp_path / "a.mp4")) as container:
        assert container.streams.video[0].average_rate == 12
        assert len(list(container.decode(video=0))) == 12


@pytest.mark.parametrize(("sent", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
@pytest.mark.parametrize("suffix", ["mp4", "gif", "webp"])
def test_an_interrupted_film_leaves_nothing(
    tmp_path: Path, sent: signal.Signals, code: int, suffix: str
) -> None:
    process = started(tmp_path, *ENDLESS, "-o", f"film.{suffix}")
    wait_until(lambda: any(path.stat().st_size > 0 for path in tmp_path.iterdir()), process)
    process.send_signal(sent)
    out, error = process.communicate(timeout=LONGEST_WAIT)
    assert (process.returncode, out, error) == (code, "", "")
    assert list(tmp_path.iterdir()) == []


def test_an_interrupted_film_spares_the_older_one(tmp_path: Path) -> None:
    (tmp_path / "film.mp4").write_bytes(b"older")
    process = started(tmp_path, *ENDLESS, "-o", "film.mp4")
    wait_until(lambda: len(list(tmp_path.iterdir())) > 1, process)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=LONGEST_WAIT)
    assert process.returncode == 130
    assert [(path.name, path.read_bytes()) for path in tmp_path.iterdir()] == [("film.mp4", b"older")]


def test_a_killed_sequence_is_resumed_to_the_same_bytes(tmp_path: Path) -> None:
    options = ["render", "sample:cube", "--turntable", "4", "--fps", "20", *SMALL, "-o"]
    process = started(tmp_path, *options, "broken")
    wait_until(lambda: (tmp_path / "broken/frame_00004.png").exists(), process)
    process.kill()
    process.communicate()
    before = len(list((tmp_path / "broken").glob("frame_*.png")))
    assert 5 <= before < 80
    code, out, error = ended(tmp_path, *options, "broken", "--resume", "--json")
    assert (code, error, json.loads(out)["frames"]) == (0, "", 80)
    el.film(el.samples.SAMPLES["cube"](), fps=20, turntable=4, size=(64, 48), samples=1, style="flat").save(
        tmp_path / "whole"
    )
    whole = {path.name: path.read_bytes() for path in (tmp_path / "whole").iterdir()}
    assert len(whole) == 81
    broken = {path.name: path.read_bytes() for path in (tmp_path / "broken").glob("f*")}
    assert broken == whole


def test_a_refusal_is_one_sentence_and_code_2(tmp_path: Path) -> None:
    code, out, error = ended(tmp_path, "render", "none.glb", "-o", "a.png")
    assert (code, out, error.count("\n")) == (2, "", 1)
    assert error.startswith("eyeline: none.glb")
    assert list(tmp_path.iterdir()) == []


def test_help_tells_every_command(tmp_path: Path) -> None:
    code, out, _ = ended(tmp_path, "--help")
    assert code == 0
    assert all(name in out for name in ("render", "draw", "info", "doctor", "demo"))


def test_output_may_be_cut_off(tmp_path: Path) -> None:
    process = started(tmp_path, "info", "sample:desk_lamp")
    assert process.stdout is not None and process.stderr is not None
    process.stdout.close()
    assert process.stderr.read() == ""
    assert process.wait(LONGEST_WAIT) == 0
    process.stderr.close()
