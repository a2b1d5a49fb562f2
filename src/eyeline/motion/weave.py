"""Curves whose segments go different ways, are eased, or go on beyond their keys: evaluated together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.jit import helper, kernel
from eyeline.motion.segments import (
    AHEAD,
    ANGLE,
    CYCLE_OFFSET,
    HEAD,
    HOLD,
    PER_SINE,
    PING_PONG,
    WAY_ARC,
    WAY_BEZIER,
    WAY_CUBIC,
    WAY_LINEAR,
    WAY_SQUAD,
    WAY_STEP,
    beyond,
    records,
)  # fmt: skip
from eyeline.motion.warp import crossing, sine_of_turns, warped

if TYPE_CHECKING:
    from eyeline.motion.curve import Curve

# Columns of the table of curves
(
    FIRST_KEY,
    END_KEY,
    FIRST_NUMBER,
    FIRST_BEYOND,
    WIDTH,
    TURNS,
    BEFORE,
    AFTER,
    COLUMNS_BEFORE,
    STRIDE,
    COLUMN,
) = range(11)


@dataclass(frozen=True, eq=False)
class Weave:
    """C curves, each with keys and segments of its own."""

    keys: FloatArray  # all curves' key times, one after the other
    numbers: FloatArray  # all curves' segments, one record a key, then what leads beyond their keys
    curves: IntArray  # (C, 11)

    @classmethod
    def of(cls, curves: Sequence[Curve], places: IntArray) -> Weave:
        """Curves, and where their values go: (C, 3) columns before the block, its width, the column in it."""
        rows = []
        keys: list[FloatArray] = [np.empty(0)]
        numbers: list[FloatArray] = [np.empty(0)]
        key = number = 0
        for curve, place in zip(curves, places.tolist(), strict=True):
            parts = [records(curve).reshape(-1), beyond(curve).reshape(-1)]
            end = key + len(curve.times)
            sides = [AHEAD[side] for side in curve.extrapolate]
            rows.append(
                (key, end, number, number + parts[0].size, curve.width, curve.rotation, *sides, *place)
            )
            keys.append(curve.times)
            numbers += parts
            key, number = end, number + parts[0].size + parts[1].size
        table = np.array(rows, dtype=np.int64).reshape(-1, 11)
        return cls(np.concatenate(keys), np.concatenate(numbers), table)

    def follow(self, times: FloatArray, begin: int, end: int, state: FloatArray) -> None:
        """Every curve at times begin to end, written where `Bundle.at` says."""
        follow(times, begin, end, self.keys, self.numbers, self.curves, state)


@helper
def arc(ax, ay, az, aw, bx, by, bz, bw, u):
    """From a to b, unit quaternions as they are, neither turned to the other's side. [Shoemake85]"""
    chord = (bx - ax) * (bx - ax) + (by - ay) * (by - ay) + (bz - az) * (bz - az) + (bw - aw) * (bw - aw)
    half_sine = min(1.0, 0.5 * np.sqrt(chord))
    half_cosine = np.sqrt((1.0 - half_sine) * (1.0 + half_sine))
    # The sine of an eighth of the angle, where the series of the arc sine is short
    quarter = half_sine / np.sqrt(2.0 + 2.0 * half_cosine)
    x = quarter / np.sqrt(2.0 + 2.0 * np.sqrt(1.0 - quarter * quarter))
    term = x
    angle = x
    for n in range(1, 24):
        term *= x * x * (2 * n - 1) * (2 * n - 1) / ((2 * n) * (2 * n + 1))
        angle += term
    turns = 8.0 * angle / 6.283185307179586
    sine = 2.0 * half_sine * half_cosine
    p = sine_of_turns((1.0 - u) * turns) / sine if sine > 0.0 else 1.0 - u
    q = sine_of_turns(u * turns) / sine if sine > 0.0 else u
    return p * ax + q * bx, p * ay + q * by, p * az + q * bz, p * aw + q * bw


@helper
def inside(time, first, last, way):
    """The time between the keys that stands for one outside, and how far beyond it is: laps or seconds."""
    edge = first if time < first else last
    span = last - first
    if way == HOLD or span == 0.0:
        return edge, 0.0
    if way < CYCLE_OFFSET:
        return edge, time - edge
    lap = np.floor((time - first) / span)
    part = min(max(time - first - lap * span, 0.0), span)
    if part == 0.0 and time > last:
        lap -= 1.0
        part = span
    if way == PING_PONG and lap % 2.0 == 1.0:
        part = span - part
    return first + part, (lap if way == CYCLE_OFFSET else 0.0)


