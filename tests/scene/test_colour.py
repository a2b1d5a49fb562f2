"""Colours between colours."""

from __future__ import annotations

import numpy as np
import pytest

from eyeline.errors import OptionError
from eyeline.scene import colour

RED, GREEN, BLUE, GREY = (1.0, 0, 0), (0, 1.0, 0), (0, 0, 1.0), (0.2, 0.2, 0.2)


def test_oklab_is_ottossons() -> None:
    """The figures of his page, and the primaries as CSS Color 4 gives them."""
    np.testing.assert_allclose(colour.oklab_from_linear((1, 1, 1)), (1, 0, 0), atol=1e-6)
    np.testing.assert_allclose(colour.oklab_from_linear(RED), (0.62796, 0.22486, 0.12585), atol=1e-4)
    lightness, chroma, hue = colour.oklch_from_linear(BLUE)
    np.testing.assert_allclose(
        (lightness, chroma, np.degrees(hue) % 360), (0.45201, 0.31321, 264.052), rtol=1e-3
    )


@pytest.mark.parametrize("space", colour.MIXES)
def test_the_ends_are_exactly_the_colours(space: str) -> None:
    mixed = colour.mix(RED, BLUE, [0, 0.5, 1], space)
    np.testing.assert_array_equal(mixed[[0, 2]], [RED, BLUE])


def test_there_and_back_is_the_same_colour() -> None:
    colours = np.random.default_rng(1).random((100, 3))
    np.testing.assert_allclose(
        colour.linear_from_oklab(colour.oklab_from_linear(colours)), colours, atol=1e-12
    )
    np.testing.assert_allclose(
        colour.linear_from_oklch(colour.oklch_from_linear(colours)), colours, atol=1e-12
    )
    np.testing.assert_allclose(colour.linear_from_srgb(colour.srgb_from_linear(colours)), colours, atol=1e-4)


def test_light_mixes_in_the_middle() -> None:
    np.testing.assert_allclose(colour.mix(RED, GREEN, 0.5, "linear"), (0.5, 0.5, 0))


def test_even_steps_of_grey_are_even_to_the_eye() -> None:
    lightness = colour.oklab_from_linear(colour.mix((0, 0, 0), (1, 1, 1), np.linspace(0, 1, 5)))[:, 0]
    np.testing.assert_allclose(np.diff(lightness), 0.25, atol=1e-6)


def test_hues_go_the_shorter_way_round() -> None:
    """From 350 to 10 degrees is through 0."""
    ends = colour.linear_from_oklch(np.array([(0.6, 0.1, np.radians(350)), (0.6, 0.1, np.radians(10))]))
    lightness, chroma, hue = colour.oklch_from_linear(colour.mix(ends[0], ends[1], 0.5, "oklch"))
    np.testing.assert_allclose((lightness, chroma, hue), (0.6, 0.1, 0), atol=1e-6)


def test_grey_takes_the_hue_of_the_other() -> None:
    hues = colour.oklch_from_linear(colour.mix(GREY, RED, np.array([0.3, 0.6, 1.0]), "oklch"))[:, 2]
    np.testing.assert_allclose(hues, colour.oklch_from_linear(RED)[2], atol=1e-6)


def test_spaces_and_shapes_that_are_not_there_are_refused() -> None:
    with pytest.raises(OptionError, match="space is 'hsv'; there is linear, oklab, oklch"):
        colour.mix(RED, BLUE, 0.5, "hsv")
    with pytest.raises(OptionError, match="red, green and blue are needed"):
        colour.mix((1, 0), (0, 1), 0.5)
