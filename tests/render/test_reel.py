"""Pictures in a row as a film."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import PIL.Image
import pytest

import eyeline as el
from eyeline.errors import OptionError


def picture(shade: int, size: tuple[int, int] = (16, 8)) -> el.Image:
    return el.Image(np.full((size[1], size[0], 4), (shade, shade, shade, 255), np.uint8))


def test_a_reel_shows_its_pictures_in_order(tmp_path: Path) -> None:
    reel = el.Reel([picture(shade) for shade in (0, 100, 200)], fps=12)
    assert len(reel) == 3 and [image.pixels[0, 0, 0] for image in reel] == [0, 100, 200]
    reel.save(tmp_path / "reel")
    for number, shade in enumerate((0, 100, 200)):
        with PIL.Image.open(tmp_path / "reel" / f"frame_{number:05d}.png") as saved:
            assert saved.getpixel((3, 3))[:3] == (shade, shade, shade)


def test_a_reel_of_nothing_or_of_several_sizes_is_refused(tmp_path: Path) -> None:
    with pytest.raises(OptionError, match="a reel of no pictures"):
        el.Reel([])
    with pytest.raises(OptionError, match="fps is 0"):
        el.Reel([picture(0)], fps=0)
    with pytest.raises(OptionError, match="picture 1 has 8x8 pixels and the first 16x8"):
        el.Reel([picture(0), picture(0, (8, 8))]).save(tmp_path / "out.gif")
    assert not (tmp_path / "out.gif").exists()
