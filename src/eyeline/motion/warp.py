"""The shapes of easings as kernels reckon them: a part of the way, 0 to 1, becomes another.

Made of sums, products, quotients, roots and floors alone, so that every machine finds the same.
"""

from __future__ import annotations

import numpy as np

from eyeline.jit import helper
from eyeline.motion.bundle import sine

# Shapes that start at 0 and end at 1
STRAIGHT, POWER, SINE, EXPO, CIRC, BACK, ELASTIC, BOUNCE, BEZIER, STEPS, SIGMOID, HERMITE, RUN, LINGER = (
    range(14)
)

# How a shape is laid over the time of a segment
IN, OUT, IN_OUT, FIRST_HALF, SECOND_HALF, THERE_AND_BACK, WIGGLE = range(7)

HALVINGS = 64  # more than a float64 between 0 and 1 can be halved before it is known whole


@helper
def sine_of_turns(x):
    """The sine of `x` whole turns."""
    x = x - np.floor(x)
    sign = 1.0
    if x >= 0.5:
        x -= 0.5
        sign = -1.0
    if x > 0.25:
        x = 0.5 - x
    return sign * sine(6.283185307179586 * x)


@helper
def power_of_two(x):
    """2 to the power `x`, within a few roundings for |x| below a hundred."""
    whole = np.floor(x + 0.5)
    y = 0.6931471805599453 * (x - whole)
    p = 1.0
    for k in range(16, 0, -1):
        p = 1.0 + y * p / k
    for _ in range(int(abs(whole))):
        p = p * 2.0 if whole > 0.0 else p * 0.5
    return p


@helper
def crossing(u, x1, x2):
    """Where on a cubic from 0 to 1 with the control values x1, x2, both in 0 to 1, it equals `u` in 0 to 1.

    Such a cubic never falls. Newton's steps, halved where one would leave what is known to hold the answer.
    """
    if x1 == 1.0 / 3.0 and x2 == 2.0 / 3.0:
        return u
    low = 0.0
    high = 1.0
    s = u
    for _ in range(HALVINGS):
        r = 1.0 - s
        error = 3.0 * r * r * s * x1 + 3.0 * r * s * s * x2 + s * s * s - u
        if error == 0.0:
            return s
        if error < 0.0:
            low = s
        else:
            high = s
        slope = 3.0 * (r * r * x1 + 2.0 * r * s * (x2 - x1) + s * s * (1.0 - x2))
        following = s - error / slope if slope > 0.0 else low
        if not low < following < high:
            following = 0.5 * (low + high)
        if following in (s, low, high):
            return following
        s = following
    return s


@helper
def bounced(u):
    """A ball that has come to rest at 1 after three bounces, each a parabola. [Penner02]"""
    if u < 1.0 / 2.75:
        return 7.5625 * u * u
    if u < 2.0 / 2.75:
        u -= 1.5 / 2.75
        return 7.5625 * u * u + 0.75
    if u < 2.5 / 2.75:
        u -= 2.25 / 2.75
        return 7.5625 * u * u + 0.9375
    u -= 2.625 / 2.75
    return 7.5625 * u * u + 0.984375


@helper
def sprung(u, amplitude, period, phase):
    """A spring let loose backwards: a sine that grows a thousandfold; phase in turns. [Penner02]

    Below an amplitude of 1 only what comes before the last quarter of a period is smaller, as in Blender.
    """
    if u <= 0.0 or u >= 1.0:
        return u
    back = 1.0 - u
    height = amplitude if amplitude > 1.0 else 1.0
    if amplitude < 1.0:
        height = amplitude
        if back < 0.25 * period:
            near = back / (0.25 * period)
            height = amplitude * near + (1.0 - near)
    return height * power_of_two(-10.0 * back) * sine_of_turns(back / period + phase)


@helper
def sigmoid(u, steepness):
    """The logistic function between 0 and 1, stretched to reach both."""
    rim = 1.0 / (1.0 + power_of_two(0.7213475204444817 * steepness))
    here = 1.0 / (1.0 + power_of_two(1.4426950408889634 * steepness * (0.5 - u)))
    return (here - rim) / (1.0 - 2.0 * rim)


@helper
def shape(family, a, b, c, d, u):
    """The value of a shape at 0 <= u <= 1; a, b, c, d are its numbers."""
    if family == POWER:
        value = u
        for _ in range(int(a) - 1):
            value *= u
        return value
    if family == SINE:
        half = sine_of_turns(0.125 * u)
        return 1.0 - sine_of_turns(0.25 - 0.25 * u) if u > 0.5 else 2.0 * half * half
    if family == EXPO:
        return (power_of_two(10.0 * u) - 1.0) / 1023.0
    if family == CIRC:
        return 1.0 - np.sqrt(max(0.0, (1.0 - u) * (1.0 + u)))
    if family == BACK:
        return u * u * ((a + 1.0) * u - a)
    if family == ELASTIC:
        return sprung(u, a, b, c)
    if family == BOUNCE:
        return 1.0 - bounced(1.0 - u)
    if family == BEZIER:
        s = crossing(u, a, c)
        r = 1.0 - s
        return 3.0 * r * r * s * b + 3.0 * r * s * s * d + s * s * s
    if family == STEPS:
        return np.floor(u * a) / a
    if family == SIGMOID:
        return sigmoid(u, a)
    if family == HERMITE:
        if a == 1.0:
            return u * u * (3.0 - 2.0 * u)
        return u * u * u * (10.0 - u * (15.0 - 6.0 * u))
    if family == RUN:
        v = 1.0 - u
        turn = a * (15.0 * v * v + 20.0 * v * u) + 15.0 * u * u
        return u * u * (v * v * turn + 6.0 * v * u * u * u + u * u * u * u)
    if family == LINGER:
        return min(1.0, u / a)
    return u


@helper
def warped(family, mode, a, b, c, d, u):
    """The part of the way that an easing has gone at the part `u`, 0 to 1, of its time."""
    if family == STRAIGHT:
        return u
    if mode == IN:
        return shape(family, a, b, c, d, u)
    if mode == OUT:
        return 1.0 - shape(family, a, b, c, d, 1.0 - u)
    if mode == IN_OUT:
        if u < 0.5:
            return 0.5 * shape(family, a, b, c, d, 2.0 * u)
        return 1.0 - 0.5 * shape(family, a, b, c, d, 2.0 - 2.0 * u)
    if mode == FIRST_HALF:
        return 2.0 * shape(family, a, b, c, d, 0.5 * u)
    if mode == SECOND_HALF:
        return 2.0 * shape(family, a, b, c, d, 0.5 * u + 0.5) - 1.0
    # There, a rest of `b` of the time, and back
    leg = min(u, 1.0 - u) * 2.0 / (1.0 - b)
    value = shape(family, a, b, c, d, min(1.0, leg))
    return value * sine_of_turns(0.5 * c * u) if mode == WIGGLE else value
