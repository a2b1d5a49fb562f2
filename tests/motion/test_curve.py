import math

import numpy as np
import pytest

from eyeline.errors import SceneError
from eyeline.geometry import quaternion
from eyeline.motion import Curve
from eyeline.motion.bundle import sine

X, Y = (1, 0, 0), (0, 1, 0)


def turns(*angles: float) -> np.ndarray:
    return quaternion.from_axis_angle(Y, np.array(angles))


def test_a_line_passes_through_its_keys_exactly() -> None:
    rng = np.random.default_rng(1)
    times, values = np.sort(rng.random(40)), rng.normal(size=(40, 3))
    assert np.array_equal(Curve(times, values).at(times), values)


def test_half_way_on_a_line_is_the_mean() -> None:
    curve = Curve([1, 3], [[0, 10], [4, 20]])
    assert curve.at([2]).tolist() == [[2, 15]]


def test_a_step_keeps_the_old_value_until_the_key() -> None:
    curve = Curve([0, 1, 2], [5, 6, 7], "step")
    assert curve.at([0, 0.999999, 1, 1.5, 2, 9]).tolist() == [5, 5, 6, 6, 7, 7]


@pytest.mark.parametrize("interpolation", ["step", "linear", "cubic"])
def test_a_curve_holds_outside_its_keys(interpolation: str) -> None:
    values = np.array([[1.0, 3.0, 8.0], [2.0, 4.0, 8.0]])
    curve = Curve([-1, 1], values if interpolation == "cubic" else values[:, 1], interpolation)
    assert curve.at([-100, -1, 1, 100]).tolist() == [3, 3, 4, 4]


@pytest.mark.parametrize("interpolation", ["step", "linear", "cubic"])
def test_one_key_is_a_value_that_stays(interpolation: str) -> None:
    value = np.array([[[1.0, 1], [2, 3], [4, 4]]])
    curve = Curve([0.5], value if interpolation == "cubic" else value[:, 1], interpolation)
    assert curve.at([-1, 0.5, 7]).tolist() == [[2, 3]] * 3


def test_a_spline_follows_hermite() -> None:
    """A cubic is given back whole from its values and slopes. [glTF 2.0, appendix C.5]"""
    cubic = np.polynomial.Polynomial([0.3, -2, 1.5, 0.7])
    times = np.array([-1.0, 0.5, 2.0, 2.25])
    slopes = cubic.deriv()(times)
    curve = Curve(times, np.stack([slopes, cubic(times), slopes], axis=1), "cubic")
    between = np.linspace(-1, 2.25, 100)
    assert np.allclose(curve.at(between), cubic(between), rtol=0, atol=1e-13)


def test_a_spline_uses_the_tangent_out_of_one_key_and_into_the_next() -> None:
    curve = Curve([0, 2], [[9.0, 0.0, 1.0], [-3.0, 0.0, 9.0]], "cubic")
    u, span = 0.25, 2.0
    expected = span * ((u**3 - 2 * u**2 + u) * 1.0 + (u**3 - u**2) * -3.0)
    assert math.isclose(curve.at([u * span])[0], expected, rel_tol=1e-15)


def test_a_turn_half_way_is_half_the_angle() -> None:
    curve = Curve([0, 1], turns(0.2, 1.4), rotation=True)
    assert np.allclose(curve.at([0.5]), turns(0.8), rtol=0, atol=1e-15)


def test_turns_go_at_constant_speed() -> None:
    curve = Curve([0, 1], turns(0, 3), rotation=True)
    u = np.linspace(0, 1, 33)
    assert np.allclose(curve.at(u), turns(*(3 * u)), rtol=0, atol=1e-15)


def test_turns_equal_the_slow_twin() -> None:
    rng = np.random.default_rng(2)
    q = quaternion.normalized(rng.normal(size=(50, 4)))
    t = rng.uniform(0, 49, 2000)
    i = np.floor(t).astype(int)
    fast, slow = Curve(np.arange(50), q, rotation=True).at(t), quaternion.slerp(q[i], q[i + 1], t - i)
    assert np.abs((fast * slow).sum(axis=1)).min() > 1 - 1e-15


