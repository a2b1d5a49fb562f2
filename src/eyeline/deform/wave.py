"""A sine that runs along x and moves along the axis.

Point       x' = x,   y' = y + a sin(k x - p),   z' = z,   k = 2 pi / length
Jacobian    |         1          0  0 |
            | a k cos(k x - p)   1  0 |
            |         0          0  1 |
Determinant 1: a wave keeps every volume.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from eyeline.deform.block import SIZE, WIDTH
from eyeline.deform.deformer import Deformer
from eyeline.deform.plan import Plan
from eyeline.errors import GeometryError
from eyeline.geometry.circle import sine_cosine
from eyeline.jit import kernel


@dataclass(frozen=True, eq=False)
class Wave(Deformer):
    """Moves points along its axis as a wave that runs along its x; key the phase and it travels."""

    kind: ClassVar[str] = "wave"

    amplitude: float = 0.0  # metres
    length: float = 1.0  # metres from crest to crest
    phase: float = 0.0  # radians; a full turn is one length on

    def __post_init__(self) -> None:
        """Refuse waves of no length."""
        super().__post_init__()
        if not self.length > 0:
            raise GeometryError(f"{self.label}: length is {self.length:g}; it must be above 0")

    def act(self, plan: Plan) -> None:
        """One kernel."""
        if self.amplitude != 0:
            plan.run(wave, float(self.amplitude), 2 * math.pi / float(self.length), float(self.phase))


@kernel
def wave(state, amplitude, rate, phase):
    """Blocks of vertices, in place."""
    for block in range(len(state) // SIZE):
        m = state[block * SIZE : (block + 1) * SIZE]
        for i in range(WIDTH):
            s, c = sine_cosine(rate * m[i] - phase)
            m[i + WIDTH] += amplitude * s
            for j in range(3, 6):
                m[i + (j + 3) * WIDTH] += amplitude * rate * c * m[i + j * WIDTH]
