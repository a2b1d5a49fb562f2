"""Deformers, which the format does not have, as morph targets and keys of their weights."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from eyeline.files.gltf.writing.baking import frame_times
from eyeline.files.gltf.writing.fewest_targets import Blend, carried, fewest_targets
from eyeline.files.gltf.writing.fitting import fewest_keys
from eyeline.files.saving import Sampling
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.clip import Clip
from eyeline.motion.curve import Curve
from eyeline.motion.track import Track
from eyeline.scene.deformation import deformed, morphed, weights_of
from eyeline.scene.mesh import Mesh, MorphTarget
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene

Note = Callable[[str], None]


@dataclass(frozen=True, eq=False)
class Baked:
    """A node's mesh with targets for all that its deformer does, and their weights in each clip."""

    mesh: Mesh
    curves: tuple[Curve | None, ...]  # for each clip; None where the shape stays


def without_deformers(scene: Scene, acting: Scene, sampling: Sampling, note: Note) -> Scene:
    """A scene that looks as this one does and has no deformers: their meshes have morph targets instead.

    acting: this scene with its constraints, which may drive the deformers.
    """
    bent = [index for index, node in enumerate(scene.nodes) if node.deform is not None]
    if not bent:
        return scene
    clips = [clip for clip in scene.clips if isinstance(clip, Clip)]
    times = [frame_times(clip.duration, sampling.fps) for clip in clips]
    poses = [
        [clip.pose(acting, float(time)).nodes for time in moments]
        for clip, moments in zip((one for one in acting.clips if isinstance(one, Clip)), times, strict=True)
    ]
    nodes = list(scene.nodes)
    tracks = [[track for track in clip.tracks if not _is_taken(track, scene, bent)] for clip in clips]
    for index in bent:
        nodes[index] = scene.nodes[index].changed(deform=None)
        if scene.nodes[index].mesh is None:
            continue
        baked = _baked(scene, index, times, poses, (sampling, note))
        nodes[index] = nodes[index].changed(mesh=baked.mesh, weights=None)
        for own, curve in zip(tracks, baked.curves, strict=True):
            own += [] if curve is None else [Track("node", scene.paths[index], "weights", curve)]
    made = [Clip(clip.name, own) for clip, own in zip(clips, tracks, strict=True)]
    return replace(scene, nodes=tuple(nodes), clips=tuple(made))


def _is_taken(track: Track, scene: Scene, bent: Sequence[int]) -> bool:
    """Whether targets say what a track moves: a deformer, or weights of a mesh that has one."""
    if track.kind != "node" or track.property.split(".")[0] not in ("deform", "weights"):
        return False
    return scene.find(track.name) in bent


def _baked(
    scene: Scene,
    index: int,
    times: Sequence[FloatArray],
    poses: Sequence[Sequence[tuple[Node, ...]]],
    asked: tuple[Sampling, Note],
) -> Baked:
    sampling, note = asked
    rest = shape_of(scene.nodes[index])
    shapes = [shape_of(nodes[index]) for clip in poses for nodes in clip]
    still = rest.changed(targets=(), weights=())
    if not shapes:
        return Baked(still, ())
    reach = sampling.tolerance * rest.bounds.diagonal
    moves = np.array([shape.points - rest.points for shape in shapes])
    # Half of what may be lost goes to the targets, half to the keys of their weights
    blend = fewest_targets(moves, reach / 2)
    if not len(blend.targets):
        return Baked(still, (None,) * len(times))
    count = len(blend.targets)
    note(
        f"the deformer of node {scene.paths[index]!r} becomes {count} morph targets,"
        f" within {reach:.2g} m at {sampling.fps:g} times a second"
    )
    ends = np.cumsum([len(moments) for moments in times])[:-1]
    curves = []
    for moments, weights in zip(times, np.split(blend.weights, ends), strict=True):
        kept = fewest_keys(moments, weights, reach / 2 / count)
        curves.append(Curve(moments[kept], weights[kept]))
    mesh = still.changed(targets=_targets(blend, rest, shapes), weights=(0.0,) * count)
    return Baked(mesh, tuple(curves))


def _targets(blend: Blend, rest: Mesh, shapes: Sequence[Mesh]) -> tuple[MorphTarget, ...]:
    """The targets with what they do to normals, which follow the shapes as near as the same weights can."""
    normals: list[FloatArray | None] = [None] * len(blend.targets)
    if rest.normals is not None:
        turned = np.array([shape.normals - rest.normals for shape in shapes if shape.normals is not None])
        normals = list(carried(blend.weights, turned))
    pairs = zip(blend.targets, normals, strict=True)
    return tuple(
        MorphTarget(points, turns, name=f"shape {number}") for number, (points, turns) in enumerate(pairs)
    )


def shape_of(node: Node) -> Mesh:
    """A node's mesh as its weights and deformer bend it, before its skin."""
    assert node.mesh is not None
    return deformed(morphed(node.mesh, weights_of(node, node.mesh)), node.deform)
