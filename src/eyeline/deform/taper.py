"""Tapering: cross-sections grow or shrink along the axis. [Barr84, sec. 3.1]

Point       x' = s x,   y' = y,   z' = s z,   s = 1 + k y
Jacobian    | s  k x  0 |
            | 0   1   0 |
            | 0  k z  s |
Determinant s^2.

k is the amount over the length; beyond a limit y is the limit in s, and k is 0. Where s falls below 0 the
shape comes out on the other side of its axis.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from eyeline.deform.block import SIZE, WIDTH
from eyeline.deform.limits import Limited
from eyeline.deform.plan import Plan
from eyeline.jit import kernel


@dataclass(frozen=True, eq=False)
class Taper(Limited):
    """Scales cross-sections, steadily from limit to limit; that at the origin keeps its size."""

    kind: ClassVar[str] = "taper"

    amount: float = 0.0  # what the scale of cross-sections gains from the lower limit to the upper

    def act(self, plan: Plan) -> None:
        """One kernel."""
        if self.amount != 0:
            plan.run(taper, self.rate(self.amount), *self.bounds())


@kernel
def taper(state, rate, lower, upper):
    """Blocks of vertices, in place."""
    for block in range(len(state) // SIZE):
        m = state[block * SIZE : (block + 1) * SIZE]
        for i in range(WIDTH):
            x, y, z = m[i], m[i + WIDTH], m[i + 2 * WIDTH]
            inside = min(max(y, lower), upper)
            s = 1.0 + rate * inside
            k = rate if inside == y else 0.0
            m[i], m[i + 2 * WIDTH] = s * x, s * z
            for j in range(3, 6):
                p = i + j * WIDTH
                ay = k * m[p + 3 * WIDTH]
                m[p] = s * m[p] + x * ay
                m[p + 6 * WIDTH] = s * m[p + 6 * WIDTH] + z * ay
