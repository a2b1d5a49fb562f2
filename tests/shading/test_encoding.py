"""sRGB: what goes in as 8 bits comes out as the same 8 bits, under every threshold of the dither."""

from __future__ import annotations

import numpy as np
import pytest

from eyeline.scene.colour import linear_from_srgb, srgb_from_linear
from eyeline.shading.encoding import DECODED, DITHER, ENCODED, encoded


def test_every_colour_survives_the_round_trip_under_every_threshold():
    for threshold in DITHER:
        assert [encoded(light, threshold, ENCODED) for light in DECODED[:256]] == list(range(256))


def test_the_published_curve_is_met():
    # Values from IEC 61966-2-1
    for shown, light in ((0.0, 0.0), (0.04045, 0.0031308), (0.5, 0.21404114), (1.0, 1.0)):
        assert linear_from_srgb(np.array(shown)) == pytest.approx(light, abs=1e-6)
        assert srgb_from_linear(np.array(light)) == pytest.approx(shown, abs=1e-6)


def test_the_dither_keeps_the_mean_of_what_lies_between_two_steps():
    light = np.float32(linear_from_srgb(np.array(100.5 / 255)))
    shown = np.array([encoded(light, threshold, ENCODED) for threshold in DITHER], float)
    assert abs(shown.mean() - 100.5) < 0.1


def test_light_beyond_the_screen_is_clipped():
    assert encoded(np.float32(7), DITHER[0], ENCODED) == 255
    assert encoded(np.float32(-1), DITHER[0], ENCODED) == 0
