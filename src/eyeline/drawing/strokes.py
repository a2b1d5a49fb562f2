"""Straight pieces whose visibility is asked for, and where they end."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.drawing.grid import Grid
from eyeline.drawing.model import Model
from eyeline.geometry.arrays import ByteArray, FloatArray, IntArray
from eyeline.geometry.weld import first_alike
from eyeline.projection.clipping import crossing


@dataclass(frozen=True, eq=False)
class Strokes:
    """Straight pieces in eye space and on the grid."""

    points: FloatArray  # (S, 2, 3) float64 their ends, eye space
    screen: FloatArray  # (S, 2, 3) their ends on the grid; of one that must be cut, not yet
    kind: ByteArray  # (S,) OUTLINE, BOUNDARY ...
    surface: IntArray  # (S,) the surface it is drawn for
    own: IntArray  # (S, 2) int32: faces the stroke lies in; -1 is none
    touch: IntArray  # (S, 4) int32: under each end the edge it lies on, as two vertices; a vertex, twice
    name: IntArray  # (S, 2) int64: ends of the same name are at the same place; -1 is a cut end

    def pick(self, rows: IntArray) -> Strokes:
        """Some of them."""
        return Strokes(
            self.points[rows], self.screen[rows], self.kind[rows], self.surface[rows],
            self.own[rows], self.touch[rows], self.name[rows],
        )  # fmt: skip


def edge_strokes(model: Model, edges: IntArray, kind: ByteArray) -> Strokes:
    """Strokes along edges of the model."""
    ends, own = model.edges[edges, :2], model.edges[edges, 2:]
    return Strokes(
        model.points[ends], model.screen[ends], kind, model.surface[own[:, 0]],
        np.ascontiguousarray(own), ends[:, [0, 0, 1, 1]], ends.astype(np.int64),
    )  # fmt: skip


def joined(these: Strokes, those: Strokes) -> Strokes:
    """Both, one after the other."""
    pairs = zip(vars(these).values(), vars(those).values(), strict=True)
    return Strokes(*(np.concatenate(pair) for pair in pairs))


def cut_to(strokes: Strokes, grid: Grid) -> Strokes:
    """What of the strokes lies between near and far and within the guard band, all of it on the grid.

    They are cut where faces are: at the same points.
    """
    points = np.ones((len(strokes.kind), 2, 4))
    points[..., :3] = strokes.points
    placed = ~grid.place(strokes.points.reshape(-1, 3))[1].reshape(-1, 2)
    rows = np.flatnonzero(~placed.all(axis=1))
    ends, placed, alive = points[rows], placed[rows], np.ones(len(rows), bool)
    for a, b, c, d in grid.planes:
        reach = a * ends[..., 0] + b * ends[..., 1] + c * ends[..., 2] + d * ends[..., 3]
        reach = np.where(placed, np.maximum(reach, 0), reach)
        alive &= (reach >= 0).any(axis=1)
        between = (reach < 0).any(axis=1) & alive
        middle = crossing(ends[between, 0], ends[between, 1], reach[between, 0], reach[between, 1])
        ends[between] = np.where((reach[between] < 0)[..., None], middle[:, None], ends[between])
    moved = (ends != points[rows]).any(axis=-1)
    name, touch, cut = strokes.name.copy(), strokes.touch.copy(), strokes.points.copy()
    cut[rows] = ends[..., :3]
    name[rows] = np.where(moved, -1, name[rows])
    # A cut end of an edge lies on that edge; one of a crossing of faces, on none
    along = strokes.touch[rows][:, [0, 2]]
    on_edge = (strokes.touch[rows][:, [0, 2]] == strokes.touch[rows][:, [1, 3]]).all(axis=1)
    along = np.where(on_edge[:, None], along, -1)
    for end in range(2):
        spot = slice(2 * end, 2 * end + 2)
        touch[rows, spot] = np.where(moved[:, end, None], along, touch[rows, spot])
    screen = grid.place(cut.reshape(-1, 3))[0].reshape(-1, 2, 3)
    whole = Strokes(cut, screen, strokes.kind, strokes.surface, strokes.own, touch, name)
    kept = np.ones(len(strokes.kind), bool)
    kept[rows] = alive
    return whole.pick(np.flatnonzero(kept))


def once(strokes: Strokes) -> Strokes:
    """Strokes with the same ends only once: the first, in the order of kinds."""
    if len(strokes.kind) == 0:
        return strokes
    order = np.argsort(strokes.kind, kind="stable")
    screen = strokes.screen[order]
    first, second = screen[:, 0], screen[:, 1]
    swap = (first[:, 0] > second[:, 0]) | ((first[:, 0] == second[:, 0]) & (first[:, 1] > second[:, 1]))
    ends = np.where(swap[:, None, None], screen[:, ::-1], screen) + 0.0
    rows = np.ascontiguousarray(ends.reshape(len(order), 6)).view(np.int32)
    alone = first_alike(rows) == np.arange(len(order))
    return strokes.pick(np.sort(order[alone]))
