"""Meshes where they stand: morphed, deformed, skinned, and placed in the world."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from eyeline.cached import cached_property
from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray
from eyeline.scene.deformation import deformed, morphed, skinned, weights_of
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node


@dataclass(frozen=True, eq=False)
class Surface:
    """One standing of a mesh, deformed, with the number of its first face in the scene."""

    node: int
    mesh: Mesh
    world_from_mesh: FloatArray  # (4, 4)
    first_face: int
    visible: bool = True

    @cached_property
    def mirrored(self) -> bool:
        """Whether its placing turns front faces clockwise."""
        return transform.is_mirror(self.world_from_mesh)


def surfaces_of(nodes: Sequence[Node], world: FloatArray) -> tuple[Surface, ...]:
    """Every mesh of posed nodes; world: (N, 4, 4) world_from_node.

    A hidden one is among them and keeps its face numbers, so that hiding it renumbers no other.
    A mesh that nothing bends stays the same object.
    """
    surfaces = []
    first = 0
    for index, node in enumerate(nodes):
        if node.mesh is None:
            continue
        visible = shown(nodes, index)
        mesh = deformed(morphed(node.mesh, weights_of(node, node.mesh)), node.deform)
        if node.skin is not None and mesh.joints is not None:
            mesh, matrix = skinned(mesh, node, world)
            matrices = [matrix]
        else:
            matrices = placings(node, world[index])
        for matrix in matrices:
            surfaces.append(Surface(index, mesh, matrix, first, visible))
            first += len(mesh.faces)
    return tuple(surfaces)


def placings(node: Node, world_from_node: FloatArray) -> list[FloatArray]:
    """world_from_mesh of each instance of the node's mesh."""
    if node.instances is None:
        return [world_from_node]
    return [world_from_node @ one for one in node.instances]


def shown(nodes: Sequence[Node], index: int) -> bool:
    """Whether a node and all above it are visible."""
    while index >= 0:
        if not nodes[index].visible:
            return False
        index = nodes[index].parent
    return True
