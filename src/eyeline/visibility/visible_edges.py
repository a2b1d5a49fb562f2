"""The answer of a method that sees lines: which parts of which edges are seen."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from eyeline.cached import cached_property
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.projection.projected import Projected

if TYPE_CHECKING:
    from eyeline.visibility.method import Method


@dataclass(frozen=True, eq=False)
class VisibleEdges:
    """Edges of a picture, cut into what is seen of them and what is not; all of it within the picture."""

    segments: FloatArray  # (N, 2, 2) float64 pixels, x right, y down: seen, edge after edge
    edge: IntArray  # (N,) int32: the edge each is a part of
    hidden: FloatArray  # (M, 2, 2) pixels: behind something, or of faces that all turn away
    hidden_edge: IntArray  # (M,) int32
    vertices: IntArray  # (E, 2) int32: the picture's vertices at the ends of each edge
    faces: IntArray  # (E, 2) int32: the scene faces that meet at each edge; -1 is none
    projected: Projected
    method: Method
    work: Mapping[str, int]  # counters

    @cached_property
    def node(self) -> IntArray:
        """(E,) int32: the node of each edge."""
        from eyeline.visibility.method import nodes_of

        return nodes_of(self.faces[:, 0].copy(), self.projected)
