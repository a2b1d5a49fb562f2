"""The way of a bouncing ball: parabolas that lose height, squash where it lands, stretch, and a roll."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.motion.curve import Curve
from eyeline.motion.track import Track
from eyeline.samples.keyed import hermite, turning

GRAVITY = 9.81  # metres a second squared
CONTACT = 0.075  # seconds that a landing takes
STRETCH = 1.13  # of the height, at the greatest speed
TOUCH = 0.045  # seconds before and after a landing in which the stretch shows


@dataclass(frozen=True)
class Bounces:
    """A ball that falls from `drop` and rises again to each of `heights`: metres of its underside."""

    radius: float
    drop: float
    heights: Sequence[float]
    begin: float = 0.0  # seconds; the ball hangs at its highest then

    @property
    def landings(self) -> FloatArray:
        """(N,) seconds at which it touches the floor."""
        falls = [fall(self.drop), *(2 * fall(height) + CONTACT for height in self.heights)]
        landings: FloatArray = self.begin + np.cumsum(falls)
        return landings

    @property
    def squashes(self) -> FloatArray:
        """(N,) how high it is at the landings' middles, as a part of its height: the faster the flatter."""
        speeds = np.sqrt(2 * GRAVITY * np.array([self.drop, *self.heights]))
        squashes: FloatArray = 1 - 0.32 * speeds / speeds[0]
        return squashes

    def height(self) -> Curve:
        """The centre's height over time: exact parabolas, and a soft landing between them."""
        keys = [(self.begin, self.radius + self.drop, 0.0, 0.0)]
        tops = [self.drop, *self.heights]
        for k, landing in enumerate(self.landings):
            speed = math.sqrt(2 * GRAVITY * tops[k])
            rise = math.sqrt(2 * GRAVITY * tops[k + 1]) if k + 1 < len(tops) else 0.0
            depth = self.radius * (1 - self.squashes[k])
            press = 4 * depth / CONTACT
            keys += [
                (landing, self.radius, -speed, -press),
                (landing + CONTACT / 2, self.radius - depth, 0.0, 0.0),
                (landing + CONTACT, self.radius, press, rise),
            ]
        times, values, slopes_in, slopes_out = np.array(keys).T
        return hermite(times, values, slopes_in, slopes_out)

    def shape(self) -> Curve:
        """The ball's scale over time: its volume stays, and in a landing its underside stays on the floor."""
        keys = [(self.begin, 1.0, 0.0, 0.0)]
        middles = self.landings + CONTACT / 2
        for k, (landing, squash) in enumerate(zip(self.landings, self.squashes, strict=True)):
            stretch = 1 + (STRETCH - 1) * (1 - squash) / (1 - self.squashes[0])
            press, give = 4 * (1 - squash) / CONTACT, (stretch - 1) / TOUCH
            after = (middles[k] + middles[k + 1]) / 2 if k + 1 < len(middles) else math.inf
            keys += [
                (landing - TOUCH, stretch, 0.0, 0.0),
                (landing, 1.0, -give, -press),
                (landing + CONTACT / 2, squash, 0.0, 0.0),
                (landing + CONTACT, 1.0, press, give if after < math.inf else 0.0),
            ]
            if after < math.inf:
                keys += [(landing + CONTACT + TOUCH, stretch, 0.0, 0.0), (after, 1.0, 0.0, 0.0)]
        # Where one landing follows another closely there is no time to stretch
        keys = [key for key, one in zip(keys, [*keys[1:], (math.inf,)], strict=True) if key[0] < one[0]]
        times, tall, tall_in, tall_out = np.array(keys).T[:, :, None]
        wide, widening = tall**-0.5, -0.5 * tall**-1.5
        columns = [
            np.concatenate([side, middle, side], axis=1)
            for side, middle in ((wide, tall), (widening * tall_in, tall_in), (widening * tall_out, tall_out))
        ]
        return hermite(times[:, 0], *columns)


def fall(height: float) -> float:
    """Seconds that a fall from a height takes."""
    return math.sqrt(2 * height / GRAVITY)


def travel(height: Curve, along: Curve, start: Sequence[float], end: Sequence[float]) -> Curve:
    """The translation of a ball that goes from start to end (x, z), `along` being 0 there and 1 here."""
    times = np.union1d(height.times, along.times)
    times = np.union1d(times, (times[1:] + times[:-1]) / 2)
    near = (times[1:] - times[:-1]).min() * 1e-3
    y, (y_in, y_out) = height.at(times), slopes(height, times, near)
    part, (part_in, part_out) = along.at(times), slopes(along, times, near)
    way = np.array([end[0] - start[0], 0, end[1] - start[1]])
    place = np.array([start[0], 0, start[1]]) + part[:, None] * way
    up = np.array([0, 1, 0])
    return hermite(
        times, place + y[:, None] * up, part_in[:, None] * way + y_in[:, None] * up,
        part_out[:, None] * way + y_out[:, None] * up,
    )  # fmt: skip


def slopes(curve: Curve, times: FloatArray, near: float) -> tuple[FloatArray, FloatArray]:
    """(T,) how fast a curve arrives at times and leaves them."""
    here = curve.at(times)
    return (here - curve.at(times - near)) / near, (curve.at(times + near) - here) / near


def rolling(path: str, along: Curve, length: float, radius: float, axis: Sequence[float]) -> Track:
    """A track that turns a ball about an axis as it rolls along its way, in steps of a small turn."""
    turns = length / (2 * math.pi * radius)
    count = 1 + math.ceil(6 * turns * float(np.abs(np.diff(along.at(along.times))).sum()))
    times = np.linspace(along.times[0], along.times[-1], count)
    keys = list(zip(times.tolist(), (2 * math.pi * turns * along.at(times)).tolist(), strict=True))
    return Track("node", path, "rotation", turning(axis, keys))
