"""Scan line: row by row, active edges sorted by column, and spans in which one face is nearest.

[Wylie67, Bouknight70, Watkins70], compared in [Survey74].
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from eyeline.geometry.memory import recycled
from eyeline.projection.projected import Projected
from eyeline.visibility.edge_table import edge_table
from eyeline.visibility.method import Step
from eyeline.visibility.spans import Scanned
from eyeline.visibility.sweep import scan

WORK = (
    "faces",
    "faces turned away",
    "faces beside pixels",
    "edges",
    "most edges active",
    "spans",
    "depth comparisons",
)


@dataclass(frozen=True)
class ScanLine:
    """Scan line: answers every scene, a row at a time, and compares faces where they begin, not at pixels."""

    name: str = "scanline"
    space: str = "image"
    answers: bool = True
    exact: bool = True

    def __call__(self, projected: Projected) -> Scanned:
        """The nearest face at every pixel, found span by span."""
        face = recycled((projected.height, projected.width), np.int32)
        depth = recycled((projected.height, projected.width), np.float32)
        table = edge_table(projected)
        counts = scan(projected, table, face, depth)
        numbers = (len(projected.faces), table.turned, table.beside, table.edges, *counts.tolist())
        return Scanned(face, depth, projected, self, dict(zip(WORK, numbers, strict=True)))

    def steps(self, projected: Projected) -> Iterator[Step]:
        """Row by row."""
        yield from ()
