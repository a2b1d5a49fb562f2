"""Many poses of one scene, as arrays: what batched sampling answers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from eyeline.cached import cached_property
from eyeline.errors import SceneError, suggestion
from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.geometry.hierarchy import world_from_nodes
from eyeline.scene.constraint import Constraint
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
    controls: Mapping[int, Mapping[str, FloatArray]] = field(default_factory=dict)  # node -> name -> (T,)
    paths: tuple[str, ...] = ()  # (N,) of the nodes
    deforms: Mapping[int, Mapping[str, FloatArray]] = field(
        default_factory=dict
    )  # node -> number of its deformer -> what constraints add to it, (T, ...)

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
        controls = {
            index: {name: np.full(count, float(value)) for name, value in node.controls.items()}
            for index, node in enumerate(scene.nodes)
            if node.controls
        }
        columns = [
            np.repeat(one, count, axis=0) for one in (places.translation, places.rotation, places.scale)
        ]
        return cls(
            columns[0],
            columns[1],
            columns[2],
            weights,
            places.parents,
            places.fixed,
            controls,
            scene.paths,
        )

    def find(self, path: str) -> int:
        """The index of the node with this path, or with this end of a path if only one has it."""
        return found(path, self.paths)

    def placed(
        self,
        node: int,
        translation: npt.ArrayLike | None = None,
        rotation: npt.ArrayLike | None = None,
        scale: npt.ArrayLike | None = None,
    ) -> Samples:
        """This pose with other parts (T, 3), (T, 4), (T, 3) of parent_from_node for one node."""
        parts = {"translation": translation, "rotation": rotation, "scale": scale}
        values: dict[str, Any] = {
            name: _with_column(getattr(self, name), node, value)
            for name, value in parts.items()
            if value is not None
        }
        fixed = {other: matrix for other, matrix in self.fixed.items() if other != node}
        return replace(self, **values, fixed=fixed)

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


def _with_column(columns: FloatArray, node: int, value: npt.ArrayLike) -> FloatArray:
    changed = columns.copy()
    changed[:, node] = value
    return changed


def solved(
    pose: Samples, constraints: Sequence[Constraint], moved: Mapping[str, Mapping[str, FloatArray]]
) -> Samples:
    """A pose with every constraint kept, one after the other; moved: by constraint, its numbers in motion."""
    for constraint in constraints:
        pose = constraint(pose, moved.get(constraint.name, {}))
    return pose


def differences(before: Samples, after: Samples) -> dict[int, dict[str, Any]]:
    """What nodes have become between two poses of one time each (T = 1), as fields of Node."""
    changes: dict[int, dict[str, Any]] = {}
    loosened = before.fixed.keys() - after.fixed.keys()
    for part in ("translation", "rotation", "scale"):
        old, new = getattr(before, part)[0], getattr(after, part)[0]
        for node in {*np.flatnonzero((old != new).any(axis=1)).tolist(), *loosened}:
            changes.setdefault(node, {})[part] = tuple(new[node].tolist())
    for node in loosened:
        changes[node]["matrix"] = None
    for node, weights in after.weights.items():
        if not np.array_equal(weights, before.weights[node]):
            changes.setdefault(node, {})["weights"] = tuple(weights[0].tolist())
    return changes


def bends(pose: Samples, nodes: Sequence[Node]) -> dict[int, dict[str, Any]]:
    """What a pose of one time (T = 1) makes of the deformers of nodes that have some, as fields of Node."""
    changes = {}
    for node, added in pose.deforms.items():
        if (deformer := nodes[node].deform) is not None:
            before = deformer.parameters
            values = {name: before.get(name, 0.0) + value[0] for name, value in added.items()}
            changes[node] = {"deform": deformer.changed(values)}
    return changes


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


def found(path: str | int, paths: Sequence[str]) -> int:
    """The index of a node: by its number, its path, or an end of a path that only one has."""
    if isinstance(path, (int, np.integer)):
        if not 0 <= path < len(paths):
            raise SceneError(f"there is no node {path}; the scene has {len(paths)}")
        return int(path)
    if path in paths:
        return paths.index(path)
    ends = [index for index, full in enumerate(paths) if full.endswith("/" + path)]
    if len(ends) == 1:
        return ends[0]
    if ends:
        raise SceneError(f"{path!r} is the end of {len(ends)} paths; say which: {paths[ends[0]]!r} ...")
    raise SceneError(f"there is no node {path!r}{suggestion(path, paths)}")
