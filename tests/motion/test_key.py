import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from eyeline.errors import SceneError
from eyeline.geometry import quaternion
from eyeline.motion import Curve, Key

EPSILON = float(np.finfo(float).eps)
WAYS = ("step", "linear", "cubic", "bezier", "catmull_rom", "squad")
SIDES = ("hold", "linear", "cycle", "cycle_offset", "ping_pong")
rows = st.integers(0, 2**32 - 1)


def curve(seed: int, rotation: bool, sides: tuple[str, str] | None = None) -> Curve:
    """Keys of all kinds, mixed."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 9))
    ways = WAYS if rotation else WAYS[:-1]
    keys = {}
    for time in np.cumsum(rng.uniform(0.1, 1, count)):
        way = str(rng.choice(ways))
        ease = "linear" if way in ("step", "bezier") else str(rng.choice(["ease_in_out", "ease_out_back"]))
        tangents = rng.normal(size=(2, 4))
        keys[float(time)] = Key(
            rng.normal(size=4),
            ease,
            interpolation=way,
            in_handle=(-rng.uniform(0, 1.5), rng.normal(size=4)),
            out_handle=(rng.uniform(0, 1.5), rng.normal(size=4)),
            in_tangent=tangents[0],
            out_tangent=tangents[1],
        )
    both = sides or tuple(str(side) for side in rng.choice(SIDES, 2))
    return Curve.of(keys, rotation=rotation, extrapolate=both)


@settings(derandomize=True, max_examples=60, deadline=None)
@given(rows, st.booleans())
def test_any_order_of_times_gives_the_same_bytes(seed: int, rotation: bool) -> None:
    one = curve(seed, rotation)
    rng = np.random.default_rng(seed)
    times = rng.uniform(-3, 9, 300)
    order = rng.permutation(len(times))
    together = one.at(times)
    assert np.array_equal(one.at(times[order]), together[order])
    assert np.array_equal(np.concatenate([one.at([time]) for time in times[:20]]), together[:20])


@settings(derandomize=True, max_examples=60, deadline=None)
@given(rows)
def test_a_curve_passes_through_its_keys(seed: int) -> None:
    one = curve(seed, rotation=False)
    assert np.array_equal(one.at(one.times), one.key_values)
    turn = curve(seed, rotation=True)
    found = turn.at(turn.times)
    assert np.allclose(found, quaternion.normalized(turn.key_values), rtol=0, atol=4 * EPSILON)


@settings(derandomize=True, max_examples=60, deadline=None)
@given(rows)
def test_turns_have_length_one_and_never_flip(seed: int) -> None:
    one = curve(seed, rotation=True, sides=("linear", "cycle_offset"))
    times = np.linspace(one.times[0] - 1, one.times[-1] + 1, 4001)
    found = one.at(times)
    assert np.allclose(np.linalg.norm(found, axis=1), 1, rtol=0, atol=1e3 * EPSILON)
    smooth = [way for way in one.ways[:-1] if way in ("linear", "bezier", "catmull_rom", "squad")]
    if len(smooth) == len(one.times) - 1:
        assert (found[1:] * found[:-1]).sum(axis=1).min() > 0


@settings(derandomize=True, max_examples=60, deadline=None)
@given(rows, st.booleans())
def test_a_curve_without_steps_has_no_jumps(seed: int, rotation: bool) -> None:
    one = curve(seed, rotation, sides=("cycle_offset", "ping_pong"))
    if "step" in one.ways[:-1] or "cubic" in one.ways:
        return
    edges = np.concatenate([one.times, 2 * one.times[0] - one.times])
    before, after = one.at(edges - 1e-12), one.at(edges + 1e-12)
    if rotation:
        after = after * np.sign((before * after).sum(axis=1, keepdims=True))
    assert np.abs(before - after).max() < 1e-5


@settings(derandomize=True, max_examples=60, deadline=None)
@given(rows)
def test_speed_is_how_fast_values_change(seed: int) -> None:
    one = curve(seed, rotation=False, sides=("linear", "cycle"))
    times = np.random.default_rng(seed).uniform(one.times[0], one.times[-1], 50)
    if len(one.times) > 1:
        times = times[np.abs(times[:, None] - one.times).min(axis=1) > 1e-3]
    step = 1e-6
    measured = (one.at(times + step) - one.at(times - step)) / (2 * step)
    assert np.allclose(one.speed(times), measured, rtol=1e-5, atol=1e-5)


def test_speed_of_polynomials_is_exact() -> None:
    cubic = np.polynomial.Polynomial([0.3, -2, 1.5, 0.7])
    times = np.array([-1.0, 0.5, 2.0, 2.25])
    slopes = cubic.deriv()(times)
    one = Curve(times, np.stack([slopes, cubic(times), slopes], axis=1), "cubic")
    between = np.linspace(-1, 2.25, 100)[:-1]
    assert np.allclose(one.speed(between), cubic.deriv()(between), rtol=0, atol=1e-9)
    assert one.speed([-5, 9]).tolist() == [0, 0]


def test_speed_of_a_turn_is_its_angular_velocity() -> None:
    turns = quaternion.from_axis_angle([0, 1, 0], np.array([0.0, 1.5]))
    one = Curve([0, 0.5], turns, rotation=True)
    assert np.allclose(one.speed([0, 0.2, 0.5 - 1e-9]), [[0, 3, 0]] * 3, rtol=0, atol=1e-9)


def test_turns_go_on_beyond_their_keys() -> None:
    turns = quaternion.from_axis_angle([0, 1, 0], np.array([0.0, 0.5]))
    for side in ("linear", "cycle_offset"):
        found = Curve([0, 1], turns, rotation=True, extrapolate=side).at([-2.5, 7.3])
        expected = quaternion.from_axis_angle([0, 1, 0], np.array([-1.25, 3.65]))
        assert np.allclose(np.abs((found * expected).sum(axis=1)), 1, rtol=0, atol=8 * EPSILON)


def test_catmull_rom_keeps_a_parabola_however_its_keys_are_spaced() -> None:
    times = np.array([0, 0.5, 0.8, 2, 3.5])
    one = Curve(times, times**2, "catmull_rom")
    between = np.linspace(0.5, 2, 50)
    assert np.allclose(one.at(between), between**2, rtol=0, atol=8 * EPSILON)


def test_squad_about_one_axis_is_smooth_through_its_keys() -> None:
    angles = np.array([0.0, 0.4, 1.5, 1.8, 2.9])
    one = Curve(np.arange(5), quaternion.from_axis_angle([1, 0, 0], angles), "squad", rotation=True)
    before, after = one.speed(np.arange(1, 4) - 1e-7), one.speed(np.arange(1, 4))
    assert np.allclose(before, after, rtol=0, atol=1e-5)
    assert np.allclose(after[:, 1:], 0, rtol=0, atol=1e-9)


def test_automatic_handles_never_overshoot() -> None:
    rng = np.random.default_rng(8)
    times, values = np.cumsum(rng.uniform(0.1, 1, 40)), rng.normal(size=40)
    one = Curve(times, values, "bezier")
    for index in range(39):
        found = one.at(np.linspace(times[index], times[index + 1], 50))
        low, high = sorted(values[index : index + 2])
        assert low - 4 * EPSILON <= found.min() and found.max() <= high + 4 * EPSILON


def test_a_moving_hold_drifts_on_the_way_it_came() -> None:
    one = Curve.of({0: (0, 0), 1: Key((2, 4), hold=0.5, drift=0.1), 2: (0, 0)})
    assert one.times.tolist() == [0, 1, 1.5, 2]
    assert one.kinds == ("key", "moving_hold", "moving_hold", "key")
    assert np.allclose(one.at([1, 1.5]), [[2, 4], [2.2, 4.4]])
    turns = quaternion.from_axis_angle([0, 0, 1], np.array([0.0, 1.0]))
    turned = Curve.of({0: turns[0], 1: Key(-turns[1], hold=1, drift=0.2)}, rotation=True)
    assert np.allclose(turned.at([2])[0], quaternion.from_axis_angle([0, 0, 1], 1.2))


def test_each_key_says_how_it_goes_on() -> None:
    one = Curve.of(
        {0: Key(0, "ease_in"), 1: Key(1, interpolation="step"), 2: 5, 3: Key(6, kind="extreme")},
        ease="steps(2)",
    )
    assert [str(ease) for ease in one.eases] == ["ease_in(0.42, 0, 1, 1)", "linear", "steps(2)", "steps(2)"]
    assert one.at([1.9, 2.4, 2.6]).tolist() == [1, 5, 5.5]
    assert one.kinds == ("key", "key", "key", "extreme")


def test_a_segment_with_a_handle_is_a_bezier() -> None:
    one = Curve.of({0: 0, 1: Key(1, in_handle=(-0.5, 0)), 2: 3})
    assert one.ways == ("bezier", "linear", "linear")


def test_plain_curves_are_those_of_gltf() -> None:
    assert Curve([0, 1], [0, 1]).is_plain
    assert Curve.of({0: 1, 1: 2}, interpolation="step").is_plain
    assert not Curve([0, 1], [0, 1], extrapolate="cycle").is_plain
    assert not Curve([0, 1], [0, 1], ease="ease").is_plain
    assert not Curve([0, 1, 2], [0, 1, 2], ["step", "linear", "linear"]).is_plain


@pytest.mark.parametrize(
    ("keys", "options", "sentence"),
    [
        ({}, {}, "no keys"),
        ({1: 0, 0: 1}, {}, "key 1 is at 0.0 s, key 0 at 1.0 s; times must increase"),
        ([(0, 1), (0, 2)], {}, "times must increase"),
        ({0: 0, math.nan: 1}, {}, "no finite time"),
        ({0: "up"}, {}, "cannot be read"),
        ({0: (0, 0), 1: 3}, {}, "key 1 has a value of shape ()"),
        ({0: 0, 1: 1}, {"ease": "eas"}, "no easing 'eas'; there is 'ease'"),
        ({0: 0, 1: 1}, {"extrapolate": "loop"}, "extrapolation is 'loop'"),
        ({0: Key(0, kind="xtreme"), 1: 1}, {}, "'xtreme'; there is 'extreme'"),
        ({0: 0, 1: 1}, {"interpolation": "squad"}, "catmull_rom is its like"),
        ({0: Key(0, "ease", interpolation="bezier"), 1: 1}, {}, "leave one out"),
        (
            {0: Key(0, out_handle=(-1, 0)), 1: 1},
            {},
            "the out handle of key 0 lies -1.0 s beside it; it must be after",
        ),
        ({0: Key(0, out_handle=(1, (0, 0))), 1: 1}, {}, "a handle of key 0"),
        ({0: Key(0, interpolation="cubic", out_tangent=(1, 2)), 1: 1}, {}, "tangent has shape (2,)"),
        ({0: Key(0, hold=2), 1: 1}, {}, "times must increase"),
    ],
)
def test_keys_that_make_no_curve_are_refused(keys: object, options: dict, sentence: str) -> None:
    with pytest.raises(SceneError) as refusal:
        Curve.of(keys, **options)
    assert sentence in str(refusal.value)


@pytest.mark.parametrize("options", [{"hold": -1}, {"hold": math.inf}, {"drift": math.nan}])
def test_a_hold_without_an_end_is_refused(options: dict) -> None:
    with pytest.raises(SceneError, match="hold"):
        Key(0, **options)
