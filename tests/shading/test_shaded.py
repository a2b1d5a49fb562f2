"""The shaded picture as a whole."""

from __future__ import annotations

import numpy as np
import pytest

from eyeline.errors import OptionError
from eyeline.samples import teapot
from eyeline.scene.camera import Camera
from eyeline.scene.colour import linear_from_srgb, srgb_from_linear
from eyeline.scene.light import Light
from eyeline.scene.material import Material
from eyeline.scene.scene import Scene
from eyeline.scene.texture import Texture, TextureSlot
from eyeline.shading.frame import Strip
from eyeline.shading.look import Look
from frames import FOUR, FRONT, frame_of, picture_of, square

CLEAR = Look(background="transparent")


def middle(picture: np.ndarray) -> np.ndarray:
    return picture[picture.shape[0] // 2, picture.shape[1] // 2]


def test_an_unlit_surface_shows_exactly_its_colour():
    for grey in range(0, 256, 5):
        light = float(linear_from_srgb(np.array(grey / 255)))
        material = Material(base_color=(light, light, light, 1.0), unlit=True)
        picture = picture_of(
            frame_of(Scene.of(square(material=material)), size=(12, 8), look=Look(exposure=3.0))
        )
        assert middle(picture).tolist() == [grey, grey, grey, 255]


def test_an_unlit_texture_shows_exactly_its_texels():
    pixels = np.random.default_rng(3).integers(0, 256, (4, 4, 4), dtype=np.uint8)
    slot = TextureSlot(Texture(pixels, nearest=True))
    material = Material(base_color=(1, 1, 1, 1), base_color_texture=slot, unlit=True)
    frame = frame_of(Scene.of(square(2.0, material=material)), Camera(height=2.0, near=0.5, far=9), (16, 16))
    picture = picture_of(frame)
    assert (picture[2::4, 2::4, :3] == pixels[..., :3]).all()


def test_what_glows_shines_without_light():
    material = Material(base_color=(0, 0, 0, 1), emissive=(0.0, 0.2, 0.0), roughness=1.0)
    dark = Light(intensity=0.0)
    picture = picture_of(frame_of(Scene.of(square(material=material), dark), look=Look(tone="none")))
    assert middle(picture)[1] == pytest.approx(255 * srgb_from_linear(np.array(0.2)), abs=6)
    assert middle(picture)[0] < 40


def test_exposure_doubles_light_with_each_stop():
    material = Material(base_color=(0, 0, 0, 1), emissive=(0.1, 0.1, 0.1), roughness=1.0)
    scene = Scene.of(square(material=material), Light(intensity=0.0))
    shown = [
        linear_from_srgb(middle(picture_of(frame_of(scene, look=Look(tone="none", exposure=stops))))[0] / 255)
        for stops in (0.0, 1.0, 2.0)
    ]
    assert shown[1] / shown[0] == pytest.approx(2, rel=0.04)
    assert shown[2] / shown[1] == pytest.approx(2, rel=0.04)


def test_the_neutral_tone_keeps_order_and_never_clips_to_white():
    shown = []
    for light in (0.2, 0.5, 0.9, 2.0, 6.0, 30.0):
        material = Material(base_color=(0, 0, 0, 1), emissive=(light, light / 2, 0.0))
        picture = picture_of(frame_of(Scene.of(square(material=material), Light(intensity=0.0))))
        shown.append(int(middle(picture)[0]))
    assert shown == sorted(shown)
    assert shown[3] < 255


def test_a_clear_background_has_alpha_0_and_edges_between():
    frame = frame_of(Scene.of(square(0.93)), shifts=FOUR, look=CLEAR)
    alpha = picture_of(frame)[..., 3]
    assert alpha[0, 0] == 0
    assert middle(picture_of(frame))[3] == 255
    assert set(np.unique(alpha)) - {0, 255} <= {64, 128, 191}
    assert len(np.unique(alpha)) > 2


def test_edges_on_a_clear_background_keep_the_colour_of_the_surface():
    material = Material(base_color=(1.0, 0.0, 0.0, 1.0), unlit=True)
    picture = picture_of(frame_of(Scene.of(square(0.93, material=material)), shifts=FOUR, look=CLEAR))
    touched = picture[..., 3] > 0
    assert (picture[touched][:, :3] == (255, 0, 0)).all()


def test_a_plain_background_is_exactly_its_colour():
    light = tuple(float(v) for v in linear_from_srgb(np.array([10, 128, 250]) / 255))
    picture = picture_of(frame_of(Scene.of(square()), look=Look(background=light)))
    assert picture[0, 0].tolist() == [10, 128, 250, 255]


def test_one_and_two_threads_give_the_same_bytes(monkeypatch):
    camera = Camera.look_at((0.3, 0.5, 0.6), (0, 0.08, 0), fov=0.5)
    pictures = []
    for count in (1, 2):
        for module in ("frame", "openness", "shadow_map"):
            monkeypatch.setattr(f"eyeline.shading.{module}.threads", lambda count=count: count)
        monkeypatch.setattr("eyeline.shading.frame.STRIP_PIXELS", 5000)
        pictures.append(picture_of(frame_of(teapot(), camera, (160, 120), FOUR)).tobytes())
    assert pictures[0] == pictures[1]


def test_strips_do_not_show(monkeypatch):
    camera = Camera.look_at((0.3, 0.5, 0.6), (0, 0.08, 0), fov=0.5)
    whole = picture_of(frame_of(teapot(), camera, (160, 120)))
    monkeypatch.setattr("eyeline.shading.frame.STRIP_PIXELS", 160)
    assert (picture_of(frame_of(teapot(), camera, (160, 120))) == whole).all()


def test_samples_that_agree_are_shaded_once():
    frame = frame_of(Scene.of(square(0.93)), shifts=FOUR)
    points = Strip(frame, 0, 32).points
    pairs = set(zip(points.pixel.tolist(), points.face.tolist(), strict=True))
    assert len(pairs) == len(points)


def test_an_empty_scene_is_its_backdrop():
    picture = picture_of(frame_of(Scene.of(), FRONT))
    assert picture.shape == (32, 48, 4)
    assert (picture[..., 3] == 255).all()


@pytest.mark.parametrize(
    "wrong",
    [
        {"exposure": float("nan")},
        {"occlusion": 1.5},
        {"ground": "maybe"},
        {"tone": "film"},
        {"background": "pink"},
    ],
)
def test_what_no_picture_can_show_is_refused(wrong):
    with pytest.raises(OptionError, match=next(iter(wrong))):
        Look(**wrong)


def test_an_unknown_style_is_refused_by_name():
    with pytest.raises(OptionError, match=r"shadde.*shaded"):
        picture_of(frame_of(Scene.of(square()), look=Look(style="shadde")))
