from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import PIL.Image
import pytest

import eyeline as el
from eyeline.errors import EyelineError
from eyeline.files import png


def noise(height: int = 12, width: int = 20, opaque: bool = True) -> np.ndarray:
    pixels = np.random.default_rng(7).integers(0, 256, (height, width, 4), np.uint8)
    if opaque:
        pixels[..., 3] = 255
    return pixels


@pytest.mark.parametrize("opaque", [True, False])
def test_png_gives_back_every_pixel(tmp_path: Path, opaque: bool) -> None:
    pixels = noise(opaque=opaque)
    el.Image(pixels).save(tmp_path / "a.png")
    with PIL.Image.open(tmp_path / "a.png") as picture:
        assert picture.mode == ("RGB" if opaque else "RGBA")
        assert np.array_equal(np.asarray(picture.convert("RGBA")), pixels)


def test_a_png_of_many_bands_is_whole_and_the_same_for_every_count_of_threads(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    pixels = noise(height=1200, width=301)
    files = []
    for count in (1, 2):
        monkeypatch.setattr(png, "threads", lambda count=count: count)
        files.append(png.png_of(pixels))
    assert files[0] == files[1]
    with PIL.Image.open(io.BytesIO(files[0])) as picture:
        picture.verify()
    with PIL.Image.open(io.BytesIO(files[0])) as picture:
        assert np.array_equal(np.asarray(picture), pixels)


@pytest.mark.parametrize(("suffix", "kind"), [(".jpg", "JPEG"), (".JPEG", "JPEG"), (".webp", "WEBP")])
def test_the_suffix_decides_the_kind(tmp_path: Path, suffix: str, kind: str) -> None:
    path = el.Image(noise()).save(tmp_path / f"a{suffix}")
    with PIL.Image.open(path) as picture:
        assert (picture.format, picture.size) == (kind, (20, 12))


def test_a_notebook_shows_the_same_pixels() -> None:
    pixels = noise(opaque=False)
    with PIL.Image.open(io.BytesIO(el.Image(pixels)._repr_png_())) as picture:
        assert np.array_equal(np.asarray(picture), pixels)


@pytest.mark.parametrize(
    ("name", "word"),
    [("a.bmp", "use .png"), ("a", "no suffix"), ("none/a.png", "no folder"), ("folder.png", "is a folder")],
)
def test_a_place_that_cannot_hold_a_picture_is_refused(tmp_path: Path, name: str, word: str) -> None:
    (tmp_path / "folder.png").mkdir()
    with pytest.raises(EyelineError, match=word):
        el.Image(noise()).save(tmp_path / name)
    assert [path.name for path in tmp_path.iterdir()] == ["folder.png"]


@pytest.mark.parametrize(
    "pixels", [np.zeros((2, 2, 3), np.uint8), np.zeros((2, 2, 4)), np.zeros((0, 2, 4), np.uint8)]
)
def test_what_is_not_rgba_is_refused(pixels: np.ndarray) -> None:
    with pytest.raises(EyelineError, match="is needed"):
        el.Image(pixels)


def test_what_knows_no_transparency_is_put_on_white(tmp_path: Path) -> None:
    pixels = np.zeros((16, 16, 4), np.uint8)
    pixels[:, 8:] = (10, 20, 30, 255)
    path = el.Image(pixels).save(tmp_path / "a.jpg")
    with PIL.Image.open(path) as picture:
        shown = np.asarray(picture).astype(int)
    assert np.abs(shown[:, :8] - 255).max() <= 3
    assert np.abs(shown[:, 8:] - (10, 20, 30)).max() <= 3
