"""What each command tells, called inside this process."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import PIL.Image
import pytest

import eyeline as el
from data import data
from eyeline.cli import main


def told(capfd: pytest.CaptureFixture[str], *arguments: str) -> str:
    code = main(arguments)
    out, error = capfd.readouterr()
    assert (code, error) == (0, "")
    return out


def test_info_counts_what_is_in_a_sample(capfd: pytest.CaptureFixture[str]) -> None:
    found = json.loads(told(capfd, "info", "sample:desk_lamp", "--json"))
    scene = el.samples.SAMPLES["desk_lamp"]()
    assert found["faces"] == scene.face_count
    assert [clip["name"] for clip in found["clips"]] == [clip.name for clip in scene.clips]
    assert [node["path"] for node in found["nodes"]] == list(scene.paths)
    assert found["bounds"]["low"] == pytest.approx(scene.bounds.low)
    assert len(found["lights"]) == len(scene.lights)


def test_info_of_a_file_tells_its_clip_and_its_skin(capfd: pytest.CaptureFixture[str]) -> None:
    text = told(capfd, "info", str(data("gltf/cesium_man.gltf")))
    assert re.search(r"clips +\S.*, 2\.0\d\d s", text)
    assert "skin of 19 joints" in text
    assert re.search(r"faces +4,672 ", text)


def test_doctor_tells_versions_threads_and_films(capfd: pytest.CaptureFixture[str]) -> None:
    found = json.loads(told(capfd, "doctor", "--json"))
    assert found["eyeline"] == el.__version__
    assert found["threads"] >= 1
    assert found["films"][".mp4"] == "yes"
    assert "missing" not in found["libraries"].values()
    assert set(found) == {line.split()[0] for line in told(capfd, "doctor").splitlines()}


def test_version_is_the_packages(capfd: pytest.CaptureFixture[str]) -> None:
    assert told(capfd, "--version") == f"eyeline {el.__version__}\n"


def test_demo_makes_a_film_all_four_kinds_of_result(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "demo"
    small = ["--size", "64x36", "--fps", "4", "--samples", "1"]
    paths = told(capfd, "demo", "-o", str(folder), *small).split()
    assert sorted(paths) == sorted(str(path) for path in folder.iterdir())
    assert {Path(path).suffix for path in paths} == {".png", ".svg", ".mp4"}
    with PIL.Image.open(folder / "contact_sheet.png") as sheet:
        assert sheet.width > 4 * 400


def test_draw_writes_the_kinds_that_are_asked_for(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    path = str(tmp_path / "cube.svg")
    options = ["--hidden", "dashed", "--edges", "crease, outline", "--size", "320x180", "--json"]
    found = json.loads(told(capfd, "draw", "sample:cube", "-o", path, *options))
    assert {**found, "seconds": 0} == {
        "path": path, "size": [320, 180], "seconds": 0,
        "paths": {"outline": 1, "crease": 2, "hidden crease": 2},
    }  # fmt: skip
    assert json.loads(told(capfd, "draw", "sample:cube", "-o", path, "--crease", "91", "--json"))[
        "paths"
    ] == {"outline": 1}


def test_a_background_is_a_colour_as_css_writes_it(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    for name, color in {
        "white": (255, 255, 255),
        "#204080": (32, 64, 128),
        "rgb(10,20,30)": (10, 20, 30),
    }.items():
        path = tmp_path / "a.png"
        told(capfd, "render", "sample:cube", "-o", str(path), "--size", "64x36", "--background", name)
        with PIL.Image.open(path) as picture:
            assert np.abs(np.asarray(picture)[0, 0, :3].astype(int) - color).max() <= 1


def test_clips_and_cameras_go_by_number_too(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    model = str(data("gltf/Fox.glb"))
    names = [clip.name for clip in el.load(model).clips]
    pictures = []
    for clip in (names[1], "1", "0"):
        told(
            capfd, "render", model, "-o", str(tmp_path / "a.png"), "--clip", clip, "--time", "0.3",
            "--size", "64x36", "--samples", "1",
        )  # fmt: skip
        pictures.append((tmp_path / "a.png").read_bytes())
    assert pictures[0] == pictures[1] != pictures[2]


def test_explain_writes_the_steps_of_a_method(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "steps.html"
    code = main(["explain", "zbuffer", "sample:teapot", "-o", str(path), "--faces", "200", "--json"])
    out, notice = capfd.readouterr()
    assert code == 0
    assert notice.startswith("eyeline: the scene has 12,432 faces; what is shown has 1")
    found = json.loads(out)
    assert found["method"] == "zbuffer" and found["steps"] > 100
    assert found["work"]["depth tests"] > 100
    assert path.read_text().startswith("<!doctype html>")


def test_compare_measures_the_methods_that_are_named(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "sheet.png"
    options = ["--methods", "zbuffer, backface", "--size", "64x36", "--json"]
    found = json.loads(told(capfd, "compare", "sample:convex_body", "-o", str(path), *options))
    assert [row["method"] for row in found["methods"]] == ["zbuffer", "backface"]
    assert found["judge"] == "oracle"
    with PIL.Image.open(path) as sheet:
        assert sheet.size[0] == 1780
