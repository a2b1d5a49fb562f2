"""Hidden lines against convex bodies: what of each edge do the inequalities of the bodies leave? [Roberts63]

The first of all hidden-line methods: each edge is put before each convex body, and the interval of it that
the body hides is solved for in closed form. It answers lines, not pixels.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from eyeline.projection.projected import Projected
from eyeline.visibility.method import Step
from eyeline.visibility.roberts.edge_steps import Segment, line_of, steps_of
from eyeline.visibility.roberts.hidden_spans import (
    BEHIND_ITSELF,
    TURNED_AWAY,
    Pieces,
    Question,
    pieces_of,
    question,
)
from eyeline.visibility.roberts.mesh_edges import edges_of
from eyeline.visibility.visible_edges import VisibleEdges

WORK = (
    "edges", "edges turned away", "edges behind their own body", "bodies", "edges against bodies",
    "pieces seen", "pieces hidden",
)  # fmt: skip


@dataclass(frozen=True)
class Roberts:
    """Roberts' hidden lines: the visible parts of the edges of every scene, in object space."""

    name: str = "roberts"
    space: str = "object"
    answers: bool = False
    exact: bool = False

    def __call__(self, projected: Projected) -> VisibleEdges:
        """Which parts of which edges are seen."""
        edges = edges_of(projected)
        asked = question(projected, edges)
        pieces = pieces_of(asked)
        return VisibleEdges(
            pieces.seen.reshape(-1, 2, 2), pieces.seen_edge,
            pieces.hidden.reshape(-1, 2, 2), pieces.hidden_edge,
            edges.edges[:, :2], edges.edges[:, 2:], projected, self, work_of(asked, pieces),
        )  # fmt: skip

    def steps(self, projected: Projected) -> Iterator[Step]:
        """Edge by edge, body by body: the inequalities that cut it, and what they leave."""
        edges = edges_of(projected)
        asked = question(projected, edges)
        work = dict.fromkeys(WORK, 0) | {"bodies": len(asked.bodies.owner)}
        parts: dict[str, list[Segment]] = {"segments": [], "hidden": []}
        for number, faces in enumerate(edges.edges[:, 2:].tolist()):
            for step in steps_of(line_of(asked, number, faces), asked, work):
                if step.data.get("settled"):
                    for name, found in parts.items():
                        found += step.data[name]
                yield step
        data = {name: np.array(found).reshape(-1, 2, 2) for name, found in parts.items()}
        yield Step("done", "every edge was put before every body near it", data, dict(work))


def work_of(asked: Question, pieces: Pieces) -> Mapping[str, int]:
    """The counters, named."""
    numbers = (
        len(asked.ends), (asked.fate == TURNED_AWAY).sum(), (asked.fate == BEHIND_ITSELF).sum(),
        len(asked.bodies.owner), pieces.tests, len(pieces.seen), len(pieces.hidden),
    )  # fmt: skip
    return {name: int(number) for name, number in zip(WORK, numbers, strict=True)}
