"""Drawings as files: what is in them, and the same bytes each time."""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as Tree
import zlib
from pathlib import Path

import numpy as np
import pytest

import eyeline as el
from eyeline.drawing.pens import VISIBLE
from eyeline.drawing.sheet import plain
from eyeline.errors import FileError, OptionError

SVG = "{http://www.w3.org/2000/svg}"
SMALL = (320, 180)
PROGRAM = """
import hashlib
import eyeline as el
for name in ("demo_shot", "torus"):
    scene = el.samples.SAMPLES[name]()
    drawing = el.draw(scene, time=1.6, size=(640, 360), hidden="dashed", edges=("outline", "crease", "mesh"))
    print(hashlib.sha256(drawing._repr_svg_().encode()).hexdigest())
"""


def parsed(drawing: el.Drawing) -> Tree.Element:
    return Tree.fromstring(drawing._repr_svg_())


def places(d: str) -> np.ndarray:
    """(K, 2) the corners in the `d` of a path."""
    return np.array([pair.split(",") for pair in re.findall(r"[\d.]+,[\d.]+", d)], dtype=float)


# --- SVG --------------------------------------------------------------------------------------------------


def test_svg_has_a_group_for_each_node_with_its_path() -> None:
    scene = el.samples.teapot()
    root = parsed(el.draw(scene, size=SMALL))
    assert (root.get("width"), root.get("height"), root.get("viewBox")) == ("320", "180", "0 0 320 180")
    nodes = root.findall(f"{SVG}g")
    assert {group.get("id") for group in nodes} == set(scene.paths)
    for group in nodes:
        title = group.find(f"{SVG}title")
        assert title is not None and title.text == group.get("id")
        assert {kind.get("class") for kind in group.findall(f"{SVG}g")} <= set(VISIBLE)


def test_svg_draws_within_the_picture() -> None:
    for path in parsed(el.draw(el.samples.desk_lamp(), size=SMALL)).iter(f"{SVG}path"):
        corners = places(path.get("d") or "")
        assert len(corners) >= 2
        assert (corners >= 0).all() and (corners <= SMALL).all()


def test_names_of_nodes_may_hold_anything() -> None:
    cube = el.samples.cube().surfaces[0].mesh
    names = ["<a> & 'b' \"c\"", "two words", "two_words", "bell\x07", "лампа", "\ud800"]
    nodes = [el.Node(name, mesh=cube, translation=(k, 0, 0)) for k, name in enumerate(names)]
    root = parsed(el.draw(el.Scene.of(*nodes), size=SMALL))
    ids = [group.get("id") for group in root.findall(f"{SVG}g")]
    assert len(set(ids)) == len(names)
    assert not any(re.search(r"\s", name or "") for name in ids)
    titles = [group.findtext(f"{SVG}title") for group in root.findall(f"{SVG}g")]
    assert titles == ["<a> & 'b' \"c\"", "two words", "two_words", "bell\ufffd", "лампа", "\ufffd"]


def test_outlines_are_heavier_than_creases_and_lines_grow_with_the_picture() -> None:
    def widths(size: tuple[int, int]) -> dict[str, float]:
        kinds = parsed(el.draw(el.samples.cube(), size=size)).iter(f"{SVG}g")
        return {
            kind.get("class") or "": float(kind.get("stroke-width") or 0)
            for kind in kinds if kind.get("class")
        }  # fmt: skip

    small, large = widths((640, 360)), widths((1280, 720))
    assert small["outline"] > 1.5 * small["crease"]
    assert large["outline"] == pytest.approx(2 * small["outline"], abs=0.01)


def test_hidden_lines_are_dashed_and_only_if_asked_for() -> None:
    def dashes(hidden: str) -> list[str]:
        root = parsed(el.draw(el.samples.cube(), size=SMALL, hidden=hidden))
        return [kind.get("class") or "" for kind in root.iter() if kind.get("stroke-dasharray")]

    assert dashes("omit") == []
    assert dashes("dashed") == ["hidden crease"]


def test_files_are_small() -> None:
    """A drawing holds its lines, not its faces."""
    scene = el.samples.torus()
    assert len(el.draw(scene)._repr_svg_()) < 4000
    every = el.draw(scene, edges=("outline", "mesh"))
    assert len(every._repr_svg_()) < 24 * scene.face_count


def test_a_path_keeps_no_point_that_says_nothing() -> None:
    path = np.array([(0, 0), (0, 0), (2, 2), (4, 4), (4, 4), (4, 8), (4, 6), (4, 6)])
    assert plain(path).tolist() == [[0, 0], [4, 4], [4, 8], [4, 6]]


def test_short_creases_on_a_bare_surface_are_noise() -> None:
    """A roof whose ridge ends in the slope of a large sheet, seen small and seen large."""
    n = 9
    row, column = (one.reshape(-1) for one in np.mgrid[:n, :n])
    ridge = (row == 4) & (column > 2) & (column < 6)
    points = np.stack([column, row, 0.8 * ridge], axis=-1)
    at = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).reshape(-1)
    faces = np.concatenate([np.stack([at, at + 1, at + n + 1], 1), np.stack([at, at + n + 1, at + n], 1)])
    scene = el.Scene.of(el.Mesh(points, faces))

    def creases(height: float) -> int:
        camera = el.Camera.look_at((4, 4, 9), (4, 4, 0), height=height)
        drawing = el.draw(scene, camera, size=(720, 720), crease=0.9)
        return sum(group.kind == "crease" for group in drawing.sheet.groups)

    assert creases(20) == 1
    assert creases(2000) == 0


# --- other formats ----------------------------------------------------------------------------------------


