"""Animations as clips: channels that move nodes, and pointers that move all else. [glTF 2.0, 3.11]"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from eyeline.cached import cached_property
from eyeline.files.gltf.accessors import Accessors
from eyeline.files.gltf.document import Document
from eyeline.files.gltf.materials import emissive_strength
from eyeline.files.gltf.names import unique
from eyeline.files.gltf.part import Part, spoken
from eyeline.files.gltf.pointers import Moved, moved
from eyeline.files.gltf.samplers import Keys, keys_of
from eyeline.files.gltf.tree import Tree
from eyeline.motion.clip import Clip
from eyeline.motion.track import SHAPES, Kind, Track
from eyeline.scene.scene import Scene

PATHS = ("translation", "rotation", "scale", "weights")


@dataclass(frozen=True, eq=False)
class Animations:
    """Makes the clips of a scene."""

    document: Document
    accessors: Accessors
    material_names: tuple[str, ...]
    tree: Tree
    scene: Scene
    _keys: dict[str, Keys] = field(default_factory=dict)

    def __call__(self) -> tuple[Clip, ...]:
        """A clip for each animation; names that files leave out are their numbers."""
        parts = self.document.all("animations")
        names = unique(part.name(f"animation {index}") for index, part in enumerate(parts))
        return tuple(self._clip(part, name) for part, name in zip(parts, names, strict=True))

    def _clip(self, part: Part, name: str) -> Clip:
        samplers = part.parts("samplers")
        tracks: dict[tuple[str, str, str], Track] = {}
        for channel in part.parts("channels"):
            number = channel.whole("sampler")
            if number >= len(samplers):
                raise channel.refuse("sampler", f"the animation has {len(samplers)} samplers")
            what = self._moved(channel.part("target"), name)
            for track in () if what is None else self._tracks(what, samplers[number]):
                key = (track.kind, track.name, track.property)
                if key in tracks:
                    self._note(
                        name,
                        f"moves {track.property} of {spoken(track.name)} twice; the first of both counts",
                    )
                tracks.setdefault(key, track)
        return Clip(name, tracks.values())

    def _note(self, clip_name: str, what: str) -> None:
        self.document.notes.add(f"clip {spoken(clip_name)} {what}")

    def _moved(self, target: Part, clip_name: str) -> Moved | None:
        """What a channel moves; None for what changes no picture, which is reported."""
        path = target.text("path")
        pointer = target.extension("KHR_animation_pointer")
        if path == "pointer" and pointer is not None:
            what = moved(pointer.text("pointer"))
            if what is None:
                self._note(clip_name, f"moves {spoken(pointer.text('pointer'))}, which is not drawn")
                return None
            place = pointer.at("pointer")
        elif path in PATHS and target.has("node"):
            what, place = Moved("nodes", target.whole("node"), path), target.at("node")
        else:
            self._note(clip_name, f"moves {spoken(path)} of nothing that is read")
            return None
        if what.owner != "lights":
            self.document.one(what.owner, what.index, place)
        if not self._owners(what):
            self._note(
                clip_name,
                f"moves {what.property} of {what.owner}[{what.index}], which the scene does not show",
            )
            return None
        return what

    def _tracks(self, what: Moved, sampler: Part) -> Iterator[Track]:
        """A track for each node, or for the material, that is moved."""
        if sampler.place not in self._keys:
            self._keys[sampler.place] = keys_of(self.accessors, sampler)
        keys = self._keys[sampler.place]
        if what.change is not None:
            keys = keys.changed(what.change)
        ours = what.property
        if what.owner == "materials" and ours in ("emissive", "emissive_strength"):
            ours, keys = "emissive", self._emissive(what, keys)
        kind: Kind = "material" if what.owner == "materials" else "node"
        for owner in self._owners(what):
            shape = SHAPES[kind][ours]
            name = self.material_names[owner] if kind == "material" else self.scene.paths[owner]
            if shape is None:
                mesh = self.scene.nodes[owner].mesh
                shape = (0 if mesh is None else len(mesh.targets),)
            turns = kind == "node" and ours == "rotation"
            yield Track(kind, name, ours, keys.curve(shape, rotation=turns))

    def _owners(self, what: Moved) -> list[int]:
        """The scene's nodes that a channel moves, or the material."""
        if what.owner == "materials":
            return [what.index]
        nodes = self._standing.get((what.owner, what.index), [])
        if what.property != "weights":
            return nodes
        return [node for node in nodes if (mesh := self.scene.nodes[node].mesh) is not None and mesh.targets]

    @cached_property
    def _standing(self) -> dict[tuple[str, int], list[int]]:
        """Where each node, mesh, camera and light of the file stands in the scene."""
        places: dict[tuple[str, int], list[int]] = {}
        for node, number in enumerate(self.tree.order):
            part = self.document.all("nodes")[number]
            light = part.extension("KHR_lights_punctual")
            links = {"nodes": number, "meshes": part.link("mesh"), "cameras": part.link("camera")}
            links["lights"] = None if light is None else light.link("light")
            for owner, link in links.items():
                if link is not None:
                    places.setdefault((owner, link), []).append(node)
        return places

    def _emissive(self, what: Moved, keys: Keys) -> Keys:
        """Keys of the emissive colour with its strength folded in, from keys of one of them."""
        part = self.document.all("materials")[what.index]
        if what.property == "emissive":
            strength = emissive_strength(part)
            return keys.shaped((3,)).changed(lambda values: values * strength)
        factor = np.array(part.numbers("emissiveFactor", (0.0, 0.0, 0.0)))
        return keys.shaped(()).changed(lambda values: values * factor)
