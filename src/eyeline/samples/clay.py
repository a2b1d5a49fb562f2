"""Clay: balls and limbs pressed together into one smooth, closed surface."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.geometry.bounds import Bounds
from eyeline.geometry.normals import unit
from eyeline.scene.material import DEFAULT, Material
from eyeline.scene.mesh import Mesh
from eyeline.shapes.grid import Grid
from eyeline.shapes.surface_nets import surface_net

Place = tuple[float, float, float]


@dataclass(frozen=True)
class Limb:
    """A round cone: all balls whose middles and radii run from one end's to the other's; metres.

    soft: how far it flows into what was there before it. colour: which of the materials its surface has.
    both_sides: there is another one, mirrored in x = 0.
    """

    start: Place
    end: Place
    radius: float
    end_radius: float
    soft: float = 0.02
    colour: int = 0
    both_sides: bool = False

    @property
    def bounds(self) -> Bounds:
        """The box around it, of its own side."""
        ends = np.array([self.start, self.end])
        radii = np.array([[self.radius], [self.end_radius]])
        return Bounds((ends - radii).min(axis=0), (ends + radii).max(axis=0))

    def distance(self, points: FloatArray) -> FloatArray:
        """(K,) metres from points (K, 3) to its surface, below 0 within."""
        a, way = np.array(self.start), np.subtract(self.end, self.start)
        length = float(np.sqrt((way * way).sum()))
        slope = (self.radius - self.end_radius) / length
        along = (points - a) @ way / length
        aside = np.sqrt(np.maximum(((points - a) ** 2).sum(axis=1) - along * along, 0))
        # Where the nearest ball's middle is: a cone's surface leans
        steep = slope / math.sqrt(1 - slope * slope)
        part = np.clip(along - aside * steep, 0, length)
        gap: FloatArray = np.hypot(along - part, aside) - (self.radius - slope * part)
        return gap


@dataclass(frozen=True)
class Ball:
    """An ellipsoid; fields as of Limb."""

    middle: Place
    radii: Place
    rotation: tuple[float, float, float, float] = quaternion.IDENTITY
    soft: float = 0.02
    colour: int = 0
    both_sides: bool = False

    @property
    def bounds(self) -> Bounds:
        """The box around it, of its own side."""
        turned = quaternion.to_matrix(np.array(self.rotation)) * np.array(self.radii)
        reach = np.sqrt((turned * turned).sum(axis=1))
        return Bounds(np.array(self.middle) - reach, np.array(self.middle) + reach)

    def distance(self, points: FloatArray) -> FloatArray:
        """(K,) metres from points (K, 3) to its surface, near it; below 0 within."""
        own = (points - np.array(self.middle)) @ quaternion.to_matrix(np.array(self.rotation))
        radii = np.array(self.radii)
        scaled = np.sqrt(((own / radii) ** 2).sum(axis=1))
        slope = np.sqrt(((own / radii**2) ** 2).sum(axis=1))
        # The first step of Newton's method, which is exact for a ball
        gap: FloatArray = np.where(
            slope > 0, scaled * (scaled - 1) / np.where(slope > 0, slope, 1), -radii.min()
        )
        return gap


Lump = Limb | Ball


def clay(
    lumps: Sequence[Lump], cell: float, materials: Sequence[Material] = (DEFAULT,), name: str = ""
) -> Mesh:
    """The surface of lumps, each pressed into those before it; in cells of `cell` metres.

    A face has the material of the lump it is nearest to.
    """
    grid = _grid(lumps, cell)
    axes = [grid.low[k] + grid.step * np.arange(grid.counts[k]) for k in range(3)]
    field = np.full(grid.counts, np.inf)
    for lump in lumps:
        sides = _sides(lump)
        boxes = [_within(axes, one, 2 * lump.soft + 3 * grid.step) for one in sides]
        before = [field[box].copy() for box in boxes]
        own = [
            one.distance(_points(axes, box)).reshape(field[box].shape)
            for one, box in zip(sides, boxes, strict=True)
        ]
        # Each side is pressed into what was there, and neither into the other
        for box, old, new in zip(boxes, before, own, strict=True):
            field[box] = np.minimum(field[box], pressed(old, new, lump.soft))
    net = surface_net(grid, np.minimum(field, 4 * grid.step).astype(np.float32).reshape(-1))
    colour = _colours(lumps, net.points[net.faces].mean(axis=1)) if len(materials) > 1 else None
    return Mesh(
        net.points, net.faces, unit(net.normals), materials=materials, face_material=colour, name=name
    )


def pressed(first: FloatArray, second: FloatArray, soft: float) -> FloatArray:
    """The lesser of two distances, rounded off where they differ by less than `soft`."""
    with np.errstate(invalid="ignore"):
        near = np.maximum(soft - np.abs(first - second), 0)
    near = np.where(np.isfinite(near), near, 0)
    joined: FloatArray = np.minimum(first, second) - near * near / (4 * max(soft, 1e-9))
    return joined


def _grid(lumps: Sequence[Lump], cell: float) -> Grid:
    """Points around all lumps; the plane x = 0 lies midway between two of them, so that sides are alike."""
    bounds = Bounds.empty()
    for lump in lumps:
        for one in _sides(lump):
            bounds = bounds.union(one.bounds)
    low, high = bounds.low - 4 * cell, bounds.high + 4 * cell
    if any(lump.both_sides for lump in lumps):
        half = math.ceil(max(-low[0], high[0]) / cell) + 0.5
        low[0], high[0] = -half * cell, half * cell
    counts = np.ceil((high - low) / cell - 0.25).astype(int) + 1
    return Grid(low, cell, (int(counts[0]), int(counts[1]), int(counts[2])))


def _sides(lump: Lump) -> tuple[Lump, ...]:
    return (lump, mirrored(lump)) if lump.both_sides else (lump,)


def mirrored(lump: Lump) -> Lump:
    """The lump on the other side of x = 0."""
    if isinstance(lump, Limb):
        return replace(lump, start=_across(lump.start), end=_across(lump.end))
    x, y, z, w = lump.rotation
    return replace(lump, middle=_across(lump.middle), rotation=(x, -y, -z, w))


def _across(place: Place) -> Place:
    return -place[0], place[1], place[2]


def _within(axes: Sequence[FloatArray], lump: Lump, margin: float) -> tuple[slice, slice, slice]:
    low, high = lump.bounds.low - margin, lump.bounds.high + margin
    ends = [np.searchsorted(axis, (low[k], high[k])) for k, axis in enumerate(axes)]
    return (slice(*ends[0]), slice(*ends[1]), slice(*ends[2]))


def _points(axes: Sequence[FloatArray], box: tuple[slice, slice, slice]) -> FloatArray:
    places = np.meshgrid(*(axis[part] for axis, part in zip(axes, box, strict=True)), indexing="ij")
    return np.stack([one.reshape(-1) for one in places], axis=1)


def _colours(lumps: Sequence[Lump], middles: FloatArray) -> IntArray:
    """(F,) the colour of the lump that each place is nearest to; of the last of equals."""
    best, colour = np.full(len(middles), np.inf), np.zeros(len(middles), dtype=np.int32)
    for lump in lumps:
        for one in _sides(lump):
            distance = one.distance(middles.astype(np.float64))
            nearer = distance <= best
            best, colour = np.where(nearer, distance, best), np.where(nearer, lump.colour, colour)
    return colour