def test_pdf_is_one_page_of_three_quarters_of_a_point_a_pixel(tmp_path: Path) -> None:
    file = el.draw(el.samples.cube(), size=SMALL).save(tmp_path / "cube.pdf").read_bytes()
    assert file.startswith(b"%PDF-")
    assert re.search(rb"/MediaBox \[0 0 240.00 135.00\]", file)
    content = b"".join(
        zlib.decompress(stream) for stream in re.findall(rb"stream\n(.*?)\nendstream", file, re.DOTALL)
    )
    assert len(re.findall(rb"\b[\d.]+ [\d.]+ l\b", content)) == 5 + 3  # the outline closes by itself
    assert b"/LC 1" in file and b"/LJ 1" in file  # round ends, round joints


def test_dxf_has_a_layer_for_each_kind(tmp_path: Path) -> None:
    import ezdxf

    drawing = el.draw(el.samples.cube(), size=SMALL, hidden="dashed")
    document = ezdxf.readfile(drawing.save(tmp_path / "cube.dxf"))
    assert not document.audit().has_errors
    assert {"outline", "crease", "hidden crease"} <= {layer.dxf.name for layer in document.layers}
    lines = list(document.modelspace())
    assert len(lines) == sum(len(group.paths) for group in drawing.sheet.groups)
    assert {line.dxf.layer for line in lines} == {"outline", "crease", "hidden crease"}


def test_an_orthographic_dxf_is_true_to_scale(tmp_path: Path) -> None:
    import ezdxf

    board = el.Mesh([(0, 0, 0), (3, 0, 0), (3, 2, 0), (0, 2, 0)], [(0, 1, 2), (0, 2, 3)])
    camera = el.Camera.look_at((1.5, 1, 5), (1.5, 1, 0), height=4)
    document = ezdxf.readfile(el.draw(el.Scene.of(board), camera).save(tmp_path / "board.dxf"))
    assert document.header["$INSUNITS"] == 6
    (line,) = document.modelspace()
    corners = np.array([point[:2] for point in line.get_points()])
    assert np.ptp(corners, axis=0) == pytest.approx((3, 2), abs=1e-4)


@pytest.mark.parametrize(("suffix", "library"), [(".pdf", "fpdf"), (".dxf", "ezdxf")])
def test_a_missing_library_is_refused_with_the_extra_that_has_it(
    suffix: str, library: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, library, None)
    drawing = el.draw(el.samples.cube(), size=SMALL)
    with pytest.raises(OptionError, match=r"pip install eyeline\[draw\]$"):
        drawing.save(tmp_path / f"cube{suffix}")
    drawing.save(tmp_path / "cube.svg")
    assert [path.name for path in tmp_path.iterdir()] == ["cube.svg"]


def test_an_unknown_suffix_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"use \.svg, \.pdf, \.dxf"):
        el.draw(el.samples.cube(), size=SMALL).save(tmp_path / "cube.png")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("suffix", [".svg", ".pdf", ".dxf"])
def test_a_file_is_the_same_bytes_each_time(suffix: str, tmp_path: Path) -> None:
    files = [
        el.draw(el.samples.teapot(), size=SMALL, hidden="dashed").save(tmp_path / f"{k}{suffix}")
        for k in range(2)
    ]
    assert files[0].read_bytes() == files[1].read_bytes()


def test_threads_do_not_change_a_byte() -> None:
    def printed(threads: str) -> str:
        run = [sys.executable, "-c", PROGRAM]
        source = str(Path(el.__file__).parent.parent)
        settings = os.environ | {"EYELINE_THREADS": threads, "PYTHONPATH": source}
        done = subprocess.run(run, env=settings, capture_output=True, text=True, check=True, timeout=180)
        return done.stdout

    assert printed("1") == printed("2") != ""


# --- what cannot be drawn ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"hidden": "dotted"}, "hidden is 'dotted'"),
        ({"edges": ("outlines",)}, "'outlines'"),
        ({"edges": ()}, "edges is empty"),
        ({"crease": -0.1}, "crease is -0.1"),
        ({"crease": float("nan")}, "crease is nan"),
        ({"size": (0, 10)}, "width is 0"),
        ({"size": (10, 99999)}, "height is 99999"),
    ],
)
def test_an_option_that_cannot_be_used_is_refused(options: dict, sentence: str) -> None:
    with pytest.raises(OptionError, match=re.escape(sentence)):
        el.draw(el.samples.cube(), **options)


def test_scenes_of_nothing_and_of_slivers_are_drawn() -> None:
    degenerate = el.Mesh([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2), (0, 0, 1), (1, 1, 1)])
    for scene in (el.Scene(), el.Scene.of(degenerate), el.Scene.of(el.Mesh(np.empty((0, 3)), []))):
        root = parsed(el.draw(scene, el.Camera.look_at((0, 1, 5), (0, 0, 0)), size=SMALL))
        assert len(list(root.iter(f"{SVG}path"))) <= 3


def test_a_drawing_of_twenty_thousand_times_one_face_ends() -> None:
    faces = np.tile([(0, 1, 2)], (20000, 1))
    scene = el.Scene.of(el.Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces))
    root = parsed(el.draw(scene, el.Camera.look_at((0.3, 0.3, 3), (0.3, 0.3, 0)), size=SMALL))
    (path,) = root.iter(f"{SVG}path")
    assert (path.get("d") or "").endswith("Z")


def test_svg_reads_as_text_in_a_notebook() -> None:
    drawing = el.draw(el.samples.cube(), size=SMALL)
    assert drawing.size == SMALL
    assert io.StringIO(drawing._repr_svg_()).readline().startswith("<?xml")
