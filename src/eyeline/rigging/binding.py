"""Binding: a mesh gets joints, and weights that say how much each of them moves a vertex."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Literal, get_args

import numpy as np
import numpy.typing as npt

from eyeline.errors import GeometryError, OptionError, SceneError
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.geometry.bvh import bvh_of
from eyeline.geometry.weld import welded
from eyeline.rigging.bones import bones_of
from eyeline.rigging.heat import heat_weights
from eyeline.rigging.voxels import voxel_weights
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.pose import places_of
from eyeline.scene.scene import Scene
from eyeline.scene.skin import Blending, Skin
from eyeline.scene.topology import PLAIN, topology_of

Way = Literal["auto", "heat", "voxels"]
MOST = 4  # influences a vertex: what every viewer of glTF takes
FAINT = 1e-3  # a weight below this moves nothing that can be seen


def bind(
    mesh: Mesh,
    joints: Sequence[Node],
    *,
    tips: Mapping[str, npt.ArrayLike] | None = None,
    still: Collection[str] = (),
    way: Way = "auto",
    influences: int = MOST,
    blending: Blending = "linear",
) -> Scene:
    """A scene of the joints and the mesh, bound to them: turn a joint, and the mesh follows smoothly.

    mesh: as it stands among the joints at rest, in the world.
    joints: nodes, parents first, as `skeleton` makes them; a bone goes from each to each of its children.
    tips: {name: where the bone of a joint without children ends}, metres; else it goes on to the surface.
    still: names of joints that shall move nothing.
    way: how weights are found, "heat" for closed meshes in one part, "voxels" for any; "auto" chooses.
    influences: how many joints may move one vertex.

    The scene's last node is the mesh's, by its name or "body".
    """
    weights = bone_weights(mesh, joints, tips=tips, still=still, way=way)
    numbers, heaviest = heaviest_joints(weights, influences)
    bound = mesh.changed(joints=numbers, influences=heaviest)
    skin = Skin(tuple(range(len(joints))), np.linalg.inv(places_of(joints).world[0]), blending)
    return Scene((*joints, Node(mesh.name or "body", mesh=bound, skin=skin)))


def bone_weights(
    mesh: Mesh,
    joints: Sequence[Node],
    *,
    tips: Mapping[str, npt.ArrayLike] | None = None,
    still: Collection[str] = (),
    way: Way = "auto",
) -> FloatArray:
    """How much each joint moves each vertex, (V, J): at least 0, rows add up to 1; options as of `bind`."""
    if way not in get_args(Way):
        raise OptionError(f"way is {way!r}; auto, heat or voxels is needed")
    if len(mesh.faces) == 0:
        raise GeometryError(f"mesh {mesh.name!r} has no faces; a body is needed to bind it")
    if not joints:
        raise SceneError("there are no joints; at least one is needed to bind a mesh to")
    first, kind = welded(mesh.points)
    points, faces = mesh.points[first], np.ascontiguousarray(kind[mesh.faces], dtype=np.int32)
    tree = bvh_of(points, faces)
    names, parents = [node.name for node in joints], [node.parent for node in joints]
    places = places_of(joints).world[0, :, :3, 3]
    bones = bones_of(names, parents, places, tree, tips or {}, still)
    exact = points.astype(np.float64)
    if way == "heat" or (way == "auto" and _is_one_body(mesh)):
        return heat_weights(exact, faces, tree, bones)[kind]
    return voxel_weights(exact, faces, bones)[kind]


def heaviest_joints(weights: FloatArray, influences: int = MOST) -> tuple[IntArray, FloatArray]:
    """The joints that move a vertex most, and their weights, both (V, K); rows add up to 1."""
    if influences < 1:
        raise OptionError(f"influences is {influences}; 1 or more is needed")
    count = min(influences, weights.shape[1])
    order = np.argsort(-weights, axis=1, kind="stable")[:, :count]
    kept = np.take_along_axis(weights, order, axis=1)
    kept[:, 1:][kept[:, 1:] < FAINT] = 0
    kept /= kept.sum(axis=1, keepdims=True)
    return np.where(kept > 0, order, 0).astype(np.int32), kept.astype(np.float32)


def _is_one_body(mesh: Mesh) -> bool:
    """Whether a mesh is closed, each edge has two faces, and all hangs together."""
    topology = topology_of(mesh)
    closed = len(topology.open_edges) == 0 and len(topology.flat_faces) == 0
    return closed and bool((topology.odd == PLAIN).all()) and bool((topology.part == topology.part[0]).all())
