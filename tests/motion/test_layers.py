import numpy as np
import pytest

from eyeline.errors import SceneError
from eyeline.geometry import quaternion
from eyeline.motion import Clip, Curve, Layer, Layers, Track
from eyeline.motion.mirror import other_side
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

SCENE = Scene((Node("body"), Node("arm.L", 0, (1, 0, 0)), Node("arm.R", 0, (-1, 0, 0))))


def turns(*angles: float) -> np.ndarray:
    return quaternion.from_axis_angle((0, 0, 1), np.array(angles))


def clip(name: str, reach: float, angle: float) -> Clip:
    return Clip(
        name,
        [
            Track("node", "body", "translation", Curve([0, 2], [(0, 0, 0), (reach, 0, 0)])),
            Track("node", "arm.L", "rotation", Curve([0, 2], turns(0, angle), rotation=True)),
        ],
    )


WALK, WAVE = clip("walk", 4, 0.8), clip("wave", 10, 1.6)
TIMES = np.linspace(-1, 6, 29)


def reach(action: object, times: object = TIMES) -> np.ndarray:
    return action.sample(SCENE, np.array(times, float)).translation[:, 0, 0]


def angle(action: object, times: object, node: int = 1) -> np.ndarray:
    found = action.sample(SCENE, np.array(times, float)).rotation[:, node]
    return 2 * np.arctan2(found[:, 2], found[:, 3])


def test_a_layer_overrides_by_its_weight() -> None:
    half = Layers(WALK, Layer(WAVE, weight=0.25))
    assert np.allclose(reach(half, [1]), [0.75 * 2 + 0.25 * 5])
    assert np.allclose(angle(half, [1]), [0.75 * 0.4 + 0.25 * 0.8])
    assert np.array_equal(reach(Layers(WALK, Layer(WAVE, weight=0.0))), reach(WALK))


def test_an_additive_layer_adds_what_has_changed_since_its_reference() -> None:
    added = Layers(WALK, Layer(WAVE, "additive", weight=0.5, reference=1.0))
    assert np.allclose(reach(added, [1, 2]), [2, 4 + 0.5 * 5])
    assert np.allclose(angle(added, [1, 2]), [0.4, 0.8 + 0.5 * 0.8])


def test_a_mask_lets_only_its_nodes_move() -> None:
    masked = Layers(WALK, Layer(WAVE, mask=["body/arm*"]))
    assert np.array_equal(reach(masked), reach(WALK))
    assert np.array_equal(angle(masked, TIMES), angle(WAVE, TIMES))


def test_a_weight_can_move() -> None:
    rising = Layers(WALK, Layer(WAVE, weight=Curve([0, 2], [0, 1])))
    assert np.allclose(reach(rising, [0, 1, 2]), [0, 3.5, 10])


def test_a_pose_is_what_a_batch_has() -> None:
    both = Layers(WALK.loop(2), Layer(WAVE.reverse(), "additive", 0.3), Layer(WALK, mask=["arm.L"]))
    batch = both.sample(SCENE, TIMES)
    for index, time in enumerate(TIMES):
        assert np.array_equal(both.pose(SCENE, float(time)).world, batch.world[index])


def test_a_cross_fade_leads_from_one_to_the_other() -> None:
    faded = WALK.cross_fade(WAVE, 1.0)
    assert faded.duration == 3
    assert np.allclose(reach(faded, [0.5, 1, 1.5, 2, 3]), [1, 2, (3 + 2.5) / 2, 5, 10])
    cut = WALK.join(WAVE)
    assert np.allclose(reach(cut, [1.999, 2, 4]), [3.998, 0, 10])


def test_what_only_one_moves_fades_to_rest() -> None:
    still = Clip("still", [Track("node", "arm.R", "scale", Curve([0, 2], [(1, 1, 1), (2, 2, 2)]))])
    assert np.allclose(reach(WALK.cross_fade(still, 1.0), [1, 1.5, 2]), [2, 1.5, 0])


@pytest.mark.parametrize(
    ("action", "clock", "duration"),
    [
        (WALK.trim(0.5, 1.5), np.clip(TIMES, 0, 1) + 0.5, 1),
        (WALK.retime(2.0), TIMES / 2, 4),
        (WALK.reverse(), 2 - TIMES, 2),
        (WALK.shift(1.5), TIMES - 1.5, 3.5),
        (WALK.loop(2), np.where(np.clip(TIMES, 0, 4) > 2, np.clip(TIMES, 0, 4) - 2, np.clip(TIMES, 0, 4)), 4),
        (WALK.retime(Curve([0, 1, 3], [0, 2, 1])), np.interp(TIMES, [0, 1, 3], [0, 2, 1]), 3),
    ],
)
def test_verbs_are_clocks(action: object, clock: np.ndarray, duration: float) -> None:
    assert action.duration == duration
    assert np.allclose(reach(action), reach(WALK, clock), rtol=0, atol=1e-12)


def test_a_mirror_swaps_sides_and_reflects() -> None:
    mirrored = WALK.mirror()
    assert np.allclose(reach(mirrored, [2]), [-4])
    assert np.allclose(angle(mirrored, [2], node=2), [-0.8])
    again = mirrored.mirror()
    assert np.array_equal(again.sample(SCENE, TIMES).world, WALK.sample(SCENE, TIMES).world)


@pytest.mark.parametrize(
    ("path", "other"),
    [
        ("body/arm.L/hand_l", "body/arm.R/hand_r"),
        ("LeftArm", "RightArm"),
        ("mixamorig:RightHand", "mixamorig:LeftHand"),
        ("arm_left", "arm_right"),
        ("arm.L.001", "arm.R.001"),
        ("L_foot", "R_foot"),
        ("lamp/collar", "lamp/collar"),
        ("bright", "bright"),
    ],
)
def test_sides_are_found_in_names(path: str, other: str) -> None:
    assert other_side(path) == other
    assert other_side(other) == path


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: Layer(WALK, "multiply"), "override or additive"),
        (lambda: Layer(WALK, weight=np.nan), "weight is nan"),
        (lambda: Layer(WALK, weight=Curve([0], [(1, 2)])), "single numbers"),
        (lambda: Layers(WALK, Layer(WAVE, mask=["leg*"])).pose(SCENE, 0), "'leg*' meets no node"),
        (lambda: WALK.trim(2, 1), "an end after the start"),
        (lambda: WALK.retime(0), "more than 0"),
        (lambda: WALK.loop(0), "more than 0"),
        (lambda: Clip("none").reverse(), "lasts 0 s"),
        (lambda: WALK.cross_fade(WAVE, 3), "0 to 2 s fit"),
        (lambda: WALK.mirror("w"), "plane of a mirror is 'w'"),
        (lambda: WALK.shift(np.inf), "shifted by inf"),
    ],
)
def test_what_cannot_be_done_is_refused(make: object, sentence: str) -> None:
    with pytest.raises(SceneError) as refusal:
        make()
    assert sentence in str(refusal.value)
