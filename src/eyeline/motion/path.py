"""A way through space, walked by the metre: a smooth curve, how far along it a place is, and how it turns."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from eyeline.cached import cached_property
from eyeline.errors import GeometryError
from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray, IntArray

GAUSS, WEIGHTS = np.polynomial.legendre.leggauss(8)  # exact for polynomials up to degree 15
PARTS = 16  # of each piece, each measured by itself
NEWTON = 8  # steps to the parameter of a length; three are enough within a part, unless the path stands still
QUARTER = 4 / 3 * (math.sqrt(2) - 1)  # handles of a quarter circle, in radii: off by 0.03 %


@dataclass(frozen=True, eq=False)
class Path:
    """Cubic Bezier pieces, end to end.

    pieces: (S, 4, 3) metres: start, two handles, end; each starts where the one before ends.
    closed: it goes on at its start when it comes to its end.
    """

    pieces: FloatArray
    closed: bool = False

    def __post_init__(self) -> None:
        """Refuse pieces that are no way, or lead nowhere."""
        pieces = np.ascontiguousarray(self.pieces, dtype=np.float64)
        if pieces.ndim != 3 or pieces.shape[1:] != (4, 3) or not len(pieces):
            raise GeometryError(f"a path has pieces of shape {pieces.shape}; (pieces, 4, 3) is needed")
        if not np.isfinite(pieces).all():
            raise GeometryError("a path goes through a point that is not finite; every number must be")
        if (pieces[1:, 0] != pieces[:-1, 3]).any():
            raise GeometryError("a piece of the path starts elsewhere than the one before it ends")
        if self.closed and (pieces[0, 0] != pieces[-1, 3]).any():
            raise GeometryError("a closed path ends where it starts")
        object.__setattr__(self, "pieces", pieces)
        if not self.length > 0:
            raise GeometryError("the path has length 0; two places or more are needed")

    @classmethod
    def through(cls, places: npt.ArrayLike, *, closed: bool = False) -> Path:
        """A smooth path through places (P, 3), without loops or cusps between them.

        The centripetal Catmull-Rom spline: its speed at a place is that of the parabola through three
        places, passed at times that grow with the roots of their distances. [Yuksel11] Doubled places
        count once.
        """
        spots = _distinct(places, closed=closed)
        around = np.concatenate([spots[-2:-1], spots, spots[1:2]]) if closed else _with_ends(spots)
        gaps = np.sqrt(np.sqrt((np.diff(around, axis=0) ** 2).sum(axis=1)))[:, None]
        before, after = gaps[:-1], gaps[1:]
        steps = np.diff(around, axis=0) / gaps
        speeds = (steps[:-1] * after + steps[1:] * before) / (before + after)
        own = gaps[1:-1] / 3
        starts, ends = spots[:-1], spots[1:]
        pieces = np.stack([starts, starts + speeds[:-1] * own, ends - speeds[1:] * own, ends], axis=1)
        return cls(pieces, closed)

    @classmethod
    def straight(cls, places: npt.ArrayLike, *, closed: bool = False) -> Path:
        """Straight lines from place to place (P, 3)."""
        spots = _distinct(places, closed=closed)
        starts, ends = spots[:-1, None], spots[1:, None]
        part = np.array([0, 1 / 3, 2 / 3])[:, None]
        # The last corner is the next one's first to the last bit
        return cls(np.concatenate([starts + part * (ends - starts), ends], axis=1), closed)

    @classmethod
    def circle(cls, centre: npt.ArrayLike, radius: float, axis: npt.ArrayLike = (0, 1, 0)) -> Path:
        """Once around an axis, counter-clockwise seen from its tip, from the side nearest to +x or +z."""
        if not 0 < radius < math.inf:
            raise GeometryError(f"radius is {radius} metres; more than 0 is needed")
        normal = np.asarray(axis, np.float64) / (np.linalg.norm(axis) or 1)
        seed = np.array([1.0, 0, 0]) if abs(normal[0]) < 0.9 else np.array([0, 0, 1.0])
        u = seed - (seed @ normal) * normal
        u /= np.linalg.norm(u) or 1
        v = np.cross(normal, u)
        spots = np.stack([u, v, -u, -v, u])
        turned = np.stack([v, -u, -v, u, v])
        places = np.stack([spots[:-1], spots[:-1] + QUARTER * turned[:-1],
                           spots[1:] - QUARTER * turned[1:], spots[1:]], axis=1)  # fmt: skip
        return cls(np.asarray(centre, np.float64) + radius * places, closed=True)

    @cached_property
    def length(self) -> float:
        """Metres from its start to its end."""
        return float(self._lengths[-1])

    def at(self, metres: npt.ArrayLike) -> FloatArray:
        """Places (T, 3) that far (T,) along; beyond an open path's ends its ends, round a closed one."""
        piece, u = self._where(metres)
        return _bezier(self.pieces[piece], u)

    def directions(self, metres: npt.ArrayLike) -> FloatArray:
        """Where it goes (T, 3), unit; where the curve itself stands still, the nearest way it goes."""
        piece, u = self._where(metres)
        return _unit_speeds(self.pieces[piece], u)

    def turns(self, metres: npt.ArrayLike, up: npt.ArrayLike = (0, 1, 0)) -> FloatArray:
        """World-from-traveller quaternions (T, 4): -z along the path, y carried along without a twist.

        At its start y is as near to `up` as it can be; from there it is transported in parallel, by two
        reflections a step [Wang08]. Round a closed path, what is left of the twist is spread evenly.
        """
        places, ways, rights = self._frames(tuple(np.asarray(up, np.float64).tolist()))
        along = self._within(metres)
        index = np.clip(np.searchsorted(self._lengths, along, "right") - 1, 0, len(self._lengths) - 2)
        here, way = self.at(along), self.directions(along)
        right = _transported(places[index], ways[index], rights[index], here, way)
        if self.closed:
            share = along / self.length * self._leftover(tuple(np.asarray(up, np.float64).tolist()))
            right = right * np.cos(share)[:, None] + np.cross(way, right) * np.sin(share)[:, None]
        axes = np.stack([right, np.cross(right, way), -way], axis=-1)
        return quaternion.from_matrix(axes)

    # --- how far -----------------------------------------------------------------------------------------

    @cached_property
    def _lengths(self) -> FloatArray:
        """Metres from the start to the start of each part of each piece, and to the end (S * PARTS + 1,)."""
        edges = np.arange(PARTS)[:, None] / PARTS + (GAUSS + 1) / (2 * PARTS)  # (PARTS, 8)
        pieces = np.repeat(self.pieces, edges.size, axis=0)
        speeds = _length(_speeds(pieces, np.tile(edges.reshape(-1), len(self.pieces))))
        parts = (speeds.reshape(-1, len(GAUSS)) * WEIGHTS).sum(axis=1) / (2 * PARTS)
        return np.concatenate([[0.0], np.cumsum(parts)])

    def _within(self, metres: npt.ArrayLike) -> FloatArray:
        along = np.asarray(metres, dtype=np.float64).reshape(-1)
        if not np.isfinite(along).all():
            raise GeometryError("a distance along the path is not finite; metres are needed")
        return np.mod(along, self.length) if self.closed else np.clip(along, 0, self.length)

    def _where(self, metres: npt.ArrayLike) -> tuple[IntArray, FloatArray]:
        """The piece (T,) and the parameter in it (T,) at distances along the path."""
        along = self._within(metres)
        lengths = self._lengths
        part = np.clip(np.searchsorted(lengths, along, "right") - 1, 0, len(lengths) - 2)
        piece, first = part // PARTS, (part % PARTS) / PARTS
        wanted, whole = along - lengths[part], lengths[part + 1] - lengths[part]
        u = first + np.where(whole > 0, wanted / np.where(whole > 0, whole, 1), 0) / PARTS
        for _ in range(NEWTON):
            # Metres from the part's start to u, and the speed there
            half = (u - first) / 2
            steps = first[:, None] + half[:, None] * (GAUSS + 1)
            speeds = _speeds(np.repeat(self.pieces[piece], len(GAUSS), axis=0), steps.reshape(-1))
            gone = (_length(speeds).reshape(len(u), -1) * WEIGHTS).sum(axis=1) * half
            speed = _length(_speeds(self.pieces[piece], u))
            step = (gone - wanted) / np.where(speed > 0, speed, np.inf)
            u = np.clip(u - step, first, first + 1 / PARTS)
        return piece, u

    # --- how it turns ------------------------------------------------------------------------------------

    def _frames(self, up: tuple[float, ...]) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Places, ways and what lies to the right of them (M, 3), at every mark, carried from the start."""
        kept = self._kept_frames
        if up not in kept:
            places, ways = self.at(self._lengths), self.directions(self._lengths)
            if self.closed:
                places[-1], ways[-1] = places[0], ways[0]
            rights = np.empty_like(ways)
            rights[0] = _first_right(ways[0], np.array(up))
            for index in range(1, len(ways)):
                one, two = slice(index - 1, index), slice(index, index + 1)
                rights[two] = _transported(places[one], ways[one], rights[one], places[two], ways[two])
            kept[up] = (places, ways, rights)
        return kept[up]

    @cached_property
    def _kept_frames(self) -> dict[tuple[float, ...], tuple[FloatArray, FloatArray, FloatArray]]:
        return {}

    def _leftover(self, up: tuple[float, ...]) -> float:
        """Radians about the way by which the frame must turn to close."""
        _, ways, rights = self._frames(up)
        return float(np.arctan2(np.cross(rights[-1], rights[0]) @ ways[0], rights[-1] @ rights[0]))


def _distinct(places: npt.ArrayLike, *, closed: bool) -> FloatArray:
    """Places (P, 3) without those that repeat the one before; a closed path's first again at its end."""
    spots: FloatArray = np.asarray(places, dtype=np.float64)
    if spots.ndim != 2 or spots.shape[1] != 3:
        raise GeometryError(f"places have shape {spots.shape}; (places, 3) is needed")
    if closed:
        spots = np.concatenate([spots, spots[:1]])
    repeats = np.flatnonzero((spots[1:] == spots[:-1]).all(axis=1)) + 1
    distinct: FloatArray = np.delete(spots, repeats, axis=0)
    if len(distinct) < 2 + closed:
        raise GeometryError(f"a path goes through {len(distinct)} place; two places or more are needed")
    return distinct


