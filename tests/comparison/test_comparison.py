"""Comparisons: every method on one scene, judged; a method that is wrong is caught."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import PIL.Image
import pytest

import eyeline as el
from eyeline.comparison import agreement, compare
from eyeline.comparison.agreement import judge_of
from eyeline.comparison.cells import rows_of
from eyeline.comparison.comparison import WRITERS
from eyeline.comparison.ladder import Ladder, cut_in_four, subdivided
from eyeline.comparison.page import page
from eyeline.comparison.plot import plot
from eyeline.comparison.thumbnails import any_in_block
from eyeline.comparison.trial import tried
from eyeline.errors import FileError, OptionError, SceneError
from eyeline.projection import project
from eyeline.scene.camera import Camera
from eyeline.visibility import METHODS, Visible

SMALL = (64, 36)


@dataclass(frozen=True)
class Wrong:
    """The depth buffer, with one pixel of background painted and one face's pixels swapped."""

    name: str = "wrong"
    space: str = "image"
    answers: bool = True
    exact: bool = True

    def __call__(self, projected) -> Visible:
        seen = METHODS["zbuffer"](projected)
        face = seen.face.copy()
        face[0, 0] = 0
        return replace(seen, face=face)


@pytest.mark.parametrize("case", el.samples.HARD_CASES)
def test_all_methods_agree_on_every_hard_case(case: str) -> None:
    found = compare(el.samples.SAMPLES[case](), size=SMALL)
    assert [trial.name for trial in found.trials] == list(METHODS)
    assert found.judge.name == "oracle"
    assert found.judge.share > 0.8
    answering = [name for name, method in METHODS.items() if method.answers]
    assert set(answering) <= set(found.agreements)
    assert {name: int(one.wrong.sum()) for name, one in found.agreements.items() if one.wrong.any()} == {}


def test_a_wrong_pixel_is_found_by_the_oracle() -> None:
    scene = el.samples.cyclic_overlap()
    projected = project(scene, scene.cameras[0].fitted(scene.bounds), SMALL)
    judge = judge_of(scene, projected, "auto", METHODS["zbuffer"](projected))
    wrong = judge.of(Wrong()(projected)).wrong
    assert np.argwhere(wrong).tolist() == [[0, 0]]


def test_a_wrong_pixel_is_found_where_the_depth_buffer_judges(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = el.samples.teapot()
    monkeypatch.setattr(agreement, "MOST_FACES", scene.face_count - 1)
    camera = Camera.framing(scene.bounds).fitted(scene.bounds)
    projected = project(scene, camera, SMALL)
    judge = judge_of(scene, projected, "auto", METHODS["zbuffer"](projected))
    assert (judge.name, judge.share) == ("zbuffer", None)
    found = judge.of(Wrong()(projected))
    assert np.argwhere(found.wrong).tolist() == [[0, 0]]


def test_a_method_that_refuses_says_why() -> None:
    found = compare(el.samples.concave_body(), ["zbuffer", "backface"], size=SMALL)
    sees, refuses = rows_of(found)
    assert sees.agrees is True and sees.agreement[0] == "agrees"
    assert refuses.agrees is None and "not convex" in refuses.agreement[0]


def test_a_trial_measures_time_and_memory() -> None:
    scene = el.samples.teapot()
    size = (1600, 900)
    trial = tried(METHODS["zbuffer"], project(scene, Camera.framing(scene.bounds), size))
    assert 0 < trial.again < 5
    # Face and depth at least
    assert trial.memory is None or 8 * size[0] * size[1] < trial.memory < 100 * size[0] * size[1]


# --- ladders ----------------------------------------------------------------------------------------------


def test_a_face_cut_in_four_covers_what_it_covered() -> None:
    scene = el.samples.cyclic_overlap()
    finer = subdivided(scene)
    assert finer.face_count == 4 * scene.face_count
    camera = scene.cameras[0].fitted(scene.bounds)
    seen = [METHODS["zbuffer"](project(one, camera, SMALL)).node for one in (scene, finer)]
    assert (seen[0] == seen[1]).mean() > 0.99


def test_neighbours_share_the_middles_of_their_edges() -> None:
    mesh = el.Mesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)])
    four = cut_in_four(mesh)
    assert (len(four.points), len(four.faces)) == (9, 8)


def test_the_exponent_is_the_slope_of_the_logarithms() -> None:
    ladder = Ladder("faces", (10, 100, 1000), {"square": (1e-4, 1e-2, 1.0), "short": (1.0,)})
    assert ladder.exponent("square") == pytest.approx(2)
    assert ladder.exponent("short") is None
    assert plot(ladder).size == (760, 460)


def test_ladders_climb_with_faces_and_pixels(monkeypatch: pytest.MonkeyPatch) -> None:
    from eyeline.comparison import ladder

    monkeypatch.setattr(ladder, "MOST_FACES", 200)
    found = compare(el.samples.cyclic_overlap(), ["zbuffer"], size=SMALL, ladder=True)
    faces, pixels = found.ladders
    assert faces.rungs == (8, 32, 128)
    assert pixels.rungs == (16 * 9, 32 * 18, 64 * 36, 128 * 72)
    assert all(len(times) == len(one.rungs) for one in found.ladders for times in one.seconds.values())
    with pytest.raises(SceneError, match="no faces"):
        compare(el.Scene(), ["zbuffer"], size=SMALL, ladder=True)


# --- files ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("suffix", WRITERS)
def test_every_kind_of_file_is_written(suffix: str, tmp_path: Path) -> None:
    found = compare(el.samples.convex_body(), ["zbuffer", "backface"], size=SMALL)
    path = found.save(tmp_path / f"all{suffix}")
    assert list(tmp_path.iterdir()) == [path]
    if suffix == ".png":
        with PIL.Image.open(path) as sheet:
            assert sheet.size[0] == 1780
    if suffix == ".json":
        rows = json.loads(path.read_text())["methods"]
        assert [row["method"] for row in rows] == ["zbuffer", "backface"]
        assert all(row["wrong_pixels"] == 0 and row["seconds"] > 0 for row in rows)


def test_the_page_loads_nothing_and_escapes_names() -> None:
    evil = replace(el.samples.convex_body(), name="<script>alert(1)</script>")
    text = page(compare(evil, ["zbuffer"], size=SMALL))
    assert "<script" not in text
    assert not re.search(r"https?://", text)


def test_no_marked_pixel_is_lost_in_a_smaller_map() -> None:
    where = np.zeros((1080, 1920), bool)
    where[1079, 1919] = where[500, 3] = True
    assert any_in_block(where, (256, 144)).sum() == 2


def test_what_cannot_be_compared_is_refused(tmp_path: Path) -> None:
    scene = el.samples.cube()
    with pytest.raises(OptionError, match=r"no method 'painters'"):
        compare(scene, ["painters"])
    with pytest.raises(FileError, match="is no comparison"):
        compare(scene, ["zbuffer"], size=SMALL).save(tmp_path / "all.docx")
    assert list(tmp_path.iterdir()) == []
