"""A scene as a glTF file, part by part."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from eyeline.files.gltf.notes import Notes
from eyeline.files.gltf.writing.baking import without_constraints
from eyeline.files.gltf.writing.clips import Clips
from eyeline.files.gltf.writing.container import Pictures, document, write
from eyeline.files.gltf.writing.deformers import without_deformers
from eyeline.files.gltf.writing.materials import Materials
from eyeline.files.gltf.writing.meshes import Meshes
from eyeline.files.gltf.writing.nodes import Nodes
from eyeline.files.gltf.writing.store import Store
from eyeline.files.gltf.writing.textures import Textures
from eyeline.files.saving import Sampling
from eyeline.motion.clip import Clip
from eyeline.motion.track import Track
from eyeline.scene.scene import Scene

PLACES = ("translation", "rotation", "scale")


def save(scene: Scene, path: Path, sampling: Sampling) -> tuple[str, ...]:
    """Write a scene; answers what the file does not hold, or holds otherwise."""
    notes = Notes()
    acting = scene
    scene = without_constraints(acting, sampling, notes.add)
    scene = without_deformers(scene, acting, sampling, notes.add)
    clips = [clip for clip in scene.clips if isinstance(clip, Clip)]
    tracks = [track for clip in clips for track in clip.tracks]
    store = Store()
    pictures = Pictures(path, store)
    materials = Materials(store, Textures(store, pictures), notes.add, moving(tracks), glow(tracks))
    nodes = Nodes(
        store,
        Meshes(store, materials, notes.add),
        notes.add,
        scene,
        moved(tracks, scene, PLACES),
        moved(tracks, scene, ("visible",)),
    )
    roots = nodes()
    write_clip = Clips(store, scene, nodes.bearers, materials, sampling.tolerance, notes.add)
    for clip in clips:
        write_clip(clip)
    if not is_depth_first(scene):
        notes.add("the nodes come back depth first, and the faces are numbered in that order")
    write(path, document(store, roots, scene.name), bytes(store.data), pictures.beside)
    return notes.sentences


def moving(tracks: list[Track]) -> dict[str, set[str]]:
    """The properties of materials that clips move."""
    found: dict[str, set[str]] = {}
    for track in tracks:
        if track.kind == "material":
            found.setdefault(track.name, set()).add(track.property)
    return found


def glow(tracks: list[Track]) -> dict[str, float]:
    """The greatest emission that each material is moved to, at its keys and between them."""
    found: dict[str, float] = {}
    for track in tracks:
        if track.kind == "material" and track.property == "emissive":
            dense = np.linspace(track.curve.times[0], track.curve.times[-1], DENSE)
            values = np.concatenate([track.curve.at(track.curve.times), track.curve.at(dense)])
            found[track.name] = max(found.get(track.name, 0.0), float(values.max()))
    return found


DENSE = 256  # times at which the greatest value of a curve is looked for


def moved(tracks: list[Track], scene: Scene, properties: tuple[str, ...]) -> set[int]:
    """The nodes of which clips move one of these properties."""
    return {
        scene.find(track.name) for track in tracks if track.kind == "node" and track.property in properties
    }


def is_depth_first(scene: Scene) -> bool:
    """Whether each node follows its parent or what stands under a brother."""
    trail: list[int] = []
    for index, node in enumerate(scene.nodes):
        if node.parent >= 0:
            while trail and trail[-1] != node.parent:
                trail.pop()
            if not trail:
                return False
        trail = [*trail, index] if node.parent >= 0 else [index]
    return True
