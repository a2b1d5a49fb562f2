"""What the kernel of woven curves reads: a record of numbers for each key's segment, and for both ends."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.bundle import arcs
from eyeline.motion.tangents import quadrangle, slopes

if TYPE_CHECKING:
    from eyeline.motion.curve import Curve

# How a segment is made, first of the numbers in its head
WAY_STEP, WAY_LINEAR, WAY_ARC, WAY_CUBIC, WAY_BEZIER, WAY_SQUAD = range(6)

# A record: the way, the easing's family, mode and four numbers, an arc's angle in turns and 1 / its sine;
# then, each as wide as a value: this key, the next, two that shape the way, and two rows of a bezier's times.
HEAD = 9
ANGLE, PER_SINE = 7, 8

# How a curve goes on beyond its keys; those below CYCLE_OFFSET leave them, the others come back
HOLD, LINEAR_ON, CYCLE_OFFSET, CYCLE, PING_PONG = range(5)
AHEAD = {
    "hold": HOLD,
    "linear": LINEAR_ON,
    "cycle_offset": CYCLE_OFFSET,
    "cycle": CYCLE,
    "ping_pong": PING_PONG,
}


def records(curve: Curve) -> FloatArray:
    """(K, HEAD + 6 W) a record for every key; the last only holds its value."""
    count, width = len(curve.times), curve.width
    table = np.zeros((count, HEAD + 6 * width))
    parts = table[:, HEAD:].reshape(count, 6, width)
    values = curve.key_values.reshape(count, width)
    parts[:, 0] = values
    parts[:-1, 1] = values[1:]
    for key, one in enumerate(curve.eases[:-1]):
        table[key, 1:7] = (one.family, one.mode, *one.numbers)
    for way in dict.fromkeys(curve.ways[:-1]):
        chosen = [key for key in range(count - 1) if curve.ways[key] == way]
        FILLED[way](curve, table, parts, np.array(chosen))
    if curve.rotation:
        still = table[:, 0] == WAY_STEP
        parts[still, 0] = quaternion.normalized(parts[still, 0])
    return table


def _linear(curve: Curve, table: FloatArray, parts: FloatArray, keys: FloatArray) -> None:
    table[keys, 0] = WAY_ARC if curve.rotation else WAY_LINEAR
    if curve.rotation:
        parts[keys, 0] = quaternion.normalized(parts[keys, 0])
        parts[keys, 1] = _near(parts[keys, 0], quaternion.normalized(parts[keys, 1]))
        for key in keys:
            angle, per_sine = arcs(parts[key, :2])
            table[key, ANGLE], table[key, PER_SINE] = angle[0] / math.tau, per_sine[0]


def _cubic(curve: Curve, table: FloatArray, parts: FloatArray, keys: FloatArray) -> None:
    tangents = curve.values.reshape(len(curve.times), 3, -1)
    _hermite(curve, table, parts, keys, tangents[:, 2], tangents[:, 0])


def _catmull_rom(curve: Curve, table: FloatArray, parts: FloatArray, keys: FloatArray) -> None:
    through = slopes(curve.times, curve.key_values.reshape(len(curve.times), -1))
    _hermite(curve, table, parts, keys, through, through)


def _hermite(
    curve: Curve, table: FloatArray, parts: FloatArray, keys: FloatArray, out: FloatArray, into: FloatArray
) -> None:
    """The tangents of cubics, scaled to each segment's length."""
    table[keys, 0] = WAY_CUBIC
    gaps = np.diff(curve.times)[keys][:, None]
    parts[keys, 2], parts[keys, 3] = gaps * out[keys], gaps * into[keys + 1]


def _bezier(curve: Curve, table: FloatArray, parts: FloatArray, keys: FloatArray) -> None:
    table[keys, 0] = WAY_BEZIER
    gaps = np.diff(curve.times)[keys][:, None]
    assert curve.handles is not None
    handles = curve.handles.reshape(len(curve.times), 2, 2, -1)
    for part, side, ends in ((2, 1, keys), (3, 0, keys + 1)):
        times, values = handles[ends, side, 0], handles[ends, side, 1]
        # A handle longer than its segment would make time run backwards; Blender shortens it, value and all
        length = np.abs(times) / gaps
        kept = np.where(length > 1, 1 / np.where(length > 1, length, 1), 1.0)
        parts[keys, part] = parts[keys, part - 2 if part == 2 else 1] + kept * values
        parts[keys, part + 2] = np.minimum(length, 1) if side else 1 - np.minimum(length, 1)