def _with_ends(spots: FloatArray) -> FloatArray:
    """An open path's places with one more at each end, mirrored: its ends are straight."""
    first, last = 2 * spots[:1] - spots[1:2], 2 * spots[-1:] - spots[-2:-1]
    return np.concatenate([first, spots, last])


def _bezier(pieces: FloatArray, u: FloatArray) -> FloatArray:
    t, s = u[:, None], 1 - u[:, None]
    a, b, c, d = pieces[:, 0], pieces[:, 1], pieces[:, 2], pieces[:, 3]
    place: FloatArray = a * s**3 + 3 * b * s**2 * t + 3 * c * s * t**2 + d * t**3
    return place


def _speeds(pieces: FloatArray, u: FloatArray) -> FloatArray:
    t, s = u[:, None], 1 - u[:, None]
    a, b, c = np.diff(pieces, axis=1).transpose(1, 0, 2)
    speed: FloatArray = 3 * (a * s**2 + 2 * b * s * t + c * t**2)
    return speed


def _unit_speeds(pieces: FloatArray, u: FloatArray) -> FloatArray:
    """Unit speeds; where a handle lies on its end, the direction towards the piece's middle."""
    speeds = _speeds(pieces, u)
    still = _length(speeds) <= 1e3 * np.finfo(np.float64).eps * np.abs(np.diff(pieces, axis=1)).sum((1, 2))
    if still.any():
        nudged = u + np.where(u < 0.5, 1, -1) / (16 * PARTS)
        speeds[still] = _speeds(pieces[still], nudged[still])
    lengths = _length(speeds)[:, None]
    unit: FloatArray = speeds / np.where(lengths > 0, lengths, 1)
    return unit


