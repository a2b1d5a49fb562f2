"""The points whose gradients over a mesh are nearest to given ones: Poisson's equation. [Xu05]"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components
from scipy.sparse.linalg import SuperLU, splu

from eyeline.cached import cached_property
from eyeline.geometry.arrays import FloatArray, IntArray

ROUNDING = 4 * float(np.finfo(np.float32).eps)  # of the places that areas are made of


@dataclass(frozen=True, eq=False)
class Poisson:
    """A mesh at rest, its linear system factored once."""

    points: FloatArray  # (S, 3) float64; faces that touch share them
    all_faces: IntArray  # (F, 3)

    @cached_property
    def _areas(self) -> tuple[FloatArray, FloatArray]:
        """Each face's normal (F, 3) times twice its area, and its area (F,)."""
        a, b, c = (self.points[self.all_faces[:, k]] for k in range(3))
        normals = np.cross(b - a, c - a)
        return normals, np.sqrt((normals**2).sum(axis=1)) / 2

    @cached_property
    def _kept(self) -> IntArray:
        """The rows of faces that have an area: the others have no gradient."""
        extent = np.ptp(self.points, axis=0).max()
        return np.flatnonzero(self._areas[1] > (ROUNDING * extent) ** 2)

    @property
    def faces(self) -> IntArray:
        """(G, 3) the faces that have an area."""
        return self.all_faces[self._kept]

    @cached_property
    def gradient(self) -> sparse.csr_array:
        """(3 G, S) from a number at each point to its gradient on each face."""
        normals, area = self._areas[0][self._kept], self._areas[1][self._kept]
        rows, columns, values = [], [], []
        for k in range(3):
            # Of the function that is 1 at corner k: a quarter turn of the opposite edge
            edge = self.points[self.faces[:, (k + 2) % 3]] - self.points[self.faces[:, (k + 1) % 3]]
            values.append((np.cross(normals, edge) / (4 * area**2)[:, None]).reshape(-1))
            rows.append(np.arange(3 * len(area)))
            columns.append(np.repeat(self.faces[:, k], 3))
        place = (np.concatenate(rows), np.concatenate(columns))
        return sparse.csr_array((np.concatenate(values), place), shape=(3 * len(area), len(self.points)))

    @cached_property
    def divergence(self) -> sparse.csr_array:
        """(S, 3 G) the gradient's transpose, weighted by areas."""
        return sparse.csr_array((self.gradient * np.repeat(self._areas[1][self._kept], 3)[:, None]).T)

    @cached_property
    def component(self) -> IntArray:
        """(S,) a number that points share if faces connect them."""
        count, corners = len(self.points), self.faces
        edges = (
            np.concatenate([corners[:, 0], corners[:, 1]]),
            np.concatenate([corners[:, 1], corners[:, 2]]),
        )
        graph = sparse.coo_array((np.ones(len(edges[0])), edges), shape=(count, count))
        numbers: IntArray = connected_components(graph, directed=False)[1]
        return numbers

    @cached_property
    def _free(self) -> IntArray:
        """All points but the first of each component, which stands still while the others are solved for."""
        first = np.unique(self.component, return_index=True)[1]
        return np.setdiff1d(np.arange(len(self.points)), first)

    @cached_property
    def _factored(self) -> SuperLU:
        laplacian = sparse.csc_array(self.divergence @ self.gradient)
        inner = laplacian[self._free][:, self._free]
        return splu(sparse.csc_array(inner), permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})

    @cached_property
    def _mass(self) -> FloatArray:
        """(S,) how much of a component's surface a point stands for; adds up to 1 in each."""
        area = np.repeat(self._areas[1][self._kept], 3)
        mass = np.bincount(self.faces.reshape(-1), area, len(self.points))
        whole = np.bincount(self.component, mass)[self.component]
        return np.where(whole > 0, mass / np.where(whole > 0, whole, 1), 1.0)

    def centroids(self, points: FloatArray) -> FloatArray:
        """(C, 3) of each component, when its points are at (S, 3)."""
        count = int(self.component.max()) + 1
        return np.stack(
            [np.bincount(self.component, self._mass * points[:, k], count) for k in range(3)], axis=1
        )

    def solve(self, maps: FloatArray, centroids: FloatArray) -> FloatArray:
        """(S, 3) the points nearest to linear maps (G, 3, 3) of the faces, components about centroids."""
        wanted = np.swapaxes(maps, 1, 2).reshape(-1, 3)
        points = np.zeros_like(self.points)
        if len(self._free):
            points[self._free] = self._factored.solve((self.divergence @ wanted)[self._free])
        shift: FloatArray = (centroids - self.centroids(points))[self.component]
        return points + shift
