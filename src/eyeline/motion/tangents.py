"""Tangents, handles and quadrangles that make a smooth way through keys."""

from __future__ import annotations

import numpy as np

from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray


def slopes(times: FloatArray, values: FloatArray) -> FloatArray:
    """Catmull-Rom's speeds (K, W) at keys that need not be evenly spaced. [CatmullRom74]

    At an inner key the speeds of both sides, each weighted by the length of the other: a parabola keeps its
    own. At the ends the chord's.
    """
    if len(times) == 1:
        return np.zeros_like(values)
    gaps = np.diff(times)[:, None]
    chords = np.diff(values, axis=0) / gaps
    inner = (chords[:-1] * gaps[1:] + chords[1:] * gaps[:-1]) / (gaps[:-1] + gaps[1:])
    return np.concatenate([chords[:1], inner, chords[-1:]])


def automatic(times: FloatArray, values: FloatArray) -> FloatArray:
    """Handles (K, 2, 2, W) a third of their segments long, flat at both ends and wherever a value turns back.

    in and out; time and value, both beside the key. No handle leads a value beyond its neighbours.
    """
    count, width = values.shape
    handles = np.zeros((count, 2, 2, width))
    if count == 1:
        return handles
    gaps = np.diff(times)[:, None]
    chords = np.diff(values, axis=0) / gaps
    slope = slopes(times, values)
    slope[[0, -1]] = 0
    onward = chords[:-1] * chords[1:] > 0
    limit = 3 * np.minimum(np.abs(chords[:-1]), np.abs(chords[1:]))
    slope[1:-1] = np.where(onward, np.clip(slope[1:-1], -limit, limit), 0)
    handles[1:, 0, 0], handles[:-1, 1, 0] = -gaps / 3, gaps / 3
    handles[1:, 0, 1], handles[:-1, 1, 1] = -gaps / 3 * slope[1:], gaps / 3 * slope[:-1]
    return handles


def quadrangle(turns: FloatArray) -> FloatArray:
    """Inner points (K, 4) of a spline of arcs through unit quaternions, neighbours near. [Shoemake87]

    a_i = q_i exp(-(log(q_i^-1 q_i+1) + log(q_i^-1 q_i-1)) / 4); at both ends the key itself.
    """
    inner = turns.copy()
    back = turns[1:-1] * (-1, -1, -1, 1)
    ahead = _logarithm(quaternion.multiply(back, turns[2:]))
    behind = _logarithm(quaternion.multiply(back, turns[:-2]))
    inner[1:-1] = quaternion.multiply(turns[1:-1], _exponential(-(ahead + behind) / 4))
    return inner


def _logarithm(turns: FloatArray) -> FloatArray:
    """(K, 3) the axes of unit quaternions, half the angles long."""
    sine = np.sqrt((turns[:, :3] ** 2).sum(axis=1))
    angle = np.arctan2(sine, turns[:, 3])
    return turns[:, :3] * np.where(sine > 0, angle / np.where(sine > 0, sine, 1), 1)[:, None]


def _exponential(axes: FloatArray) -> FloatArray:
    """(K, 4) the unit quaternions whose logarithms are (K, 3)."""
    angle = np.sqrt((axes * axes).sum(axis=1))
    unit = axes / np.where(angle > 0, angle, 1)[:, None]
    return np.concatenate([unit * np.sin(angle)[:, None], np.cos(angle)[:, None]], axis=1)
