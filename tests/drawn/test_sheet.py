"""Drawn films: layers over each other and over rendered frames, onion skins, and what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import PIL.Image
import pytest

import eyeline as el
from eyeline import drawn
from eyeline.drawn.stack import over, stacked
from eyeline.errors import FileError, OptionError

SIZE = (32, 16)
RED, BLUE = (255, 0, 0, 255), (0, 0, 255, 255)


def block(x: float, fill: str = "#ff0000", width: float = 8) -> str:
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" width="32" height="16">'
        f'<rect id="block" x="{x:g}" y="4" width="{width:g}" height="8" fill="{fill}"/></svg>'
    )


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "a.svg").write_text(block(0))
    (tmp_path / "b.svg").write_text(block(16))
    paper = np.full((16, 32, 4), BLUE, np.uint8)
    PIL.Image.fromarray(paper).save(tmp_path / "paper.png")
    return tmp_path


def sheet(folder: Path, text: str, name: str = "walk.csv", **options: object) -> el.ExposureSheet:
    (folder / name).write_text(text)
    return el.exposure_sheet(folder / name, **options)


def red_columns(image: el.Image) -> list[int]:
    return np.flatnonzero((image.pixels[8] == RED).all(axis=1)).tolist()


def test_layers_lie_over_each_other(folder: Path) -> None:
    film = sheet(folder, "sky,block\npaper,a\n,b\n")
    assert (len(film), film.size, film.fps) == (2, SIZE, 24)
    assert red_columns(film[0]) == list(range(8))
    assert red_columns(film[1]) == list(range(16, 24))
    assert film[0].is_opaque and tuple(film[0].pixels[0, 0]) == BLUE


def test_in_betweens_are_made(folder: Path) -> None:
    film = sheet(folder, "block\na\ninbetween\nb\n", on=2)
    assert [red_columns(image)[0] for image in film] == [0, 0, 8, 8, 16, 16]


def test_where_nothing_is_exposed_the_film_is_clear(folder: Path) -> None:
    film = sheet(folder, "block\na\nx\n")
    assert not film[1].pixels.any()


def test_frames_may_be_asked_for_in_any_order(folder: Path) -> None:
    text = "sky,block\npaper,a\n,inbetween\n,b\n,repeat 1-3\n,\n"
    forth = [image.pixels.tobytes() for image in sheet(folder, text)]
    back = sheet(folder, text)
    assert forth == [back[number].pixels.tobytes() for number in (4, 3, 2, 1, 0)][::-1]
    assert forth[0] == forth[3] != forth[1] == forth[4]


def test_drawings_lie_over_and_under_rendered_frames(folder: Path) -> None:
    """A film of one frame holds; what is clear of it lets the drawings through."""
    whole = el.Image(np.full((16, 32, 4), (9, 9, 9, 255), np.uint8))
    clear = np.zeros((16, 32, 4), np.uint8)
    clear[:, 4:] = (0, 255, 0, 255)
    film = sheet(folder, "block\na\n\n", under=[whole], over=[el.Image(clear)])
    for image in film:
        assert red_columns(image) == [0, 1, 2, 3]
        assert image.pixels[0, 0].tolist() == [9, 9, 9, 255]
        assert image.pixels[8, 20].tolist() == [0, 255, 0, 255]


def test_it_lies_over_a_rendered_film(folder: Path) -> None:
    stage = el.film(el.samples.bouncing_ball(), fps=24, end=0.1, size=SIZE, samples=1)
    film = sheet(folder, "block\na\nb\n", under=stage)
    assert red_columns(film[0]) == list(range(8))
    np.testing.assert_array_equal(film[0].pixels[:, 9:], stage[0].pixels[:, 9:])


def test_it_is_saved_as_a_film(folder: Path) -> None:
    film = sheet(folder, "sky,block\npaper,a\n,b\n")
    steps: list[tuple[int, int]] = []
    film.save(folder / "out.gif", progress=lambda done, of: steps.append((done, of)))
    with PIL.Image.open(folder / "out.gif") as saved:
        assert (saved.n_frames, saved.size) == (2, SIZE)
    assert steps == [(1, 2), (2, 2)]


def test_onion_skins_show_what_was_and_what_comes(folder: Path) -> None:
    film = sheet(folder, "block\na\n\ninbetween\n\nb\n")
    skin = film.onion(2, before=1, after=1).pixels[8].astype(int)
    assert tuple(skin[8]) == RED
    assert skin[2, 0] > skin[2, 2] and skin[22, 2] > skin[22, 0]
    assert tuple(skin[30]) == (255, 255, 255, 255)
    with pytest.raises(OptionError, match="there is no layer 'hat'; there is block"):
        film.onion(0, layer="hat")


def test_a_small_drawing_is_fitted_into_the_middle(folder: Path) -> None:
    film = sheet(folder, "sky\npaper\n", size=(64, 64))
    assert film[0].pixels[15, 5, 3] == 0 and film[0].pixels[32, 5].tolist() == list(BLUE)


REFUSED = {
    "s\n../a\n": "drawing '../a' is not in the folder of the sheet",
    "s\n/etc/passwd\n": "is not in the folder of the sheet",
    "s\nmissing\n": "there is no drawing 'missing' beside the sheet",
    "s\nwalk.csv\n": "there is no drawing 'walk.csv'",
    "s\na\ninbetween\npaper\n": "paper.png: is not SVG, and in-betweens are made of outlines",
    "s\nx\n": "shows no drawing in any frame",
    "s\nevil\n": "evil.svg: line 1: holds <script>",
    "s\nbroken\n": "broken.png: the drawing is no ",
}


@pytest.mark.parametrize("text", REFUSED)
def test_what_cannot_be_shown_is_refused_with_the_files_name(folder: Path, text: str) -> None:
    (folder / "evil.svg").write_text(block(0).replace("<rect", "<script/><rect"))
    (folder / "broken.png").write_bytes(b"\x89PNG\r\n")
    with pytest.raises(FileError, match=REFUSED[text]):
        [*sheet(folder, text)]


def test_a_drawing_linked_to_elsewhere_is_refused(
    folder: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    outside = tmp_path_factory.mktemp("outside") / "c.svg"
    outside.write_text(block(0))
    (folder / "c.svg").symlink_to(outside)
    with pytest.raises(FileError, match="there is no drawing 'c' beside the sheet"):
        sheet(folder, "s\nc\n")


def test_options_that_make_no_film_are_refused(folder: Path) -> None:
    with pytest.raises(OptionError, match="on is 0"):
        sheet(folder, "s\na\n", on=0)
    with pytest.raises(FileError, match="width is 0 pixels"):
        sheet(folder, "s\na\n", size=(0, 5))
    with pytest.raises(FileError, match=r"the suffix '.txt' is no sheet; use .csv, .yaml, .yml"):
        sheet(folder, "s\na\n", name="walk.txt")
    with pytest.raises(FileError, match="No such file"):
        el.exposure_sheet(folder / "none.csv")
    with pytest.raises(FileError, match="the film has 8x8 pixels and the drawings 32x16"):
        sheet(folder, "s\na\n", size=SIZE, under=[el.Image(np.zeros((8, 8, 4), np.uint8))])


def test_one_drawing_can_be_had_by_itself(folder: Path) -> None:
    half = drawn.cel(folder / "a.svg").inbetween(drawn.cel(folder / "b.svg")).at(0.5)
    assert red_columns(drawn.picture(half)) == list(range(8, 16))
    assert drawn.picture(half, (64, 32)).size == (64, 32)


def test_over_is_porter_and_duffs() -> None:
    front = np.array([[[200, 0, 0, 128], [1, 2, 3, 0], [5, 5, 5, 255]]], np.uint8)
    back = np.array([[[0, 0, 200, 255], [0, 0, 200, 128], [0, 0, 200, 255]]], np.uint8)
    assert over(front, back)[0].tolist() == [[100, 0, 100, 255], [0, 0, 200, 128], [5, 5, 5, 255]]
    assert stacked([], (3, 2)).shape == (2, 3, 4)
