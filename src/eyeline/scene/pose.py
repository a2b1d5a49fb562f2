"""Many poses of one scene, as arrays: what batched sampling answers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray, IntArray

if TYPE_CHECKING:
    from eyeline.scene.scene import Scene


@dataclass(frozen=True, eq=False)
class Samples:
    """Every node's parent_from_node, and morph weights, at T times."""

    translation: FloatArray  # (T, N, 3) metres
    rotation: FloatArray  # (T, N, 4) unit, x y z w
    scale: FloatArray  # (T, N, 3)
    weights: Mapping[int, FloatArray]  # node -> (T, targets), for nodes whose mesh has targets
    parents: IntArray  # (N,) -1 is the world
    fixed: Mapping[int, FloatArray] = field(
        default_factory=dict
    )  # nodes placed by a matrix (4, 4), which may shear

    @classmethod
    def still(cls, scene: Scene, count: int) -> Samples:
        """`count` times the scene as it stands."""
        parts = [
            transform.decompose(node.matrix)
            if node.matrix is not None
            else (node.translation, node.rotation, node.scale)
            for node in scene.nodes
        ]
        columns = [
            np.array([part[k] for part in parts], dtype=np.float64).reshape(-1, (3, 4, 3)[k])
            for k in range(3)
        ]
        repeated = [np.broadcast_to(column, (count, *column.shape)).copy() for column in columns]
        weights = {
            index: np.tile(np.array(node.mesh.weights if node.weights is None else node.weights), (count, 1))
            for index, node in enumerate(scene.nodes)
            if node.mesh is not None and node.mesh.targets
        }
        parents = np.array([node.parent for node in scene.nodes], dtype=np.int32)
        fixed = {index: node.matrix for index, node in enumerate(scene.nodes) if node.matrix is not None}
        return cls(repeated[0], repeated[1], repeated[2], weights, parents, fixed)

    @cached_property
    def local(self) -> FloatArray:
        """(T, N, 4, 4) parent_from_node."""
        local = transform.compose(self.translation, self.rotation, self.scale)
        for node, matrix in self.fixed.items():
            local[:, node] = matrix
        return local

    @cached_property
    def world(self) -> FloatArray:
        """(T, N, 4, 4) world_from_node."""
        world = self.local.copy()
        for index, parent in enumerate(self.parents):
            if parent >= 0:
                world[:, index] = world[:, parent] @ world[:, index]
        return world