def _length(vectors: FloatArray) -> FloatArray:
    lengths: FloatArray = np.sqrt((vectors * vectors).sum(axis=-1))
    return lengths


def _first_right(way: FloatArray, up: FloatArray) -> FloatArray:
    right = np.cross(way, up)
    if not _length(right) > 1e-9 * _length(up):
        right = np.cross(way, np.eye(3)[np.abs(way).argmin()])
    unit: FloatArray = right / _length(right)
    return unit


def _transported(
    places: FloatArray, ways: FloatArray, rights: FloatArray, to: FloatArray, way_there: FloatArray
) -> FloatArray:
    """Vectors (T, 3) across a way, carried to another place on it: reflected twice. [Wang08]"""
    chord = to - places
    squared = (chord * chord).sum(axis=1, keepdims=True)
    scale = 2 / np.where(squared > 0, squared, np.inf)
    mirrored = rights - scale * (chord * rights).sum(axis=1, keepdims=True) * chord
    way = ways - scale * (chord * ways).sum(axis=1, keepdims=True) * chord
    second = way_there - way
    squared = (second * second).sum(axis=1, keepdims=True)
    scale = 2 / np.where(squared > 0, squared, np.inf)
    carried = mirrored - scale * (second * mirrored).sum(axis=1, keepdims=True) * second
    # Rounding would let it lean into the way, step after step
    carried -= (carried * way_there).sum(axis=1, keepdims=True) * way_there
    unit: FloatArray = carried / _length(carried)[:, None]
    return unit
