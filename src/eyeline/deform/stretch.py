"""Squash and stretch: longer along the axis and thinner across it, or shorter and thicker.

Point       x' = m x,   y' = a y,   z' = m z,   m = c (1 - w (1 - u^2)),   c = a^(-v/2)
Jacobian    | m  n x  0 |
            | 0   a   0 |    n = dm / dy
            | 0  n z  m |
Determinant a m^2; with v = 1 and w = 0 that is 1, and every volume is kept.

a is 1 + amount; v how much of the volume is kept; u runs from -1 to 1 between the limits, so that w is how
much thinner the waist is than the ends. Beyond a limit the shape is as thick as there and as long as it was.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from eyeline.deform.block import SIZE, WIDTH
from eyeline.deform.limits import Limited
from eyeline.deform.plan import Plan
from eyeline.errors import GeometryError
from eyeline.jit import kernel


@dataclass(frozen=True, eq=False)
class Stretch(Limited):
    """Makes the shape longer between its limits, or shorter, and thinner or thicker for it."""

    kind: ClassVar[str] = "stretch"

    amount: float = 0.0  # what its length gains: 0.5 is half as long again, -0.5 is squashed to the half
    volume: float = 1.0  # how far the thickness makes up for it: 1 keeps the volume, 0 the thickness
    waist: float = 0.0  # how much thinner it is halfway than at the limits; below 0 it has a belly

    def __post_init__(self) -> None:
        """Refuse to squash to nothing."""
        super().__post_init__()
        if not self.amount > -1:
            raise GeometryError(
                f"{self.label}: amount is {self.amount:g}; it must be above -1, which is no length"
            )

    def act(self, plan: Plan) -> None:
        """One kernel."""
        if self.amount != 0 or self.waist != 0:
            longer = 1 + float(self.amount)
            plan.run(stretch, longer, longer ** (-self.volume / 2), float(self.waist), *self.bounds())


@kernel
def stretch(state, longer, thicker, waist, lower, upper):
    """Blocks of vertices, in place."""
    middle, half = (lower + upper) / 2.0, (upper - lower) / 2.0
    for block in range(len(state) // SIZE):
        m = state[block * SIZE : (block + 1) * SIZE]
        for i in range(WIDTH):
            x, y, z = m[i], m[i + WIDTH], m[i + 2 * WIDTH]
            inside = min(max(y, lower), upper)
            u = (inside - middle) / half
            s = thicker * (1.0 - waist * (1.0 - u * u))
            k = thicker * waist * 2.0 * u / half if inside == y else 0.0
            a = longer if inside == y else 1.0
            m[i], m[i + WIDTH], m[i + 2 * WIDTH] = s * x, longer * inside + (y - inside), s * z
            for j in range(3, 6):
                p = i + j * WIDTH
                ay = m[p + 3 * WIDTH]
                m[p] = s * m[p] + k * x * ay
                m[p + 3 * WIDTH] = a * ay
                m[p + 6 * WIDTH] = s * m[p + 6 * WIDTH] + k * z * ay
