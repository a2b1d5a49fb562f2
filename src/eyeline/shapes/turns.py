"""What happens to each face from shape to shape: a stretch, then a turn about an axis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import breadth_first_order
from scipy.spatial.transform import Rotation

from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.geometry.normals import face_normals, unit

TURN = 2 * np.pi


@dataclass(frozen=True, eq=False)
class Turns:
    """The polar decomposition of each face's map, ready to be done in part."""

    turn: FloatArray  # (F, 3) radians about the direction it has
    stretch: FloatArray  # (F, 3, 3) symmetric

    @classmethod
    def between(cls, start: FloatArray, end: FloatArray, faces: IntArray) -> Turns:
        """Of faces (F, 3) whose points move from start (S, 3) to end; unit normals go to unit normals."""
        maps = frames(end, faces) @ np.linalg.inv(frames(start, faces))
        u, _, v = np.linalg.svd(maps)
        # A face that loses its area in the end could be mirrored as well: it is not
        u[..., 2] *= np.sign(np.linalg.det(u @ v))[:, None]
        rotation = u @ v
        stretch = np.swapaxes(rotation, 1, 2) @ maps
        vectors = Rotation.from_matrix(rotation).as_rotvec()
        return cls(coherent(vectors, faces), stretch)

    def at(self, part: float) -> FloatArray:
        """(F, 3, 3) the map of each face at a part of the way."""
        turned = Rotation.from_rotvec(part * self.turn).as_matrix()
        maps: FloatArray = turned @ ((1 - part) * np.eye(3) + part * self.stretch)
        return maps


def frames(points: FloatArray, faces: IntArray) -> FloatArray:
    """(F, 3, 3) columns: two edges and the unit normal of each face."""
    a, b, c = (points[faces[:, k]] for k in range(3))
    return np.stack([b - a, c - a, face_normals(points, faces)], axis=-1)


def coherent(turns: FloatArray, faces: IntArray) -> FloatArray:
    """Turns (F, 3), whole ones added where that brings a face nearer to the neighbour it is reached from.

    So a bar that is twisted twice is untwisted twice. Begins where the turn is least.
    """
    if len(faces) == 0:
        return turns
    found = turns.copy()
    for face, source in steps_from(np.square(turns).sum(axis=1), faces):
        found[face] = nearest_turn(turns[face], found[source])
    return found


def nearest_turn(turn: FloatArray, goal: FloatArray) -> FloatArray:
    """(N, 3) of all turns with the effect of each `turn` the one nearest to its goal."""
    angle = np.sqrt((turn**2).sum(axis=1, keepdims=True))
    axis = np.where(angle > 0, unit(turn), unit(goal))
    whole = np.round(((axis * goal).sum(axis=1, keepdims=True) - angle) / TURN)
    nearest: FloatArray = (angle + TURN * whole) * axis
    return nearest


def steps_from(cost: FloatArray, faces: IntArray) -> list[tuple[IntArray, IntArray]]:
    """Rings of faces and the neighbour each is reached from, outwards from the cheapest of each component."""
    count = len(faces)
    one, other = neighbours(faces)
    graph = sparse.coo_array((np.ones(len(one)), (one, other)), shape=(count, count))
    component = sparse.csgraph.connected_components(graph, directed=False)[1]
    order = np.lexsort((cost, component))
    roots = order[np.unique(component[order], return_index=True)[1]]
    # One more place, from which all of them are reached
    links = (np.concatenate([one, np.full(len(roots), count)]), np.concatenate([other, roots]))
    linked = sparse.coo_array((np.ones(len(links[0])), links), shape=(count + 1, count + 1)).tocsr()
    visited, source = breadth_first_order(linked, count, directed=False)
    depth = np.zeros(count + 1, np.int64)
    for face in visited[1:]:
        depth[face] = depth[source[face]] + 1
    outer = visited[depth[visited] > 1]
    cuts = np.flatnonzero(np.diff(depth[outer])) + 1
    return [(ring, source[ring]) for ring in np.split(outer, cuts) if len(ring)]


def neighbours(faces: IntArray) -> tuple[IntArray, IntArray]:
    """Pairs of faces that share an edge."""
    begin, end = faces.reshape(-1), np.roll(faces, -1, axis=1).reshape(-1)
    low, high = np.minimum(begin, end).astype(np.int64), np.maximum(begin, end)
    edges = low * (int(high.max()) + 1) + high
    order = np.argsort(edges, kind="stable")
    same = edges[order[:-1]] == edges[order[1:]]
    return order[:-1][same] // 3, order[1:][same] // 3
