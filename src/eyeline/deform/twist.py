"""Wringing: cross-sections turn about the axis, the farther along the more. [Barr84, sec. 3.2]

Point       x' = x cos t + z sin t,   y' = y,   z' = z cos t - x sin t,   t = k y
Jacobian    | cos t    k z'   sin t |
            |   0       1       0   |
            | -sin t  -k x'   cos t |
Determinant 1: a twist keeps every volume.

k is the angle over the length; beyond a limit y is the limit in t, and k is 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from eyeline.deform.block import SIZE, WIDTH
from eyeline.deform.limits import Limited
from eyeline.deform.plan import Plan
from eyeline.geometry.circle import sine_cosine
from eyeline.jit import kernel


@dataclass(frozen=True, eq=False)
class Twist(Limited):
    """Turns cross-sections about the axis, steadily from limit to limit, by the right hand along the axis."""

    kind: ClassVar[str] = "twist"

    angle: float = 0.0  # radians from the lower limit to the upper

    def act(self, plan: Plan) -> None:
        """One kernel."""
        if self.angle != 0:
            plan.run(twist, self.rate(self.angle), *self.bounds())


@kernel
def twist(state, rate, lower, upper):
    """Blocks of vertices, in place."""
    for block in range(len(state) // SIZE):
        m = state[block * SIZE : (block + 1) * SIZE]
        for i in range(WIDTH):
            x, y, z = m[i], m[i + WIDTH], m[i + 2 * WIDTH]
            inside = min(max(y, lower), upper)
            s, c = sine_cosine(rate * inside)
            k = rate if inside == y else 0.0
            new_x, new_z = c * x + s * z, c * z - s * x
            m[i], m[i + 2 * WIDTH] = new_x, new_z
            for j in range(3, 6):
                p = i + j * WIDTH
                ax, ay, az = m[p], m[p + 3 * WIDTH], m[p + 6 * WIDTH]
                m[p] = c * ax + s * az + k * new_z * ay
                m[p + 6 * WIDTH] = c * az - s * ax - k * new_x * ay
