"""Colours between colours: in linear light, as lights mix, or in OKLab and OKLCH, as eyes compare them.

Colours are linear, Rec. 709 primaries, unless a name says otherwise. (..., 3) arrays in and out.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from eyeline.errors import OptionError
from eyeline.geometry.arrays import FloatArray

# From linear light to the responses of long, middle and short cones, and from their cube roots to OKLab
CONES = np.array(
    [
        (0.4122214708, 0.5363325363, 0.0514459929),
        (0.2119034982, 0.6806995451, 0.1073969566),
        (0.0883024619, 0.2817188376, 0.6299787005),
    ]
)  # [Ottosson20]
OPPONENTS = np.array(
    [
        (0.2104542553, 0.7936177850, -0.0040720468),
        (1.9779984951, -2.4285922050, 0.4505937099),
        (0.0259040371, 0.7827717662, -0.8086757660),
    ]
)  # [Ottosson20]
CONES_BACK, OPPONENTS_BACK = np.linalg.inv(CONES), np.linalg.inv(OPPONENTS)
GREY = 1e-4  # chroma below which a colour has no hue: a tenth of what can be told from grey


def srgb_from_linear(linear: FloatArray) -> FloatArray:
    """Display values 0..1 of linear light 0..1. [IEC 61966-2-1]"""
    return np.where(
        linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 0.0031308) ** (1 / 2.4) - 0.055
    )


def linear_from_srgb(shown: FloatArray) -> FloatArray:
    """Linear light 0..1 of display values 0..1."""
    return np.where(shown <= 0.04045, shown / 12.92, ((np.maximum(shown, 0.04045) + 0.055) / 1.055) ** 2.4)


def oklab_from_linear(linear: npt.ArrayLike) -> FloatArray:
    """Lightness 0..1, green to red, blue to yellow. [Ottosson20]"""
    lab: FloatArray = np.cbrt(np.asarray(linear, np.float64) @ CONES.T) @ OPPONENTS.T
    return lab


def linear_from_oklab(lab: npt.ArrayLike) -> FloatArray:
    """Linear light; outside 0..1 where no display shows the colour."""
    linear: FloatArray = (np.asarray(lab, np.float64) @ OPPONENTS_BACK.T) ** 3 @ CONES_BACK.T
    return linear


def oklch_from_linear(linear: npt.ArrayLike) -> FloatArray:
    """Lightness 0..1, chroma, and hue in radians: OKLab in polar coordinates. [Ottosson20]"""
    lightness, a, b = np.moveaxis(oklab_from_linear(linear), -1, 0)
    return np.stack([lightness, np.hypot(a, b), np.arctan2(b, a)], axis=-1)


def linear_from_oklch(lch: npt.ArrayLike) -> FloatArray:
    """Linear light; outside 0..1 where no display shows the colour."""
    lightness, chroma, hue = np.moveaxis(np.asarray(lch, np.float64), -1, 0)
    return linear_from_oklab(np.stack([lightness, chroma * np.cos(hue), chroma * np.sin(hue)], axis=-1))


def between_in_light(start: FloatArray, end: FloatArray, part: FloatArray) -> FloatArray:
    """As light mixes: the mean of red and green is a dark yellow."""
    return start + part * (end - start)


def between_in_oklab(start: FloatArray, end: FloatArray, part: FloatArray) -> FloatArray:
    """Straight through what eyes see as even steps; opposite hues pass through grey."""
    lab, other = oklab_from_linear(start), oklab_from_linear(end)
    return np.maximum(linear_from_oklab(lab + part * (other - lab)), 0)


def between_in_oklch(start: FloatArray, end: FloatArray, part: FloatArray) -> FloatArray:
    """Around the circle of hues, the shorter way; the vividness stays. A grey takes the other's hue."""
    lch, other = np.broadcast_arrays(oklch_from_linear(start), oklch_from_linear(end))
    hue = np.where(lch[..., 1] < GREY, other[..., 2], lch[..., 2])
    turn = np.where(other[..., 1] < GREY, hue, other[..., 2]) - hue
    turn -= 2 * np.pi * np.round(turn / (2 * np.pi))
    straight = lch + part * (other - lch)
    return np.maximum(
        linear_from_oklch(np.concatenate([straight[..., :2], hue[..., None] + part * turn[..., None]], -1)), 0
    )


MIXES: dict[str, Callable[[FloatArray, FloatArray, FloatArray], FloatArray]] = {
    "linear": between_in_light,
    "oklab": between_in_oklab,
    "oklch": between_in_oklch,
}


def mix(start: npt.ArrayLike, end: npt.ArrayLike, part: npt.ArrayLike, space: str = "oklab") -> FloatArray:
    """(..., 3) the colours at parts (...) of the way from start (3,) to end (3,); 0 and 1 are exactly they.

    space: "linear" mixes light, "oklab" takes even steps for the eye, "oklch" goes around the circle of hues.
    What no display can show is cut at 0.
    """
    if space not in MIXES:
        raise OptionError(f"space is {space!r}; there is {', '.join(MIXES)}")
    begin, finish = np.asarray(start, np.float64), np.asarray(end, np.float64)
    if begin.shape[-1:] != (3,) or finish.shape[-1:] != (3,):
        raise OptionError(
            f"colours have shapes {begin.shape} and {finish.shape}; red, green and blue are needed"
        )
    parts = np.asarray(part, np.float64)[..., None]
    mixed = MIXES[space](begin, finish, parts)
    return np.where(parts == 0, begin, np.where(parts == 1, finish, mixed))
