"""Pictures over pictures, as clear sheets lie on each other. [Porter84]"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from eyeline.geometry.arrays import ByteArray, FloatArray

LIGHTNESS = np.array([0.2126, 0.7152, 0.0722], np.float32)


def stacked(pictures: Iterable[ByteArray], size: tuple[int, int]) -> ByteArray:
    """(H, W, 4) uint8 of pictures of a size (width, height), from back to front; clear where there are none.

    Display values are mixed, as drawing programs do, so that drawings look as they did there.
    """
    sheet: ByteArray | None = None
    for picture in pictures:
        sheet = picture if sheet is None else over(picture, sheet)
    return np.zeros((size[1], size[0], 4), np.uint8) if sheet is None else sheet


def over(front: ByteArray, back: ByteArray) -> ByteArray:
    """One picture over another."""
    alpha = front[..., 3]
    if not alpha.any():
        return back
    if (alpha == 255).all():
        return front
    result = back.copy()
    rows, columns = np.nonzero(alpha)
    top, low = front[rows, columns].astype(np.float32), back[rows, columns].astype(np.float32)
    share, under = top[:, 3:] / 255, low[:, 3:] / 255
    whole = share + under * (1 - share)
    result[rows, columns, :3] = (top[:, :3] * share + low[:, :3] * under * (1 - share)) / whole + 0.5
    result[rows, columns, 3] = 255 * whole[:, 0] + 0.5
    return result


def tinted(picture: ByteArray, colour: FloatArray | tuple[float, float, float], strength: float) -> ByteArray:
    """The drawing's darks in one colour (sRGB, 0..1), its lights white, and as clear as strength says."""
    light = picture[..., :3].astype(np.float32) @ LIGHTNESS / 255
    tint = np.asarray(colour, np.float32)
    result = np.empty_like(picture)
    result[..., :3] = 255 * (tint + (1 - tint) * light[..., None] * 0.6) + 0.5
    result[..., 3] = picture[..., 3] * strength + 0.5
    return result
