"""A place in the scene: what stands there, and how it is moved against its parent."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from eyeline.cached import cached_property
from eyeline.deform.deformer import Deformer
from eyeline.geometry import quaternion, transform
from eyeline.geometry.arrays import FloatArray
from eyeline.scene.camera import Camera
from eyeline.scene.light import Light
from eyeline.scene.mesh import Mesh
from eyeline.scene.skin import Skin

Vector = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Node:
    """What stands here, and parent_from_node as translation, rotation and scale, or as a matrix."""

    name: str = ""
    parent: int = -1  # index into the scene's nodes, always lower than its own; -1 is the world
    translation: Vector = (0.0, 0.0, 0.0)  # metres
    rotation: tuple[float, float, float, float] = quaternion.IDENTITY  # x y z w, unit
    scale: Vector = (1.0, 1.0, 1.0)
    matrix: FloatArray | None = None  # (4, 4) affine; where given, in place of the three above
    mesh: Mesh | None = None
    skin: Skin | None = None
    weights: tuple[float, ...] | None = None  # of the mesh's morph targets; None: the mesh's own
    camera: Camera | None = None  # its lens; its place is this node's
    light: Light | None = None
    instances: FloatArray | None = None  # (K, 4, 4) node_from_instance: the mesh stands K times
    visible: bool = True
    deform: Deformer | None = None  # bends the mesh in its own space, morphed before and skinned after
    controls: Mapping[str, float] = field(default_factory=dict)  # numbers by name, for constraints to read

    def changed(self, **values: Any) -> Node:
        """This node with other values, unchecked: for code that makes many, film frame after film frame."""
        node = object.__new__(Node)
        vars(node).update({**vars(self), **values})
        vars(node).pop("parent_from_node", None)
        return node

    @cached_property
    def parent_from_node(self) -> FloatArray:
        """(4, 4) float64."""
        if self.matrix is not None:
            return self.matrix
        return transform.compose(self.translation, self.rotation, self.scale)
