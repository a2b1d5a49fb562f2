import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from eyeline.errors import SceneError
from eyeline.motion import EASINGS, Curve, cubic_bezier, easing, steps
from eyeline.motion.warp import crossing, power_of_two, sine_of_turns

EPSILON = float(np.finfo(float).eps)
RETURNING = {"there_and_back", "there_and_back_with_pause", "wiggle"}
JUMPING = {"step", "steps"}
# A spring starts a thousandth of its amplitude away [Penner02]; a circle is upright at one end
LEAPS = {"elastic": 2.0**-10, "circ": 0.2}
PARTS = np.linspace(0, 1, 2001)


@pytest.mark.parametrize("name", EASINGS)
def test_an_easing_starts_at_the_key_and_ends_at_the_next(name: str) -> None:
    start, end = EASINGS[name]([0, 1])
    assert abs(start) <= EPSILON
    assert abs(end - (name not in RETURNING)) <= 4 * EPSILON


@pytest.mark.parametrize("name", [name for name in EASINGS if name not in JUMPING])
def test_an_easing_does_not_jump(name: str) -> None:
    leap = max([0.02, *(size for family, size in LEAPS.items() if family in name)])
    fine = np.linspace(0, 1, 20_001)
    assert np.abs(np.diff(EASINGS[name](fine))).max() <= leap


@pytest.mark.parametrize("name", [name for name in EASINGS if name.startswith("ease_in_out_")])
def test_in_out_is_the_same_backwards(name: str) -> None:
    ease = EASINGS[name]
    assert np.allclose(ease(PARTS), 1 - ease(1 - PARTS), rtol=0, atol=8 * EPSILON)


@pytest.mark.parametrize(
    "name", [name for name in EASINGS if name.startswith("ease_out_") and name.count("_") == 2]
)
def test_out_is_in_backwards(name: str) -> None:
    ahead = EASINGS[name.replace("out", "in")]
    assert np.allclose(EASINGS[name](PARTS), 1 - ahead(1 - PARTS), rtol=0, atol=4 * EPSILON)


@pytest.mark.parametrize(
    ("name", "formula"),
    [
        ("ease_in_sine", lambda u: 1 - math.cos(u * math.pi / 2)),
        ("ease_in_quint", lambda u: u**5),
        ("ease_in_circ", lambda u: 1 - math.sqrt(1 - u * u)),
        ("ease_in_back", lambda u: 2.70158 * u**3 - 1.70158 * u * u),
        ("ease_in_expo", lambda u: (2 ** (10 * u) - 1) / 1023),
        ("ease_out_elastic", lambda u: 2 ** (-10 * u) * math.sin((u * 10 - 0.75) * math.tau / 3) + (u > 0)),
        ("smooth", lambda u: (1 / (1 + math.exp(10 * (0.5 - u))) - RIM) / (1 - 2 * RIM)),
        ("rush_into", lambda u: 2 * (1 / (1 + math.exp(5 - 5 * u)) - RIM) / (1 - 2 * RIM)),
        ("smoothstep", lambda u: 3 * u * u - 2 * u**3),
        ("smootherstep", lambda u: 6 * u**5 - 15 * u**4 + 10 * u**3),
        ("wiggle", lambda u: float(EASINGS["there_and_back"](u)) * math.sin(2 * math.pi * u)),
        ("steps", lambda u: math.floor(4 * u) / 4),
        ("lingering", lambda u: min(1, u / 0.8)),
    ],
)
def test_easings_follow_their_formulas(name: str, formula: object) -> None:
    expected = [formula(u) for u in PARTS[1:-1]]
    assert np.allclose(EASINGS[name](PARTS[1:-1]), expected, rtol=0, atol=32 * EPSILON)


RIM = 1 / (1 + math.exp(5))


def test_functions_are_right_to_a_few_roundings() -> None:
    x = np.linspace(-3, 3, 3001)
    assert np.allclose([sine_of_turns(one) for one in x], np.sin(math.tau * x), rtol=0, atol=24 * EPSILON)
    assert np.allclose([power_of_two(20 * one) for one in x], 2 ** (20 * x), rtol=8 * EPSILON, atol=0)


part = st.floats(0, 1)


@settings(derandomize=True, max_examples=300, deadline=None)
@given(part, part, part)
def test_the_time_of_a_bezier_is_found_whatever_its_handles(u: float, x1: float, x2: float) -> None:
    """Where the cubic is flat a time has many answers; that its time is met is what counts."""
    s = crossing(u, x1, x2)
    r = 1 - s
    assert 0 <= s <= 1
    assert abs(3 * r * r * s * x1 + 3 * r * s * s * x2 + s**3 - u) <= 4 * EPSILON


@settings(derandomize=True, max_examples=50, deadline=None)
@given(part, part, st.floats(-2, 3), st.floats(-2, 3))
def test_css_handles_are_points_of_a_cubic(x1: float, x2: float, y1: float, y2: float) -> None:
    s = np.linspace(0, 1, 50)
    x = 3 * (1 - s) ** 2 * s * x1 + 3 * (1 - s) * s**2 * x2 + s**3
    steep = np.gradient(x, s) > 0.1
    y = 3 * (1 - s) ** 2 * s * y1 + 3 * (1 - s) * s**2 * y2 + s**3
    assert np.allclose(cubic_bezier(x1, y1, x2, y2)(x)[steep], y[steep], rtol=0, atol=1e4 * EPSILON)


def test_an_easing_is_read_as_it_is_written() -> None:
    for one in EASINGS.values():
        assert np.array_equal(easing(one.name)(PARTS), one(PARTS))
    spring = easing("ease-out-elastic(1.5, 0.25)")
    assert str(spring) == "ease_out_elastic(1.5, 0.25)"
    assert easing(str(spring)) == spring
    assert easing("steps(3)") == steps(3)
    assert easing("cubic_bezier(0.3, 0, 0.1, 1)") == cubic_bezier(0.3, 0, 0.1, 1)


def test_easings_warp_turns_and_values_alike() -> None:
    ease = easing("ease_out_back(3)")
    u = np.linspace(0, 1, 101)[:-1]
    angle = 0.8 * ease(u)
    quarter = [[0, 0, 0, 1], [0, math.sin(0.4), 0, math.cos(0.4)]]
    found = Curve([0, 1], quarter, rotation=True, ease=ease).at(u)
    assert np.allclose(found[:, 1], np.sin(angle / 2), rtol=0, atol=8 * EPSILON)
    assert np.allclose(Curve([0, 1], [5, 7], ease=ease).at(u), 5 + 2 * ease(u), rtol=4 * EPSILON, atol=0)


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("ease_in_qad", "there is no easing 'ease_in_qad'; there is 'ease_in_quad'"),
        ("ease_in_quad(2)", "given 1 numbers; it takes none"),
        ("steps(0)", "steps has count 0"),
        ("steps(two)", "cannot be read"),
        ("cubic_bezier(2, 0, 0, 1)", "x1 2; 0 to 1 is needed"),
        ("ease_out_elastic(1, 0)", "period 0"),
        ("ease_in(", "a name is needed"),
        (3, "a name is needed"),
    ],
)
def test_what_is_no_easing_is_refused(name: str, sentence: str) -> None:
    with pytest.raises(SceneError) as refusal:
        easing(name)
    assert sentence in str(refusal.value)
