"""Acting is numbers: expressions, gaze, blinks and speech."""

from __future__ import annotations

import numpy as np
import pytest

import eyeline as el
from eyeline.errors import SceneError
from eyeline.motion.curve import Curve
from eyeline.motion.face import EXPRESSIONS, acted, blinks, express, gaze, lip_sync, mixed, perform
from eyeline.motion.phonemes import SPOKEN, VISEMES, viseme

HELLO = [(0.2, "HH"), (0.28, "AH0"), (0.36, "L"), (0.45, "OW1"), (0.8, "-")]


def test_an_expression_is_as_strong_as_asked():
    assert express("smile", 0.7)["mouthSmileLeft"] == pytest.approx(0.7)
    assert express("neutral") == {}
    with pytest.raises(SceneError, match="'smile'"):
        express("smil")


@pytest.mark.parametrize("name", EXPRESSIONS)
def test_expressions_stay_within_what_controls_can(name):
    assert all(0 < value <= 1 for value in EXPRESSIONS[name].values())


def test_mixed_expressions_add_up_to_one_at_most():
    both = mixed(express("smile", 0.7), express("grin", 0.7), express("wink"))
    assert both["mouthSmileLeft"] == 1
    assert both["jawOpen"] == pytest.approx(0.245)


def test_eyes_go_the_same_way():
    assert gaze(0.5)["eyeLookOutLeft"] == gaze(0.5)["eyeLookInRight"] == 0.5
    assert gaze(-0.5, 0.2)["eyeLookInLeft"] == 0.5
    assert gaze(0, -1)["eyeLookDownRight"] == 1


def test_a_moment_has_nothing_of_what_it_does_not_name():
    keys = acted({1.0: express("blink"), 0.0: express("kiss")})
    assert keys["mouthPucker"] == {0.0: 1.0, 1.0: 0.0}
    assert keys["eyeBlinkLeft"] == {0.0: 0.0, 1.0: 1.0}


def test_mouths_add_up_to_one_all_the_time():
    keys = lip_sync(HELLO)
    times = np.linspace(0, 1, 1001)
    total = sum(Curve.of(one, ease="ease_in_out_sine").at(times) for one in keys.values())
    np.testing.assert_allclose(total, 1, atol=1e-9)


def test_a_long_sound_is_held_and_silence_frames_the_words():
    keys = lip_sync(HELLO, amount=0.5)
    o = Curve.of(keys["viseme_O"]).at([0.3, 0.52, 0.7, 1.0])
    np.testing.assert_allclose(o, (0, 0.5, 0.5, 0), atol=1e-12)
    silence = Curve.of(keys["viseme_sil"]).at([0.0, 0.4, 2.0])
    np.testing.assert_allclose(silence, (0.5, 0, 0.5), atol=1e-12)


def test_every_phoneme_has_one_mouth():
    spoken = [phoneme for names in SPOKEN.values() for phoneme in names.split()]
    assert len(spoken) == len(set(spoken))
    assert viseme("AA1") == "viseme_aa"
    assert set(map(viseme, spoken)) == set(VISEMES)


def test_speech_that_goes_back_or_has_no_such_sound_is_refused():
    with pytest.raises(SceneError, match="times must rise"):
        lip_sync([(0.2, "AA"), (0.2, "P")])
    with pytest.raises(SceneError, match="no phoneme 'QQ'"):
        lip_sync([(0.2, "QQ")])


def test_blinks_come_by_a_seed_and_open_again():
    keys = blinks(60, seed=3)
    assert keys == blinks(60, seed=3) != blinks(60, seed=4)
    (left, right) = keys.values()
    assert left == right
    assert 8 < list(left.values()).count(1.0) / 2 < 30
    assert list(left)[-1] <= 60 and list(left.values())[-1] == 0
    with pytest.raises(SceneError, match=r"more than 0\.6"):
        blinks(10, every=0.5)


def test_a_performance_is_keys_on_a_shot():
    head = el.Node("head", controls={"jawOpen": 0.0, "mouthFunnel": 0.0})
    shot = perform(el.Shot(el.Scene.of(head)), "head", acted({0: {}, 1: {"jawOpen": 1.0}}), start=2.0)
    assert shot.clip.duration == 3.0
    assert shot.scene.sample([2.0, 3.0]).controls[0]["jawOpen"].tolist() == [0, 1]
