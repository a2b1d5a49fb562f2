"""A stack of deformers as steps over blocks of vertices, with what lies between two steps folded into one."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from eyeline.deform.block import Work, fade, mix, turn
from eyeline.errors import GeometryError
from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray

Step = Callable[[Work], None]


@dataclass
class Plan:
    """What is to be done with every batch, as deformers add to it."""

    steps: list[Step] = field(default_factory=list)
    root: FloatArray = field(default_factory=transform.identity)  # (4, 4) what places count from, from mesh
    frame: FloatArray = field(default_factory=transform.identity)  # (4, 4) where points stand, from mesh
    pending: FloatArray = field(default_factory=transform.identity)  # (4, 4) still to be done with the points
    mirrored: bool = False  # whether the whole shape is turned inside out
    width: int = 0  # vertices the arrays of deformers have; 0 where none has any

    def enter(self, place: FloatArray) -> None:
        """Go on in the frame place (4, 4), as seen from the root."""
        self.go(transform.product(place, self.root))

    def go(self, frame: FloatArray) -> None:
        """Go on in a frame (4, 4), from the mesh."""
        if not np.array_equal(frame, self.frame):
            change = transform.product(frame, transform.inverse(self.frame))
            self.pending = transform.product(change, self.pending)
            self.frame = frame

    def turn(self, matrix: FloatArray) -> None:
        """Move everything by an affine matrix (4, 4) of the present frame."""
        self.pending = transform.product(matrix, self.pending)
        self.mirrored ^= transform.is_mirror(matrix)

    def flush(self) -> None:
        """Do what is pending."""
        if not np.array_equal(self.pending, np.eye(4)):
            matrix = np.ascontiguousarray(self.pending[:3]).reshape(-1)
            self.steps.append(lambda work: turn(work.state, matrix))
            self.pending = transform.identity()

    def do(self, step: Step) -> None:
        """Have a step done, in the present frame."""
        self.flush()
        self.steps.append(step)

    def run(self, kernel: Callable[..., None], *arguments: Any) -> None:
        """Have `kernel(state, *arguments)` done, in the present frame."""
        self.do(lambda work: kernel(work.state, *arguments))

    def keep(self) -> None:
        """Remember the points, to be mixed with what becomes of them."""
        self.do(Work.keep)

    def mix(self, weight: float, mask: FloatArray | None, reach: float) -> None:
        """Mix the points kept last with what became of them: by weight, times a mask (V,), within reach."""
        weights = None if mask is None else np.ascontiguousarray(mask, np.float64) * weight
        if weights is not None:
            self.expect(len(weights), "a mask")

        def step(work: Work) -> None:
            work.weigh(weight if weights is None else weights[work.begin : work.end])
            kept = work.kept.pop()
            if reach < math.inf:
                fade(kept, reach, work.influence)
            mix(work.state, kept, work.influence)

        self.do(step)

    def expect(self, width: int, what: str) -> None:
        """Note that an array of a deformer holds a row for each of `width` vertices."""
        if self.width not in (0, width):
            raise GeometryError(f"{what} has {width} rows where another deformer has {self.width}")
        self.width = width

    def steps_for(self, count: int) -> list[Step]:
        """All steps, back to the mesh's own frame, for a mesh of `count` vertices."""
        if self.width not in (0, count):
            raise GeometryError(f"a deformer was made for {self.width} vertices; there are {count}")
        self.go(transform.identity())
        self.flush()
        return self.steps
