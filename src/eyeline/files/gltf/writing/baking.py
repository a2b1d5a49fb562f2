"""What the format has no words for, as keys: constraints become the motion that they make."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from eyeline.files.gltf.writing.curves import fitted
from eyeline.files.saving import Sampling
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.clip import Clip
from eyeline.motion.track import Track
from eyeline.scene.pose import Samples
from eyeline.scene.scene import Scene

PLACES = ("translation", "rotation", "scale")


def without_constraints(scene: Scene, sampling: Sampling, note: Callable[[str], None]) -> Scene:
    """A scene that moves as this one does and has no constraints: their nodes have keys in every clip."""
    if not scene.constraints:
        return scene
    settled = replace(scene, nodes=replace(scene, clips=()).at(0.0).nodes, constraints=())
    clips = [_baked(clip, scene, settled, sampling) for clip in scene.clips if isinstance(clip, Clip)]
    names = ", ".join(repr(constraint.name) for constraint in scene.constraints)
    note(f"what the constraints {names} do is sampled at {sampling.fps:g} times a second")
    return replace(settled, clips=tuple(clips))


def _baked(clip: Clip, scene: Scene, settled: Scene, sampling: Sampling) -> Clip:
    """The clip with tracks in place of constraints, and without tracks that only move those."""
    kept = [
        track
        for track in clip.tracks
        if track.kind != "constraint" and not track.property.startswith("controls.")
    ]
    times = frame_times(clip.duration, sampling.fps)
    wanted, found = clip.sample(scene, times), Clip(clip.name, kept).sample(settled, times)
    baked: dict[tuple[int, str], Track] = {}
    for node, part, values in _differing(wanted, found):
        turns = part == "rotation"
        curve = fitted(times, values, sampling.tolerance, turns).curve
        baked[node, part] = Track("node", scene.paths[node], part, curve)
    kept = [
        track
        for track in kept
        if track.kind != "node" or (scene.find(track.name), track.property) not in baked
    ]
    return Clip(clip.name, [*kept, *baked.values()])


def _differing(wanted: Samples, found: Samples) -> list[tuple[int, str, FloatArray]]:
    """The parts of nodes that are not yet where they should be: (node, part, values (T, ...))."""
    differing = []
    for part in PLACES:
        ours, theirs = getattr(wanted, part), getattr(found, part)
        nodes = np.flatnonzero((ours != theirs).any(axis=(0, 2)))
        differing += [(int(node), part, ours[:, node]) for node in nodes]
    for node, weights in wanted.weights.items():
        if not np.array_equal(weights, found.weights[node]):
            differing.append((node, "weights", weights))
    return differing


def frame_times(duration: float, fps: float) -> FloatArray:
    """(T,) from 0 to the end of a clip, both in it, as the format can hold them."""
    count = max(1, int(np.ceil(duration * fps)))
    return np.linspace(0, duration, count + 1 if duration else 1).astype(np.float32).astype(np.float64)
