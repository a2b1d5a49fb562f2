"""Meshes bent by their node: morphed by its weights, deformed, taken along by the joints of its skin."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from eyeline.deform import morph, skin
from eyeline.deform.deformer import Deformer
from eyeline.errors import SceneError
from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.skin import Skin

SKINNINGS: dict[str, skin.Skinning] = {"linear": skin.linear_blend, "dual_quaternion": skin.dual_quaternion}


def morphed(mesh: Mesh, weights: Sequence[float]) -> Mesh:
    """The mesh blended with its targets; itself where no weight moves anything.

    Attributes that a target leaves out stay; normals and tangents stay unit, colours within 0..1.
    """
    targets = mesh.targets
    if not any(weights):
        return mesh
    values: dict[str, Any] = {"points": morph.blend(mesh.points, [one.points for one in targets], weights)}
    if mesh.normals is not None:
        normals = [one.normals for one in targets]
        values["normals"] = morph.blend_directions(mesh.normals, normals, weights)
    if mesh.tangents is not None:
        tangents = [one.tangents for one in targets]
        values["tangents"] = morph.blend_directions(mesh.tangents, tangents, weights)
    if mesh.colors is not None:
        colors = morph.blend(mesh.colors, [one.colors for one in targets], weights)
        values["colors"] = colors if colors is mesh.colors else np.clip(colors, 0, 1)
    values["uv"] = tuple(
        morph.blend(pairs, [one.uv[index] if index < len(one.uv) else None for one in targets], weights)
        for index, pairs in enumerate(mesh.uv)
    )
    return mesh.changed(**values)


def deformed(mesh: Mesh, deformer: Deformer | None) -> Mesh:
    """The mesh moved by a deformer; itself where there is none. One turned inside out turns its faces."""
    if deformer is None:
        return mesh
    points, normals, tangents = deformer(mesh.points, mesh.normals, mesh.tangents)
    values: dict[str, Any] = {"points": points, "normals": normals, "tangents": tangents}
    if deformer.mirrors:
        values["faces"] = np.ascontiguousarray(mesh.faces[:, [0, 2, 1]])
    return mesh.changed(**values)


def weights_of(node: Node, mesh: Mesh) -> tuple[float, ...]:
    """What a node's mesh is morphed by: the node's weights, or else the mesh's own; one for each target."""
    weights = mesh.weights if node.weights is None else node.weights
    if len(weights) != len(mesh.targets):
        raise SceneError(
            f"node {node.name!r} has {len(weights)} weights for {len(mesh.targets)} morph targets;"
            " one for each is needed"
        )
    return weights


def skinned(mesh: Mesh, node: Node, world: FloatArray) -> tuple[Mesh, FloatArray]:
    """The mesh where the joints of the node's skin have taken it, and its world_from_mesh (4, 4).

    world: (N, 4, 4) world_from_node. The points are in the world; the node's own place does not count.
    Where the joints mirror the mesh, so does world_from_mesh, so that front faces stay known as such.
    """
    assert node.skin is not None and mesh.joints is not None and mesh.influences is not None
    matrices = joint_matrices(node.skin, world)
    placing = transform.identity()
    if 2 * (transform.determinants(matrices) < 0).sum() > len(matrices):
        placing[0, 0] = -1
        matrices[:, 0] *= -1
    points, normals, tangents = SKINNINGS[node.skin.blending](
        mesh.points, mesh.normals, mesh.tangents, mesh.joints, mesh.influences, matrices
    )
    return mesh.changed(points=points, normals=normals, tangents=tangents), placing


def joint_matrices(skin: Skin, world: FloatArray) -> FloatArray:
    """(J, 4, 4) from where the mesh was bound to the world; refused: a joint that is no node."""
    if skin.joints and not 0 <= min(skin.joints) <= max(skin.joints) < len(world):
        raise SceneError(f"skin {skin.name!r} has joints {skin.joints}; the scene has {len(world)} nodes")
    return transform.product(world[list(skin.joints)], np.asarray(skin.joint_from_mesh, dtype=np.float64))