@kernel
def follow(times, begin, end, keys, numbers, curves, state):
    """Every curve at times begin to end, written into its block of the state."""
    count = len(times)
    for curve in range(len(curves)):
        first_key = curves[curve, FIRST_KEY]
        end_key = curves[curve, END_KEY]
        width = curves[curve, WIDTH]
        turns = curves[curve, TURNS]
        size = HEAD + 6 * width
        stride = curves[curve, STRIDE]
        base = curves[curve, COLUMNS_BEFORE] * count + curves[curve, COLUMN]
        for t in range(begin, end):
            to = base + t * stride
            time = times[t]
            excess = 0.0
            side = 0
            if time < keys[first_key]:
                time, excess = inside(time, keys[first_key], keys[end_key - 1], curves[curve, BEFORE])
            elif time > keys[end_key - 1]:
                time, excess = inside(time, keys[first_key], keys[end_key - 1], curves[curve, AFTER])
                side = width

            # The key before, and the part of the way to the next
            low = first_key
            high = end_key
            while high - low > 1:
                middle = (low + high) >> 1
                if keys[middle] <= time:
                    low = middle
                else:
                    high = middle
            head = curves[curve, FIRST_NUMBER] + size * (low - first_key)
            a = head + HEAD
            b = a + width
            c = b + width
            d = c + width
            way = int(numbers[head])
            u = 0.0
            if way != WAY_STEP and time > keys[low]:
                u = (time - keys[low]) / (keys[low + 1] - keys[low])
                u = warped(
                    int(numbers[head + 1]), int(numbers[head + 2]), numbers[head + 3],
                    numbers[head + 4], numbers[head + 5], numbers[head + 6], u,
                )  # fmt: skip

            if u == 0.0 or way == WAY_STEP:
                for k in range(width):
                    state[to + k] = numbers[a + k]
            elif way == WAY_LINEAR:
                for k in range(width):
                    state[to + k] = (1.0 - u) * numbers[a + k] + u * numbers[b + k]
            elif way == WAY_ARC:
                angle = numbers[head + ANGLE]
                p = sine_of_turns((1.0 - u) * angle) * numbers[head + PER_SINE] if angle > 0.0 else 1.0
                q = sine_of_turns(u * angle) * numbers[head + PER_SINE] if angle > 0.0 else 0.0
                for k in range(width):
                    state[to + k] = p * numbers[a + k] + q * numbers[b + k]
            elif way == WAY_CUBIC:
                v = u * u
                s = v * (3.0 - 2.0 * u)
                for k in range(width):
                    state[to + k] = (
                        (1.0 - s) * numbers[a + k]
                        + (u - 2.0 * v + u * v) * numbers[c + k]
                        + s * numbers[b + k]
                        + (u * v - v) * numbers[d + k]
                    )
            elif way == WAY_BEZIER:
                x1 = -1.0
                x2 = -1.0
                s = u
                for k in range(width):
                    if numbers[d + width + k] != x1 or numbers[d + 2 * width + k] != x2:
                        x1 = numbers[d + width + k]
                        x2 = numbers[d + 2 * width + k]
                        s = crossing(u, x1, x2)
                    r = 1.0 - s
                    state[to + k] = (
                        r * r * r * numbers[a + k]
                        + 3.0 * r * r * s * numbers[c + k]
                        + 3.0 * r * s * s * numbers[d + k]
                        + s * s * s * numbers[b + k]
                    )
            elif way == WAY_SQUAD:
                px, py, pz, pw = arc(
                    numbers[a], numbers[a + 1], numbers[a + 2], numbers[a + 3],
                    numbers[b], numbers[b + 1], numbers[b + 2], numbers[b + 3], u,
                )  # fmt: skip
                qx, qy, qz, qw = arc(
                    numbers[c], numbers[c + 1], numbers[c + 2], numbers[c + 3],
                    numbers[d], numbers[d + 1], numbers[d + 2], numbers[d + 3], u,
                )  # fmt: skip
                state[to], state[to + 1], state[to + 2], state[to + 3] = arc(
                    px, py, pz, pw, qx, qy, qz, qw, 2.0 * u * (1.0 - u)
                )

            if turns and way >= WAY_CUBIC:
                length = 0.0
                for k in range(4):
                    length += state[to + k] * state[to + k]
                length = np.sqrt(length)
                for k in range(4):
                    state[to + k] = state[to + k] / length if length > 0.0 else (1.0 if k == 3 else 0.0)

            # Beyond the keys: so many laps, or seconds, on
            if excess != 0.0:
                m = curves[curve, FIRST_BEYOND] + side
                if turns:
                    w = sine_of_turns(0.25 + excess * numbers[m + 3])
                    s = sine_of_turns(excess * numbers[m + 3])
                    x = s * numbers[m]
                    y = s * numbers[m + 1]
                    z = s * numbers[m + 2]
                    ax = state[to]
                    ay = state[to + 1]
                    az = state[to + 2]
                    aw = state[to + 3]
                    state[to] = w * ax + x * aw + y * az - z * ay
                    state[to + 1] = w * ay - x * az + y * aw + z * ax
                    state[to + 2] = w * az + x * ay - y * ax + z * aw
                    state[to + 3] = w * aw - x * ax - y * ay - z * az
                else:
                    for k in range(width):
                        state[to + k] += excess * numbers[m + k]
