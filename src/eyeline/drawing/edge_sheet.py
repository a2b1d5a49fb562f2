"""A sheet of edges, seen and hidden, as a method that answers lines finds them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from eyeline.drawing.pens import HIDDEN, PICTURE_HEIGHT, VISIBLE
from eyeline.drawing.sheet import PARTS, Group, Sheet
from eyeline.visibility.visible_edges import VisibleEdges


def sheet_of_edges(edges: VisibleEdges, names: Sequence[str], hidden: bool = False, title: str = "") -> Sheet:
    """Every piece of an edge, node after node, the hidden ones under the seen ones.

    names: of the scene's nodes. hidden: whether hidden pieces are drawn, dashed.
    """
    size = edges.projected.width, edges.projected.height
    parts = [(False, edges.hidden, edges.hidden_edge)] if hidden else []
    parts.append((True, edges.segments, edges.edge))
    groups = []
    for node in np.unique(edges.node).tolist():
        for seen, pixels, edge in parts:
            points = np.rint(pixels[edges.node[edge] == node] * PARTS).astype(np.int64)
            paths = tuple(points[(points[:, 0] != points[:, 1]).any(axis=1)])
            pen = (VISIBLE if seen else HIDDEN)["crease"].scaled(size[1] / PICTURE_HEIGHT)
            if paths:
                groups.append(Group(names[node], "edge", seen, pen, paths))
    return Sheet(size, tuple(groups), title)
