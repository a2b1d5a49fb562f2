"""What of a mesh is the same in every view: its edges, and which of its faces may be one convex body."""

from __future__ import annotations

from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from eyeline.geometry.arrays import BoolArray, FloatArray, IntArray
from eyeline.scene.mesh import Mesh
from eyeline.scene.topology import BRANCHING, PLAIN, Topology, topology_of

FLAT = 2.0**-22  # what counts as in one plane, as a part of the largest coordinate: a step or two of float32
MOST_FACES = 64  # of a closed body: a larger one is left as its faces, of which a line meets only few
LEAST_FACES = 4


@dataclass(frozen=True, eq=False)
class Structure:
    """Edges of one mesh, and groups of faces that are one convex body if the view agrees."""

    edges: IntArray  # (E, 4) int32: vertex, vertex, face, face or -1; none where two faces go on in one plane
    beyond: IntArray  # (F, 3) int32: the face beyond each side; -1 is none
    start: IntArray  # (G + 1,) int64: where each group's faces begin
    member: IntArray  # (K,) int32 faces; whole closed parts first, then pairs across flat edges
    closed: BoolArray  # (G,) whether the group is a closed part


_known: WeakKeyDictionary[Mesh, Structure] = WeakKeyDictionary()


def structure_of(mesh: Mesh) -> Structure:
    """The structure of a mesh, kept as long as the mesh is: it never changes."""
    found = _known.get(mesh)
    if found is None:
        topology = topology_of(mesh)
        flat = flat_edges(mesh.points.astype(np.float64), topology)
        edges = np.ascontiguousarray(topology.edges[~flat])
        found = _known[mesh] = Structure(edges, beyond(topology), *groups(topology, flat))
    return found


def flat_edges(points: FloatArray, topology: Topology) -> BoolArray:
    """(E,) the edges whose two faces go on in one plane: each one's free corner lies on the other."""
    flat: BoolArray = (topology.edges[:, 3] >= 0) & (topology.odd == PLAIN)
    rows = np.flatnonzero(flat)
    begin, end, *pair = topology.edges[rows].T
    reach = FLAT * np.abs(points).max(initial=0)
    free = [topology.faces[face].sum(axis=1) - begin - end for face in pair]
    normals = []
    for face, other in zip(pair, reversed(free), strict=True):
        a, b, c = (points[topology.faces[face, k]] for k in range(3))
        normal = np.cross(b - a, c - a)
        height = (normal * (points[other] - a)).sum(axis=1)
        flat[rows] &= np.abs(height) <= reach * np.sqrt((normal**2).sum(axis=1))
        normals.append(normal)
    flat[rows] &= (normals[0] * normals[1]).sum(axis=1) > 0
    return flat


def beyond(topology: Topology) -> IntArray:
    """(F, 3) the face beyond each side of every face; -1 is none, and where more than two meet."""
    edge, own = topology.face_edges, np.arange(len(topology.faces), dtype=np.int32)[:, None]
    if len(topology.edges) == 0:
        return np.full_like(edge, -1)
    one, other = (topology.edges[:, k][edge] for k in (2, 3))
    found: IntArray = np.where(one == own, other, np.where(other == own, one, np.int32(-1)))
    found[(edge < 0) | (topology.odd[edge] == BRANCHING)] = -1
    return found


def groups(topology: Topology, flat: BoolArray) -> tuple[IntArray, IntArray, BoolArray]:
    """(start, member, closed) of the groups: small closed parts, and pairs of faces in one plane."""
    _, part, count = np.unique(topology.part, return_inverse=True, return_counts=True)
    whole = (count >= LEAST_FACES) & (count <= MOST_FACES)
    loose = (topology.edges[:, 3] < 0) | (topology.odd != PLAIN)
    whole[part[topology.edges[loose, 2]]] = False
    whole[part[(topology.face_edges < 0).any(axis=1)]] = False
    order = np.argsort(part, kind="stable")
    of_parts = order[whole[part[order]]]
    pairs = topology.edges[flat, 2:]
    sizes = np.concatenate([[0], count[whole], np.full(len(pairs), 2)])
    member = np.concatenate([of_parts, pairs.reshape(-1)]).astype(np.int32)
    return np.cumsum(sizes).astype(np.int64), member, np.arange(len(sizes) - 1) < whole.sum()
