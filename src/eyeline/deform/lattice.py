"""Free-form deformation: a box of control points, and all that is in it follows them. [Sederberg86]

Point       p' = p + d(u),   d(u) = sum of B_i(u_x) B_j(u_y) B_k(u_z) o_ijk
Jacobian    I + the derivatives of d, by those of B

u is the place in the box; o is how far a control point was moved from its place in the regular grid, so that
a lattice at rest moves nothing at all. B are Bernstein's polynomials, of a degree one less than there are
points along the axis: every point is felt everywhere. Or they are the pieces of a uniform cubic B-spline,
with its ends repeated, each point felt two cells far: what Blender does. Outside the box d stays as it is on
its surface (the B-spline's for one more cell moves on), and fades over a distance of choice.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import ClassVar, Self

import numpy as np
import numpy.typing as npt

from eyeline.deform.block import SIZE, WIDTH
from eyeline.deform.deformer import Deformer, Vector
from eyeline.deform.plan import Plan
from eyeline.errors import GeometryError
from eyeline.geometry.arrays import FloatArray
from eyeline.jit import kernel

BASES = ("bernstein", "bspline")
PART = 64  # vertices whose sums stay in the nearest cache
TAPS = 4  # control points summed at once; the last axis is filled up to a multiple of them
PAIR = 2 * PART  # a row of weights, and a row of their slopes


@dataclass(frozen=True, eq=False)
class Lattice(Deformer):
    """Lets points follow the control points of a grid around them, smoothly.

    Made by `Lattice.of((4, 4, 4))`, or `.around(points, (4, 4, 4))`; moved by `.to(points)` or its offsets.
    """

    kind: ClassVar[str] = "lattice"

    offsets: FloatArray = field(
        default_factory=lambda: np.zeros((2, 2, 2, 3))
    )  # (a, b, c, 3) metres, from rest
    lower: Vector = (-0.5, -0.5, -0.5)  # metres, a corner of the box, in its own frame
    upper: Vector = (0.5, 0.5, 0.5)  # metres, the opposite corner
    basis: str = "bernstein"  # or "bspline"
    fade: float = math.inf  # metres outside the box over which what it does comes to an end

    def __post_init__(self) -> None:
        """Refuse grids without cells, and boxes without room."""
        super().__post_init__()
        shape = np.shape(self.offsets)
        if len(shape) != 4 or shape[3] != 3 or min(shape) < 2:
            size = " x ".join(map(str, shape[:3]))
            raise GeometryError(f"{self.label} is {size}; 2 points or more along three axes are needed")
        if self.basis not in BASES:
            raise GeometryError(f"{self.label}: basis is {self.basis!r}; there are {', '.join(BASES)}")
        if not (np.asarray(self.lower) < self.upper).all():
            raise GeometryError(f"{self.label}: the box from {self.lower} to {self.upper} has no room inside")
        if not self.fade >= 0:
            raise GeometryError(f"{self.label}: fade is {self.fade:g}; it must be 0 or more")

    @classmethod
    def of(cls, resolution: tuple[int, int, int], **values: object) -> Self:
        """At rest, with so many control points along x, y and z."""
        return cls(np.zeros((*resolution, 3)), **values)  # type: ignore[arg-type]

    @classmethod
    def around(cls, points: npt.ArrayLike, resolution: tuple[int, int, int], **values: object) -> Self:
        """At rest, its box the one around points (V, 3), as they stand in the space of the mesh."""
        corners = np.asarray(points, np.float64)
        lower, upper = corners.min(axis=0), corners.max(axis=0)
        # A flat shape needs some room around it as well
        room = np.where(upper > lower, 0, (upper - lower).max() / 2 or 0.5)
        box = {"lower": tuple((lower - room).tolist()), "upper": tuple((upper + room).tolist())}
        return cls.of(resolution, **{**box, **values})

    @property
    def rest(self) -> FloatArray:
        """(a, b, c, 3) where the control points are at rest, in its own frame."""
        lines = [
            np.linspace(low, high, count)
            for low, high, count in zip(self.lower, self.upper, np.shape(self.offsets)[:3], strict=True)
        ]
        return np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1)

    @property
    def points(self) -> FloatArray:
        """(a, b, c, 3) where the control points are, in its own frame."""
        return self.rest + self.offsets

    def to(self, points: npt.ArrayLike) -> Self:
        """With its control points at `points` (a, b, c, 3), in its own frame."""
        return replace(self, offsets=np.asarray(points, np.float64) - self.rest)

    def act(self, plan: Plan) -> None:
        """One kernel, whatever the resolution."""
        offsets = np.asarray(self.offsets, np.float64)
        if not offsets.any():
            return
        a, b, c = offsets.shape[:3]
        filled = np.zeros((a, b, -(-c // TAPS) * TAPS, 3))
        filled[:, :, :c] = offsets
        box = np.concatenate([self.lower, self.upper]).astype(np.float64)
        spline = self.basis == "bspline"
        plan.run(lattice, filled.reshape(-1), np.array([a, b, c]), box, float(self.fade), spline)


@kernel
def lattice(state, offsets, counts, box, distance, spline):
    """Blocks of vertices, in place, PART at a time; offsets (a, b, c, 3) flat, c filled up."""
    filled = (counts[2] + TAPS - 1) // TAPS * TAPS
    reach = max(counts[0], counts[1], filled) * PAIR
    tables = np.empty(3 * reach)
    sums = np.empty(23 * PART)
    bounds = np.empty(6, np.int64)
    place, rate = sums[21 * PART : 22 * PART], sums[22 * PART :]
    for part in range(len(state) // SIZE * (WIDTH // PART)):
        block, step = part // (WIDTH // PART), part % (WIDTH // PART)
        m = state[block * SIZE + step * PART : (block + 1) * SIZE]

        # What every control point along an axis counts, and the slope of that
        for axis in range(3):
            n = counts[axis]
            table = tables[axis * reach : (axis + 1) * reach]
            row = m[axis * WIDTH : axis * WIDTH + PART]
            low, size = box[axis], box[axis + 3] - box[axis]
            # A B-spline is measured in cells, and is felt one cell around the grid
            first, last, scale = (-1.0, float(n), n - 1.0) if spline else (0.0, 1.0, 1.0)
            for i in range(PART):
                u = (row[i] - low) / size * scale
                place[i] = min(max(u, first), last)
                rate[i] = (n - 1.0) / size if place[i] == u else 0.0
            table[:] = 0.0
            if spline:
                # Only points that some vertex of the part feels; the ends stand twice more outside the grid
                low, high = place.min(), place.max()
                begin, end = int(np.floor(low)) - 1, int(np.floor(high)) + 3
                bounds[2 * axis], bounds[2 * axis + 1] = max(begin, 0), min(end, n)
                for k in range(max(begin, -2), min(end, n + 2)):
                    at = min(max(k, 0), n - 1) * PAIR
                    here = table[at : at + PAIR]
                    for i in range(PART):
                        t = place[i] - k
                        far, near = max(2.0 - abs(t), 0.0), max(1.0 - abs(t), 0.0)
                        slope = 2.0 * near * near - 0.5 * far * far
                        here[i] += (far * far * far - 4.0 * near * near * near) / 6.0
                        here[i + PART] += rate[i] * (slope if t > 0.0 else -slope)
            else:
                bounds[2 * axis], bounds[2 * axis + 1] = 0, n
                table[:PART] = 1.0
                # Degree by degree; slopes are differences of the weights of one degree less
                for degree in range(1, n):
                    for k in range(degree, -1, -1):
                        here = table[k * PAIR : (k + 1) * PAIR]
                        before = table[(k - 1) * PAIR : k * PAIR] if k > 0 else sums[:0]
                        if degree == n - 1:
                            for i in range(PART):
                                less = before[i] if k > 0 else 0.0
                                here[i + PART] = rate[i] * (less - here[i])
                        for i in range(PART):
                            less = place[i] * before[i] if k > 0 else 0.0
                            here[i] = (1.0 - place[i]) * here[i] + less

        # Sums over points along z and y into nine rows: d, its slopes along y, and along z; then over x
        sums[: 12 * PART] = 0.0
        for a in range(bounds[0], bounds[1]):
            d = sums[12 * PART : 21 * PART]
            d[:] = 0.0
            for b in range(bounds[2], bounds[3]):
                y = tables[reach + b * PAIR : reach + (b + 1) * PAIR]
                for c in range(bounds[4] // TAPS * TAPS, bounds[5], TAPS):
                    z = tables[2 * reach + c * PAIR : 2 * reach + (c + TAPS) * PAIR]
                    o = offsets[((a * counts[1] + b) * filled + c) * 3 :]
                    x0, y0, z0, x1, y1, z1 = o[0], o[1], o[2], o[3], o[4], o[5]
                    x2, y2, z2, x3, y3, z3 = o[6], o[7], o[8], o[9], o[10], o[11]
                    for i in range(PART):
                        w0, w1, w2, w3 = z[i], z[i + 2 * PART], z[i + 4 * PART], z[i + 6 * PART]
                        s0, s1, s2, s3 = z[i + PART], z[i + 3 * PART], z[i + 5 * PART], z[i + 7 * PART]
                        w, slope = y[i], y[i + PART]
                        here = (x0 * w0 + x1 * w1) + (x2 * w2 + x3 * w3)
                        d[i] += w * here
                        d[i + PART] += slope * here
                        d[i + 2 * PART] += w * ((x0 * s0 + x1 * s1) + (x2 * s2 + x3 * s3))
                        here = (y0 * w0 + y1 * w1) + (y2 * w2 + y3 * w3)
                        d[i + 3 * PART] += w * here
                        d[i + 4 * PART] += slope * here
                        d[i + 5 * PART] += w * ((y0 * s0 + y1 * s1) + (y2 * s2 + y3 * s3))
                        here = (z0 * w0 + z1 * w1) + (z2 * w2 + z3 * w3)
                        d[i + 6 * PART] += w * here
                        d[i + 7 * PART] += slope * here
                        d[i + 8 * PART] += w * ((z0 * s0 + z1 * s1) + (z2 * s2 + z3 * s3))
            along = tables[a * PAIR : (a + 1) * PAIR]
            for r in range(3):
                e = d[r * 3 * PART : (r + 1) * 3 * PART]
                total = sums[r * 4 * PART : (r + 1) * 4 * PART]
                for i in range(PART):
                    total[i] += along[i] * e[i]
                    total[i + PART] += along[i + PART] * e[i]
                    total[i + 2 * PART] += along[i] * e[i + PART]
                    total[i + 3 * PART] += along[i] * e[i + 2 * PART]

        # Fading outside the box
        if distance < np.inf:
            for i in range(PART):
                x = m[i] - min(max(m[i], box[0]), box[3])
                y = m[i + WIDTH] - min(max(m[i + WIDTH], box[1]), box[4])
                z = m[i + 2 * WIDTH] - min(max(m[i + 2 * WIDTH], box[2]), box[5])
                away = np.sqrt(x * x + y * y + z * z)
                t = min(away / distance, 1.0) if away > 0.0 else 0.0
                left = (1.0 - t) * (1.0 - t) * (1.0 + 2.0 * t)
                slope = 6.0 * (t - 1.0) / (distance * distance) if t < 1.0 and distance > 0.0 else 0.0
                for r in range(0, 12 * PART, 4 * PART):
                    moved = sums[r + i] * slope
                    sums[r + i] *= left
                    sums[r + PART + i] = sums[r + PART + i] * left + moved * x
                    sums[r + 2 * PART + i] = sums[r + 2 * PART + i] * left + moved * y
                    sums[r + 3 * PART + i] = sums[r + 3 * PART + i] * left + moved * z

        for k in range(3, 6):
            col = m[k * WIDTH : (k + 6) * WIDTH + PART]
            for i in range(PART):
                x, y, z = col[i], col[i + 3 * WIDTH], col[i + 6 * WIDTH]
                col[i] += sums[i + PART] * x + sums[i + 2 * PART] * y + sums[i + 3 * PART] * z
                col[i + 3 * WIDTH] += sums[i + 5 * PART] * x + sums[i + 6 * PART] * y + sums[i + 7 * PART] * z
                col[i + 6 * WIDTH] += (
                    sums[i + 9 * PART] * x + sums[i + 10 * PART] * y + sums[i + 11 * PART] * z
                )
        for i in range(PART):
            m[i] += sums[i]
            m[i + WIDTH] += sums[i + 4 * PART]
            m[i + 2 * WIDTH] += sums[i + 8 * PART]