def _squad(curve: Curve, table: FloatArray, parts: FloatArray, keys: FloatArray) -> None:
    table[keys, 0] = WAY_SQUAD
    inner = quadrangle(curve.key_values)
    parts[keys, 2], parts[keys, 3] = inner[keys], inner[keys + 1]


def _step(curve: Curve, table: FloatArray, parts: FloatArray, keys: FloatArray) -> None:
    table[keys, 0] = WAY_STEP


FILLED = {
    "step": _step,
    "linear": _linear,
    "cubic": _cubic,
    "bezier": _bezier,
    "catmull_rom": _catmull_rom,
    "squad": _squad,
}


def _near(turns: FloatArray, others: FloatArray) -> FloatArray:
    """The same turns as `others`, on the side of `turns`."""
    return np.where((turns * others).sum(axis=-1, keepdims=True) < 0, -others, others)


def beyond(curve: Curve) -> FloatArray:
    """(2, W) what is added before and after the keys, for each second or lap.

    A rotation's are an axis, and by how many half turns it turns about it.
    """
    sides = np.zeros((2, curve.width))
    if len(curve.times) == 1:
        return sides
    values = curve.key_values.reshape(len(curve.times), -1)
    for side, way in enumerate(curve.extrapolate):
        if way == "cycle_offset":
            sides[side] = _turned(values[0], values[-1]) if curve.rotation else values[-1] - values[0]
        elif way == "linear":
            sides[side] = _onward(curve, side)
    return sides


def _onward(curve: Curve, side: int) -> FloatArray:
    """How a curve goes on at one end, each second: along its tangent or handle, else along the chord."""
    key, segment = (-1, -2) if side else (0, 0)
    way = curve.ways[segment]
    gap = float(np.diff(curve.times)[-1 if side else 0])
    values = curve.key_values.reshape(len(curve.times), -1)
    slope: FloatArray = np.zeros(curve.width)
    if way == "cubic":
        slope = curve.values.reshape(len(curve.times), 3, -1)[key, 0 if side else 2]
    elif way == "catmull_rom":
        slope = slopes(curve.times, values)[key]
    elif way == "bezier":
        assert curve.handles is not None
        time, value = curve.handles.reshape(len(curve.times), 2, 2, -1)[key, side]
        slope = np.where(time == 0, 0, value / np.where(time == 0, 1, time))
    elif way != "step":
        first, last = (values[-2], values[-1]) if side else (values[0], values[1])
        if curve.rotation:
            return _turned(first, last) / (1, 1, 1, gap)
        slope = (last - first) / gap
    return _spun(values[key], slope) if curve.rotation else slope


def _turned(first: FloatArray, last: FloatArray) -> FloatArray:
    """The axis, and the half turns, that lead from one quaternion to another, not to its opposite."""
    first, last = quaternion.normalized(first), quaternion.normalized(last)
    x, y, z, w = quaternion.multiply(last, first * (-1, -1, -1, 1))
    sine = math.sqrt(x * x + y * y + z * z)
    if sine == 0:
        return np.zeros(4)
    return np.array([x / sine, y / sine, z / sine, math.atan2(sine, w) / math.tau])


def _spun(turn: FloatArray, slope: FloatArray) -> FloatArray:
    """The axis, and the half turns a second, of a turn whose quaternion changes by `slope` a second."""
    length = float(np.sqrt((turn * turn).sum()))
    half = quaternion.multiply(slope / length, turn / length * (-1, -1, -1, 1))[:3]
    speed = float(np.sqrt((half * half).sum()))
    return np.zeros(4) if speed == 0 else np.array([*(half / speed), speed / math.tau])
