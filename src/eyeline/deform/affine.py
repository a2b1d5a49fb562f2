"""Deformers that are one matrix: those that follow each other are multiplied, and cost as much as one."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass

import numpy as np

from eyeline.deform.deformer import Deformer
from eyeline.deform.plan import Plan
from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray


@dataclass(frozen=True, eq=False, kw_only=True)
class Affine(Deformer):
    """Moves all points by one matrix; lines stay lines, and what is parallel stays so."""

    @property
    @abstractmethod
    def own(self) -> FloatArray:
        """(4, 4) what it does, in its own frame."""

    @property
    def matrix(self) -> FloatArray:
        """(4, 4) what it does, in the space of the mesh: matrices multiply, the first to be done last."""
        place = self.deformer_from_mesh
        inner = transform.product(self.own, place)
        return transform.product(transform.inverse(place), inner)

    def act(self, plan: Plan) -> None:
        """Its matrix, folded into whatever else is pending."""
        if not np.array_equal(self.own, np.eye(4)):
            plan.turn(self.own)
