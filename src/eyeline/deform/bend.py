"""Bending: the axis becomes an arc of a circle, as long as it was. [Barr84, sec. 3.3]

Point       x' = x cos t + y (1 - cos t) / t,   y' = y sin t / t - x sin t,   z' = z,   t = k y
Jacobian    |  cos t   (1 - k x) sin t   0 |
            | -sin t   (1 - k x) cos t   0 |
            |    0            0          1 |
Determinant 1 - k x: what lies inside the arc is pressed, what lies outside is drawn, the axis is neither.

k is the angle over the length, one over the radius of the arc. Beyond a limit the shape is turned stiffly, by
the t of the limit. With t = 0 the quotients are 0 and 1, which are their limits: the identity, exactly.
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
class Bend(Limited):
    """Bends its axis to an arc between the limits, towards its x."""

    kind: ClassVar[str] = "bend"

    angle: float = 0.0  # radians from the lower limit to the upper

    def act(self, plan: Plan) -> None:
        """One kernel."""
        if self.angle != 0:
            plan.run(bend, self.rate(self.angle), *self.bounds())


@kernel
def bend(state, rate, lower, upper):
    """Blocks of vertices, in place."""
    for block in range(len(state) // SIZE):
        m = state[block * SIZE : (block + 1) * SIZE]
        for i in range(WIDTH):
            x, y = m[i], m[i + WIDTH]
            inside = min(max(y, lower), upper)
            beyond = y - inside
            t = rate * inside
            s, c = sine_cosine(t)
            # 1 - cos t without loss: sin^2 t / (1 + cos t) where cos t is near 1
            rise = s * s / (1.0 + c) if c > 0.0 else 1.0 - c
            along = s / t if t != 0.0 else 1.0
            across = rise / t if t != 0.0 else 0.0
            m[i] = x * c + inside * across + beyond * s
            m[i + WIDTH] = inside * along - x * s + beyond * c
            stretch = 1.0 - rate * x if beyond == 0.0 else 1.0
            for j in range(3, 6):
                p = i + j * WIDTH
                ax, ay = m[p], stretch * m[p + 3 * WIDTH]
                m[p] = c * ax + s * ay
                m[p + 3 * WIDTH] = c * ay - s * ax
