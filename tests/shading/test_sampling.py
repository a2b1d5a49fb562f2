"""Textures: wrapping, filtering, mip levels, each against the number on paper."""

from __future__ import annotations

import numpy as np
import pytest

from eyeline.scene.colour import linear_from_srgb
from eyeline.scene.texture import Texture
from eyeline.shading.encoding import DECODED
from eyeline.shading.sampling import footprint_level, sampled, wrapped
from eyeline.shading.texture_table import CLAMP, MIRROR, REPEAT, Textures, mipmaps, textures_of


def table(pixels: np.ndarray, srgb: bool = False, **sampler: object) -> Textures:
    return textures_of([(Texture(pixels, **sampler), srgb)])  # type: ignore[arg-type]


def look_up(textures: Textures, u: float, v: float, level: float = 0.0) -> np.ndarray:
    return np.array(sampled(textures.images, textures.texels, DECODED, 0, u, v, level))


def ramp() -> np.ndarray:
    """Red 0, 100, 200, 250 along u; green 0, 80 along v."""
    pixels = np.zeros((2, 4, 4), np.uint8)
    pixels[..., 0] = [0, 100, 200, 250]
    pixels[1, :, 1] = 80
    pixels[..., 3] = 255
    return pixels


@pytest.mark.parametrize(
    ("wrap", "expected"),
    [
        (REPEAT, [1, 2, 3, 0, 1, 2, 3, 0, 1, 2]),
        (MIRROR, [2, 1, 0, 0, 1, 2, 3, 3, 2, 1]),
        (CLAMP, [0, 0, 0, 0, 1, 2, 3, 3, 3, 3]),
    ],
)
def test_an_image_goes_on_beyond_its_border(wrap, expected):
    assert [wrapped(index, 4, wrap) for index in range(-3, 7)] == expected


def test_texel_centres_show_their_texel_and_half_way_the_mean():
    textures = table(ramp())
    assert look_up(textures, 0.375, 0.25)[0] == pytest.approx(100 / 255)
    assert look_up(textures, 0.5, 0.25)[0] == pytest.approx(150 / 255)
    assert look_up(textures, 0.375, 0.5)[1] == pytest.approx(40 / 255)


def test_nearest_shows_no_mean():
    textures = table(ramp(), nearest=True)
    assert look_up(textures, 0.49, 0.25)[0] == pytest.approx(100 / 255)
    assert look_up(textures, 0.51, 0.25)[0] == pytest.approx(200 / 255)


def test_a_step_over_the_border_blends_with_the_other_side_only_when_repeated():
    assert look_up(table(ramp()), 0.0, 0.25)[0] == pytest.approx(125 / 255)
    assert look_up(table(ramp(), wrap=("clamp", "clamp")), 0.0, 0.25)[0] == pytest.approx(0)


def test_colours_are_blended_in_linear_light_but_alpha_and_plain_numbers_as_they_are():
    pixels = np.zeros((1, 2, 4), np.uint8)
    pixels[0, 1] = 255
    in_linear = look_up(table(pixels, srgb=True, wrap=("clamp", "clamp")), 0.5, 0.5)
    np.testing.assert_allclose(in_linear, 0.5, atol=1e-6)
    pixels = np.full((1, 2, 4), 128, np.uint8)
    assert look_up(table(pixels, srgb=True), 0.3, 0.5)[0] == pytest.approx(
        linear_from_srgb(np.array(128 / 255))
    )
    assert look_up(table(pixels, srgb=True), 0.3, 0.5)[3] == pytest.approx(128 / 255)


def test_a_smaller_level_is_the_mean_of_what_it_covers_in_linear_light():
    board = np.zeros((8, 8, 4), np.uint8)
    board[::2, ::2, :3] = board[1::2, 1::2, :3] = 255
    flat, sizes = mipmaps(board, True)
    assert sizes == [(8, 8), (4, 4), (2, 2), (1, 1)]
    assert set(flat[8 * 8 * 4 :].reshape(-1, 4)[:, 0]) == {188}  # half the light in sRGB


@pytest.mark.parametrize("size", [(3, 5), (7, 1), (1, 1), (6, 9)])
def test_levels_of_odd_sizes_keep_the_mean(size):
    rng = np.random.default_rng(5)
    pixels = rng.integers(0, 256, (*size, 4), dtype=np.uint8)
    flat, sizes = mipmaps(pixels, False)
    assert sizes[-1] == (1, 1)
    np.testing.assert_allclose(flat[-4:], pixels.mean(axis=(0, 1)), atol=1.5)


def test_levels_are_made_once_for_an_image():
    pixels = ramp()
    assert mipmaps(pixels, True)[0] is mipmaps(pixels, True)[0]


@pytest.mark.parametrize(
    ("texels", "level"), [(0.3, 0.0), (1.0, 0.0), (2.0, 1.0), (3.0, 1.5), (4.0, 2.0), (64.0, 5.0)]
)
def test_the_level_has_texels_as_large_as_a_pixel(texels, level):
    assert footprint_level(texels, 0.0, 0.0, 0.1, 6) == pytest.approx(level)


def test_between_levels_both_are_seen():
    pixels = np.zeros((2, 2, 4), np.uint8)
    pixels[0] = 200
    textures = table(pixels)
    assert look_up(textures, 0.5, 0.25, 0.5)[0] == pytest.approx(150 / 255)


def test_without_mip_levels_there_is_only_the_image():
    assert table(ramp(), mipmaps=False).images[0, 2] == 1
