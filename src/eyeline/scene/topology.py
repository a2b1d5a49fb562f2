"""What meets in a mesh: corners at one place are one, edges have two faces, parts hang together.

Nothing here depends on the view.
"""

from __future__ import annotations

from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from eyeline.geometry.arrays import ByteArray, IntArray, read_only
from eyeline.geometry.weld import first_alike, mixing
from eyeline.jit import kernel
from eyeline.scene.mesh import Mesh

# An edge as it should be; one that its two faces run along the same way; one of more than two faces
PLAIN, TWISTED, BRANCHING = 0, 1, 2


@dataclass(frozen=True, eq=False)
class Topology:
    """Edges and parts of one mesh."""

    faces: IntArray  # (F, 3) int32, vertices at one place named by the first of them
    edges: IntArray  # (E, 4) int32: lower vertex, higher vertex, face, face or -1
    odd: ByteArray  # (E,) PLAIN, TWISTED or BRANCHING
    face_edges: IntArray  # (F, 3) int32: the edge from each corner to the next; -1 for a face without area
    part: IntArray  # (F,) int32: a number that faces share if vertices connect them
    open_edges: IntArray  # the rows of edges that have one face
    flat_faces: IntArray  # the rows of faces of which two corners are one; they have no edges


_known: WeakKeyDictionary[Mesh, Topology] = WeakKeyDictionary()


def topology_of(mesh: Mesh) -> Topology:
    """The topology of a mesh, kept as long as the mesh is: it never changes."""
    found = _known.get(mesh)
    if found is None:
        found = _known[mesh] = build(mesh)
    return found


def build(mesh: Mesh) -> Topology:
    """Weld, then meet."""
    points = mesh.points + np.float32(0)  # minus zero is zero
    first = first_alike(points.view(np.int32))
    faces = np.ascontiguousarray(first[mesh.faces])
    count = len(faces)
    edges, odd = np.empty((3 * count, 4), np.int32), np.zeros(3 * count, np.uint8)
    face_edges, part = np.full((count, 3), -1, np.int32), np.empty(count, np.int32)
    slots = 1 << max(4, (6 * count).bit_length())
    found = _find_edges(read_only(faces), np.full(slots, -1, np.int32), edges, odd, face_edges)
    _find_parts(read_only(faces), np.arange(len(points), dtype=np.int32), part)
    edges = edges[:found].copy()
    open_edges, flat_faces = np.flatnonzero(edges[:, 3] < 0), np.flatnonzero(face_edges[:, 0] < 0)
    return Topology(faces, edges, odd[:found].copy(), face_edges, part, open_edges, flat_faces)


@kernel
def _find_edges(faces, table, edges, odd, face_edges):
    """Fill edges, odd and face_edges; how many edges there are. `table` is a hash table of edges, all -1."""
    mask, count = table.shape[0] - 1, 0
    for face in range(faces.shape[0]):
        if (
            (faces[face, 0] == faces[face, 1])
            | (faces[face, 1] == faces[face, 2])
            | (faces[face, 2] == faces[face, 0])
        ):
            continue
        for k in range(3):
            begin, end = faces[face, k], faces[face, (k + 1) % 3]
            low, high = min(begin, end), max(begin, end)
            slot = mixing(mixing(np.int64(low)) ^ np.int64(high)) & mask
            while table[slot] >= 0 and not ((edges[table[slot], 0] == low) & (edges[table[slot], 1] == high)):
                slot = (slot + 1) & mask
            edge = table[slot]
            if edge < 0:
                edge = count
                table[slot] = count
                edges[edge, 0], edges[edge, 1], edges[edge, 2], edges[edge, 3] = low, high, face, -1
                odd[edge] = begin == low  # for now: which way its first face runs
                count += 1
            elif edges[edge, 3] < 0:
                edges[edge, 3] = face
                odd[edge] = TWISTED if (odd[edge] != 0) == (begin == low) else PLAIN
            else:
                odd[edge] = BRANCHING
            face_edges[face, k] = edge
    for edge in range(count):
        if edges[edge, 3] < 0:
            odd[edge] = PLAIN
    return count


@kernel
def _find_parts(faces, root, part):
    """Fill part with the lowest vertex that each face is connected to. `root` is every vertex itself."""
    for face in range(faces.shape[0]):
        for k in range(1, 3):
            a, b = faces[face, 0], faces[face, k]
            while root[a] != a:
                root[a] = root[root[a]]
                a = root[a]
            while root[b] != b:
                root[b] = root[root[b]]
                b = root[b]
            root[max(a, b)] = min(a, b)
    for face in range(faces.shape[0]):
        a = faces[face, 0]
        while root[a] != a:
            root[a] = root[root[a]]
            a = root[a]
        part[face] = a
