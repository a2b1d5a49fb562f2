"""Towards a sphere around the origin.

Point       p' = g p,   g = 1 - f + f R / |p|
Jacobian    g I - h p p^T,   h = f R / |p|^3
Determinant g^2 (1 - f): done wholly, all space is on the sphere, and has no volume.

The origin itself, which is nearest to all of the sphere, stays.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from eyeline.deform.block import SIZE, WIDTH
from eyeline.deform.deformer import Deformer
from eyeline.deform.plan import Plan
from eyeline.errors import GeometryError
from eyeline.jit import kernel


@dataclass(frozen=True, eq=False)
class Spherify(Deformer):
    """Moves points straight towards a sphere around its origin."""

    kind: ClassVar[str] = "spherify"

    amount: float = 0.0  # 0 leaves all as it is, 1 brings all onto the sphere
    radius: float = 1.0  # metres

    def __post_init__(self) -> None:
        """Refuse spheres of no size."""
        super().__post_init__()
        if not self.radius > 0:
            raise GeometryError(f"{self.label}: radius is {self.radius:g}; it must be above 0")

    def act(self, plan: Plan) -> None:
        """One kernel."""
        if self.amount != 0:
            plan.run(spherify, float(self.amount), float(self.radius))


@kernel
def spherify(state, amount, radius):
    """Blocks of vertices, in place."""
    for block in range(len(state) // SIZE):
        m = state[block * SIZE : (block + 1) * SIZE]
        for i in range(WIDTH):
            x, y, z = m[i], m[i + WIDTH], m[i + 2 * WIDTH]
            square = x * x + y * y + z * z
            away = np.sqrt(square)
            pull = amount * radius / away if away > 0.0 else amount
            g = 1.0 - amount + pull
            h = pull / square if away > 0.0 else 0.0
            m[i], m[i + WIDTH], m[i + 2 * WIDTH] = g * x, g * y, g * z
            for j in range(3, 6):
                p = i + j * WIDTH
                ax, ay, az = m[p], m[p + 3 * WIDTH], m[p + 6 * WIDTH]
                along = h * (x * ax + y * ay + z * az)
                m[p] = g * ax - along * x
                m[p + 3 * WIDTH] = g * ay - along * y
                m[p + 6 * WIDTH] = g * az - along * z