def test_the_other_quaternion_of_the_same_turn_takes_the_short_way() -> None:
    q = turns(0.2, 0.6)
    curve = Curve([0, 1], [q[0], -q[1]], rotation=True)
    assert np.allclose(curve.at([0.5]), turns(0.4), rtol=0, atol=1e-15)


def test_turns_have_length_one_whatever_the_keys() -> None:
    rng = np.random.default_rng(3)
    keys = rng.normal(size=(20, 3, 4)) * 5
    for interpolation in ("step", "linear", "cubic"):
        values = keys if interpolation == "cubic" else keys[:, 1]
        found = Curve(np.arange(20), values, interpolation, rotation=True).at(rng.uniform(-1, 21, 500))
        assert np.allclose(np.linalg.norm(found, axis=1), 1, rtol=0, atol=1e-15)


def test_equal_turns_stay() -> None:
    q = turns(0.7)[0]
    assert np.array_equal(Curve([0, 1], [q, q], rotation=True).at([0.3])[0], quaternion.normalized(q))


def test_nearly_equal_turns_stay_between() -> None:
    curve = Curve([0, 1], turns(0.7, 0.7 + 1e-12), rotation=True)
    assert np.allclose(curve.at(np.linspace(0, 1, 9)), turns(0.7), rtol=0, atol=1e-12)


def test_the_sine_is_right_to_two_roundings() -> None:
    x = np.linspace(0, math.pi / 2, 4001)
    found = np.array([sine(one) for one in x])
    assert np.abs(found - np.sin(x)).max() <= 2 * np.finfo(float).eps


def test_any_order_of_times_gives_the_same_bytes() -> None:
    rng = np.random.default_rng(4)
    curve = Curve(np.sort(rng.random(30)), rng.normal(size=(30, 4)), rotation=True)
    times = rng.uniform(-0.1, 1.1, 20_000)
    order = rng.permutation(len(times))
    together = curve.at(times)
    assert np.array_equal(curve.at(times[order]), together[order])
    assert np.array_equal(np.concatenate([curve.at([one]) for one in times[:50]]), together[:50])


def test_values_of_any_shape() -> None:
    values = np.arange(24.0).reshape(2, 3, 4)
    assert np.array_equal(Curve([0, 1], values).at([0.5])[0], values.mean(axis=0))
    assert Curve([0, 1], values).at([]).shape == (0, 3, 4)


@pytest.mark.parametrize(
    ("times", "values", "options", "sentence"),
    [
        ([], [], {}, "one key or more"),
        ([[0, 1]], [[0, 1]], {}, "one key or more"),
        ([0, 1], [0], {}, "one for each"),
        ([0, 1], 5, {}, "one for each"),
        ([0, 0], [1, 2], {}, "key 1 is at 0.0 s, key 0 at 0.0 s; times must increase"),
        ([0, 2, 1], [1, 2, 3], {}, "key 2 is at 1.0 s"),
        ([0, math.nan], [1, 2], {}, "key 1 has no finite time"),
        ([0, 1], [1, math.inf], {}, "key 1 is not finite"),
        ([0, 1], [1, 2], {"interpolation": "bezir"}, "'bezir'; there is 'bezier'"),
        ([0, 1], [[1, 2], [1, 2]], {"interpolation": "cubic"}, "tangent value tangent"),
        ([0, 1], [[1, 2, 3], [1, 2, 3]], {"rotation": True}, "(keys, 4)"),
        ([0, 1], [[0, 0, 0, 1], [0, 0, 0, 0]], {"rotation": True}, "key 1 is 0 0 0 0"),
        ([0], [[[0, 0, 0, 1]] * 2], {"rotation": True, "interpolation": "cubic"}, "tangent value tangent"),
    ],
)
def test_keys_that_make_no_curve_are_refused(times: list, values: list, options: dict, sentence: str) -> None:
    with pytest.raises(SceneError) as refusal:
        Curve(times, values, **options)
    assert sentence in str(refusal.value)


def test_a_time_that_is_no_number_is_refused() -> None:
    with pytest.raises(SceneError, match="not finite"):
        Curve([0], [1]).at([math.nan])
