"""Pictures of models, decoded or refused."""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image

from eyeline.errors import FileError
from eyeline.files.limits import Allowance
from eyeline.files.pictures import decoded

DEEP = np.array([[0, 0x1234], [0x8000, 0xFFFF]], np.uint16)


def png(pixels: np.ndarray) -> bytes:
    kept = io.BytesIO()
    Image.fromarray(pixels).save(kept, "PNG")
    return kept.getvalue()


def test_deep_greys_keep_their_high_bits() -> None:
    pixels = decoded(png(DEEP), "it", ("PNG",), Allowance("pixels", 4, 0))
    assert pixels.dtype == np.uint8
    assert (pixels[..., 0] == DEEP >> 8).all()
    assert (pixels[..., 3] == 255).all()


def test_pixels_are_paid_for() -> None:
    with pytest.raises(FileError, match="it claims 4 pixels, and the file's real size backs 3 more"):
        decoded(png(DEEP), "it", ("PNG",), Allowance("pixels", 3, 0))


@pytest.mark.parametrize("data", [b"", b"GIF89a", png(DEEP)[:40]])
def test_what_is_no_picture_is_refused_by_its_formats(data: bytes) -> None:
    with pytest.raises(FileError, match=r"it is no PNG, JPEG or WebP image that can be read \(\w+\); save"):
        decoded(data, "it", ("PNG", "JPEG", "WebP"), Allowance("pixels", 4, 0))
