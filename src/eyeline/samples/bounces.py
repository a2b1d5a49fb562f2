"""The way of a bouncing ball: parabolas that lose height, squash where it lands, stretch, and a roll."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from eyeline.geometry.arrays import FloatArray
from eyeline.motion.curve import Curve
from eyeline.motion.track import Track
from eyeline.samples.keyed import hermite, turning

UP = (0.0, 1.0, 0.0)
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


def carried(curve: Curve, start: npt.ArrayLike, way: npt.ArrayLike) -> Curve:
    """A cubic's number over time as a place: `start` (3,) where it is 0, `way` (3,) farther where it is 1."""
    values = curve.values[:, :, None] * np.asarray(way, dtype=np.float64)
    values[:, 1] += np.asarray(start, dtype=np.float64)
    return Curve(curve.times, values, "cubic")


def tracks(bounces: Bounces, along: Curve, start: npt.ArrayLike, end: npt.ArrayLike) -> list[Track]:
    """What moves the nodes ball, squash and spin from start to end (x, 0, z), `along` going from 0 to 1."""
    begin = np.asarray(start, dtype=np.float64)
    way = np.asarray(end, dtype=np.float64) - begin
    length = math.sqrt(way @ way)
    return [
        Track("node", "ball", "translation", carried(along, begin, way)),
        Track("node", "ball/squash", "translation", carried(bounces.height(), (0, 0, 0), UP)),
        Track("node", "ball/squash", "scale", bounces.shape()),
        rolling("ball/squash/spin", along, length / bounces.radius, np.cross(UP, way / length)),
    ]


def rolling(path: str, along: Curve, angle: float, axis: npt.ArrayLike) -> Track:
    """A track that turns about an axis, through an angle as `along` goes from 0 to 1: a key a radian."""
    count = 2 + math.ceil(angle * float(np.abs(np.diff(along.at(along.times))).sum()))
    times = np.linspace(along.times[0], along.times[-1], count)
    return Track(
        "node",
        path,
        "rotation",
        turning(axis, list(zip(times.tolist(), angle * along.at(times), strict=True))),
    )
