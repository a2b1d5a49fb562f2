"""Many poses of one scene, as arrays: what batched sampling answers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from eyeline.cached import cached_property
from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.geometry.hierarchy import world_from_nodes
from eyeline.scene.deformation import weights_of
from eyeline.scene.node import Node

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
    )  # nodes a matrix (4, 4) places; it may shear

    @classmethod
    def still(cls, scene: Scene, count: int) -> Samples:
        """`count` times the scene as it stands."""
        places = places_of(scene.nodes)
        for node, matrix in places.fixed.items():
            parts = transform.decompose(matrix)
            for column, part in zip((places.translation, places.rotation, places.scale), parts, strict=True):
                column[0, node] = part
        weights = {
            index: np.tile(np.array(weights_of(node, node.mesh)), (count, 1))
            for index, node in enumerate(scene.nodes)
            if node.mesh is not None and node.mesh.targets
        }
        columns = [
            np.repeat(one, count, axis=0) for one in (places.translation, places.rotation, places.scale)
        ]
        return cls(columns[0], columns[1], columns[2], weights, places.parents, places.fixed)

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
        return world_from_nodes(self.translation, self.rotation, self.scale, self.parents, self.fixed)


def places_of(nodes: Sequence[Node]) -> Samples:
    """Where nodes stand, once (T = 1); a node placed by a matrix is in `fixed` and at rest in the arrays."""
    return Samples(
        np.array([[node.translation for node in nodes]], dtype=np.float64).reshape(1, -1, 3),
        np.array([[node.rotation for node in nodes]], dtype=np.float64).reshape(1, -1, 4),
        np.array([[node.scale for node in nodes]], dtype=np.float64).reshape(1, -1, 3),
        {},
        np.array([node.parent for node in nodes], dtype=np.int32),
        {index: node.matrix for index, node in enumerate(nodes) if node.matrix is not None},
    )
