"""Explanations: every method's steps on a scene, drawn to the same answer; and what is refused."""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest

import eyeline as el
from eyeline.errors import FileError, OptionError, SceneError
from eyeline.explanation import explain
from eyeline.explanation.board import SIZE, pictures
from eyeline.explanation.explanation import WRITERS
from eyeline.explanation.page import data_of, page
from eyeline.explanation.roles import canvas, paint
from eyeline.visibility import METHODS

SMALL = (32, 18)
ANSWERING = [name for name, method in METHODS.items() if method.answers]


@pytest.mark.parametrize("name", METHODS)
def test_every_method_explains_every_hard_case(name: str) -> None:
    for case in el.samples.HARD_CASES:
        explanation = explain(el.samples.SAMPLES[case](), name, size=SMALL)
        assert len(explanation) > 0, case
        for step in explanation:
            assert re.fullmatch(r"\S.*\S", step.sentence), step
            assert list(step.work) == list(explanation.steps[-1].work)
        assert sum(1 for _ in explanation.frames(50)) <= 50


@pytest.mark.parametrize("name", ANSWERING)
@pytest.mark.parametrize("most", [1, 7, 10**6])
def test_what_is_painted_ends_as_the_answer(name: str, most: int) -> None:
    explanation = explain(el.samples.piercing_faces(), name, size=SMALL)
    seen = canvas(explanation)
    for frame in explanation.frames(most):
        paint(seen, frame)
    assert np.array_equal(seen, METHODS[name](explanation.projected).face)


@pytest.mark.parametrize("name", ANSWERING)
def test_nothing_is_left_for_the_last_step_to_paint(name: str) -> None:
    """Whoever follows the steps sees the picture grow to its end."""
    explanation = explain(el.samples.cyclic_overlap(), name, size=SMALL)
    seen = canvas(explanation)
    for frame in list(explanation.frames(10**6))[:-1]:
        paint(seen, frame)
    assert np.array_equal(seen, explanation.steps[-1].data["face"])


def test_a_large_scene_is_made_smaller_and_says_so() -> None:
    explanation = explain(el.samples.teapot(), "zbuffer", faces=300, size=SMALL)
    assert 100 <= explanation.scene.face_count <= 300
    (notice,) = explanation.notices
    assert notice.startswith("the scene has 12,432 faces") and "vertices merged" in notice
    whole = el.samples.teapot().bounds
    np.testing.assert_allclose(explanation.scene.bounds.low, whole.low, atol=0.1 * whole.diagonal)
    assert explain(el.samples.cube(), "zbuffer", size=SMALL).notices == ()


def test_a_mirrored_surface_keeps_its_front_when_it_is_made_smaller() -> None:
    from eyeline.explanation.reduction import clustered

    ball = el.samples.sphere().nodes[0].mesh
    mirror = np.diag([-1.0, 1, 1, 1])
    (surface,) = el.Scene.of(el.Node("ball", mesh=ball, matrix=mirror)).surfaces
    small = clustered(surface, 0.2)
    a, b, c = (small.points[small.faces[:, k]].astype(float) for k in range(3))
    assert (a * np.cross(b, c)).sum() > 0


# --- files ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("suffix", WRITERS)
def test_every_kind_of_file_is_written(suffix: str, tmp_path: Path) -> None:
    explanation = explain(el.samples.cyclic_overlap(), "zbuffer", size=SMALL)
    path = explanation.save(tmp_path / f"steps{suffix}")
    assert path.stat().st_size > 1000
    assert list(tmp_path.iterdir()) == [path]


def test_the_film_has_a_frame_for_each_step_and_stays_at_its_end(tmp_path: Path) -> None:
    import av

    explanation = explain(el.samples.cyclic_overlap(), "zbuffer", size=SMALL)
    with av.open(str(explanation.save(tmp_path / "steps.mp4"))) as film:
        frames = sum(1 for _ in film.decode(video=0))
        assert (film.streams.video[0].width, film.streams.video[0].height) == SIZE
    assert frames == len(explanation) + 24


def test_the_page_is_whole_and_loads_nothing(tmp_path: Path) -> None:
    text = page(explain(el.samples.cyclic_overlap(), "zbuffer", size=SMALL))
    assert "{{" not in text
    assert re.findall(r"""(?:src|href)=["'](?!#)""", text) == []
    assert not re.search(r"https?://(?!www\.w3\.org)", text)
    assert "default-src 'none'" in text


def test_a_scene_s_name_cannot_end_the_page_s_data() -> None:
    from dataclasses import replace

    evil = replace(el.samples.cyclic_overlap(), name="</script><script>alert(1)</script>")
    text = page(explain(evil, "zbuffer", size=SMALL))
    assert text.count("</script>") == 2
    assert "<script>alert" not in text


def test_the_data_hold_every_step() -> None:
    explanation = explain(el.samples.cyclic_overlap(), "zbuffer", size=SMALL)
    data = json.loads(data_of(explanation))
    assert [frame["s"] for frame in data["frames"]] == [step.sentence for step in explanation]
    assert dict(zip(data["counters"], data["frames"][-1]["w"], strict=True)) == explanation.steps[-1].work
    seen = np.full(SMALL[0] * SMALL[1], -1)
    for frame in data["frames"]:
        for face, *runs in frame["p"]:
            for first, count in zip(runs[::2], runs[1::2], strict=True):
                seen[first : first + count] = face
    assert np.array_equal(seen, explanation.steps[-1].data["face"].reshape(-1))


def test_the_sheet_is_one_drawing_of_twelve_frames_at_most(tmp_path: Path) -> None:
    explanation = explain(el.samples.teapot(), "zbuffer", faces=60, size=SMALL)
    root = ET.parse(explanation.save(tmp_path / "steps.svg")).getroot()
    texts = [node.text for node in root.iter("{http://www.w3.org/2000/svg}text")]
    assert sum(bool(re.match(r"step \d+ of", text or "")) for text in texts) == 12


def test_the_picture_shows_the_faces_that_were_drawn() -> None:
    explanation = explain(el.samples.cyclic_overlap(), "zbuffer", size=SMALL)
    *_, last = pictures(explanation, 100)
    colours = {tuple(pixel) for pixel in last[..., :3].reshape(-1, 3).tolist()}
    shown = np.unique(explanation.steps[-1].data["face"])
    assert all(tuple(explanation.colours[face].tolist()) in colours for face in shown[shown >= 0])


# --- what is refused --------------------------------------------------------------------------------------


def test_what_cannot_be_explained_is_refused(tmp_path: Path) -> None:
    scene = el.samples.cube()
    with pytest.raises(OptionError, match=r"no method 'zbufer'.*'zbuffer'"):
        explain(scene, "zbufer")
    with pytest.raises(OptionError, match="at most 57600 pixels"):
        explain(scene, "zbuffer", size=(1920, 1080))
    with pytest.raises(OptionError, match="faces is 0"):
        explain(scene, "zbuffer", faces=0)
    with pytest.raises(SceneError, match="no camera 'left'"):
        explain(scene, "zbuffer", "left")
    with pytest.raises(FileError, match="is no explanation"):
        explain(scene, "zbuffer", size=SMALL).save(tmp_path / "steps.docx")
    assert list(tmp_path.iterdir()) == []


def test_an_empty_scene_is_explained_as_empty(tmp_path: Path) -> None:
    explanation = explain(el.Scene(), "zbuffer", size=SMALL)
    assert [step.kind for step in explanation] == ["done"]
    assert explanation.save(tmp_path / "empty.html").stat().st_size > 1000
