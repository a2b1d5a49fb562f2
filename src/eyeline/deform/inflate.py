"""A swelling around the origin, smooth and over at its radius.

Point       p' = g p,   g = 1 + a (1 - q)^2,   q = |p|^2 / R^2, no more than 1
Jacobian    g I - h p p^T,   h = 4 a (1 - q) / R^2
Determinant g^2 (g - h |p|^2).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from eyeline.deform.block import SIZE, WIDTH
from eyeline.deform.deformer import Deformer
from eyeline.deform.plan import Plan
from eyeline.errors import GeometryError
from eyeline.jit import kernel


@dataclass(frozen=True, eq=False)
class Inflate(Deformer):
    """Blows up what is around its origin, or draws it in."""

    kind: ClassVar[str] = "inflate"

    amount: float = 0.0  # how much farther from the origin what is near it comes: 1 is twice as far
    radius: float = 1.0  # metres; nothing beyond is moved

    def __post_init__(self) -> None:
        """Refuse a radius that holds nothing."""
        super().__post_init__()
        if not self.radius > 0:
            raise GeometryError(f"{self.label}: radius is {self.radius:g}; it must be above 0")

    def act(self, plan: Plan) -> None:
        """One kernel."""
        if self.amount != 0:
            plan.run(inflate, float(self.amount), float(self.radius))


@kernel
def inflate(state, amount, radius):
    """Blocks of vertices, in place."""
    for block in range(len(state) // SIZE):
        m = state[block * SIZE : (block + 1) * SIZE]
        for i in range(WIDTH):
            x, y, z = m[i], m[i + WIDTH], m[i + 2 * WIDTH]
            rest = 1.0 - min((x * x + y * y + z * z) / (radius * radius), 1.0)
            g = 1.0 + amount * rest * rest
            h = 4.0 * amount * rest / (radius * radius)
            m[i], m[i + WIDTH], m[i + 2 * WIDTH] = g * x, g * y, g * z
            for j in range(3, 6):
                p = i + j * WIDTH
                ax, ay, az = m[p], m[p + 3 * WIDTH], m[p + 6 * WIDTH]
                along = h * (x * ax + y * ay + z * az)
                m[p] = g * ax - along * x
                m[p + 3 * WIDTH] = g * ay - along * y
                m[p + 6 * WIDTH] = g * az - along * z
