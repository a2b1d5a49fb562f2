"""Weights as heat in equilibrium: each bone warms what it sees of the surface, which spreads it. [Baran07]"""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components
from scipy.sparse.linalg import splu

from eyeline.geometry.arrays import BoolArray, FloatArray, IntArray
from eyeline.geometry.bvh import Bvh
from eyeline.geometry.rays import blocked
from eyeline.rigging.bones import Bones

ALIKE = 1e-3  # bones whose distances differ by a smaller part warm a vertex alike
ARRIVED = 0.99  # of the way from a bone to a vertex: what lies behind is the vertex's own surroundings
LEAST = 1e-4  # of the body's size: no vertex is nearer to a bone than this
THINNEST = 1e-8  # of a face's longest edge squared: an area below this conducts as if it were this


def heat_weights(points: FloatArray, faces: IntArray, tree: Bvh, bones: Bones) -> FloatArray:
    """How much of a vertex's heat comes from each joint (V, J): at least 0, rows add up to 1.

    points: (V, 3) float64, of which faces that touch share theirs; faces: (F, 3); tree: over the same faces.
    A bone warms a vertex by one over its distance squared, if it is the nearest of those that the vertex
    sees. Refused: nothing; a body that no bone can see is warmed through its skin.
    """
    conduction, area = _laplacian(points, faces)
    heat, share = _sources(points, tree, bones, _component(faces, len(points)))
    system = sparse.csc_array(conduction + sparse.diags_array(area * heat))
    factored = splu(system, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
    weights = np.maximum(factored.solve((area * heat)[:, None] * share), 0)
    whole = weights.sum(axis=1, keepdims=True)
    balanced: FloatArray = np.where(whole > 0, weights / np.where(whole > 0, whole, 1), share)
    return balanced


def _sources(
    points: FloatArray, tree: Bvh, bones: Bones, component: IntArray
) -> tuple[FloatArray, FloatArray]:
    """How strongly each vertex is warmed (V,), and by which joints (V, J), rows add up to 1."""
    places = bones.nearest(points)
    size = float(np.ptp(points, axis=0).max())
    away = points[:, None] - places
    distance = np.maximum(np.sqrt((away * away).sum(axis=2)), LEAST * size)
    seen = _seen(places, away, tree)
    # Parts that no bone sees, such as eyes within a head, are warmed as if nothing were between
    lit = np.bincount(component, seen.any(axis=1)) > 0
    seen |= ~lit[component][:, None]
    least = bones.of_joints(np.where(seen, distance, np.inf))
    nearest = least.min(axis=1)
    warm = np.isfinite(nearest)
    heat = np.where(warm, 1 / np.where(warm, nearest, 1) ** 2, 0)
    shares = least <= np.where(warm, nearest * (1 + ALIKE), -1)[:, None]
    if not warm.all():
        shares[~warm, bones.of_joints(distance)[~warm].argmin(axis=1)] = True
    share: FloatArray = shares / shares.sum(axis=1, keepdims=True)
    return heat, share


def _seen(places: FloatArray, away: FloatArray, tree: Bvh) -> BoolArray:
    """(V, B) whether nothing lies between the places on bones and the vertices that are `away` from them."""
    count = away.shape[0] * away.shape[1]
    way = away.reshape(count, 3).astype(np.float32)
    moves = (way != 0).any(axis=1)
    reach = np.where(moves, ARRIVED, -1).astype(np.float32)
    way[~moves, 0] = 1
    hidden = blocked(tree, places.reshape(count, 3).astype(np.float32), way, reach)
    seen: BoolArray = ~hidden.reshape(away.shape[:2])
    return seen


def _laplacian(points: FloatArray, faces: IntArray) -> tuple[sparse.csr_array, FloatArray]:
    """How well edges conduct, by cotangents, (V, V), positive on the diagonal; and areas of vertices (V,).

    An edge whose cotangents add up to less than 0 conducts nothing, so that no weight leaves 0..1.
    """
    count = len(points)
    corners = points[faces]
    doubled = np.sqrt(
        (np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) ** 2).sum(axis=1)
    )
    sides = np.roll(corners, -1, axis=1) - corners
    longest = (sides * sides).sum(axis=2).max(axis=1)
    safe = np.maximum(doubled, THINNEST * np.where(longest > 0, longest, 1))
    rows, columns, values = [], [], []
    for k in range(3):
        left, right = (k + 1) % 3, (k + 2) % 3
        arms = corners[:, left] - corners[:, k], corners[:, right] - corners[:, k]
        rows.append(faces[:, left])
        columns.append(faces[:, right])
        values.append((arms[0] * arms[1]).sum(axis=1) / safe / 2)
    place = np.concatenate(rows), np.concatenate(columns)
    one_way = sparse.csr_array((np.concatenate(values), place), shape=(count, count))
    edges = (one_way + one_way.T).maximum(0)
    total = np.asarray(edges.sum(axis=1)).reshape(-1)
    area = np.bincount(faces.reshape(-1), np.repeat(doubled / 6, 3), count)
    least = 1e-12 * max(float(area.max(initial=0)), np.finfo(float).tiny)
    return sparse.csr_array(sparse.diags_array(total) - edges), np.maximum(area, least)


def _component(faces: IntArray, count: int) -> IntArray:
    """(V,) a number that vertices share if faces connect them."""
    edges = np.concatenate([faces[:, 0], faces[:, 1]]), np.concatenate([faces[:, 1], faces[:, 2]])
    graph = sparse.coo_array((np.ones(len(edges[0])), edges), shape=(count, count))
    numbers: IntArray = connected_components(graph, directed=False)[1]
    return numbers
