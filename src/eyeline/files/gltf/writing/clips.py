"""Clips: channels move nodes, pointers move all else. [glTF 2.0, 3.11; KHR_animation_pointer]"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from eyeline.files.gltf.writing.addresses import Address, Change, pointer_to
from eyeline.files.gltf.writing.curves import Fitted, as_gltf, switches
from eyeline.files.gltf.writing.materials import Materials
from eyeline.files.gltf.writing.store import Store, Thing, named
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.clip import Clip
from eyeline.motion.curve import Curve
from eyeline.motion.track import Track
from eyeline.scene.camera import fov_of
from eyeline.scene.scene import Scene

KINDS = {"step": "STEP", "linear": "LINEAR", "cubic": "CUBICSPLINE"}
POINTER = "KHR_animation_pointer"


@dataclass(frozen=True, eq=False)
class Clips:
    """Writes the clips of a scene; tolerance: of what must be sampled, as a part of its range."""

    store: Store
    scene: Scene
    bearers: Mapping[int, list[int]]  # node -> the nodes of the file that have its mesh
    materials: Materials
    tolerance: float
    note: Callable[[str], None]

    def __call__(self, clip: Clip) -> None:
        """Add a clip to the file; one that moves nothing the format knows is left out."""
        samplers: list[Thing] = []
        channels: list[Thing] = []
        lost: list[str] = []
        for track in clip.tracks:
            places = self._places(track)
            if not places:
                self.note(f"clip {clip.name!r} moves {track.property} of {track.name!r}, which glTF cannot")
                continue
            samplers.append(self._sampler(self._curve(track, clip, places[0].change), track.property))
            targets = [self._target(place) for place in places]
            channels += [{"sampler": len(samplers) - 1, "target": target} for target in targets]
            lost += [f"{track.property} of {track.name!r}"] if places[0].pointer else []
        if not channels:
            self.note(f"clip {clip.name!r} moves nothing that glTF can move; it is left out")
            return
        if lost:
            self.note(f"clip {clip.name!r}: a player without {POINTER} leaves still {', '.join(lost)}")
        thing = named(clip.name, {"samplers": samplers, "channels": channels})
        self.store.add("animations", thing)

    def _places(self, track: Track) -> list[Address]:
        if track.kind == "constraint":
            return []
        if track.kind == "material":
            numbers = self.materials.by_name.get(track.name, [])
            found = (one for number in numbers for one in pointer_to("materials", number, track.property))
            return [Address(pointer=pointer) for pointer in found]
        node = self.scene.find(track.name)
        if track.property == "weights":
            return [Address("weights", number) for number in self.bearers.get(node, [])]
        if track.property in ("translation", "rotation", "scale"):
            return [Address(track.property, node)]
        change = CHANGES.get(track.property)
        return [Address(pointer=pointer, change=change) for pointer in self._found(track.property, node)]

    def _found(self, name: str, node: int) -> Iterator[str]:
        """Pointers to a lens, a light, or what is shown."""
        if name == "visible":
            yield from pointer_to("nodes", node, name)
        for thing in self._holders(node):
            if "camera" in thing:
                lens = self.store.lists["cameras"][thing["camera"]]["type"]
                yield from pointer_to("cameras", thing["camera"], name, lens)
            light = thing.get("extensions", {}).get("KHR_lights_punctual")
            if light is not None:
                yield from pointer_to("lights", light["light"], name)

    def _holders(self, node: int) -> list[Thing]:
        """The node in the file, and one put inside it."""
        nodes = self.store.lists["nodes"]
        inside = [nodes[one] for one in nodes[node].get("children", ()) if one >= len(self.scene.nodes)]
        return [nodes[node], *inside]

    def _curve(self, track: Track, clip: Clip, change: Change | None) -> Curve:
        """A curve the format knows; what had to be sampled is told."""
        if track.property == "visible":
            return switches(track.curve, clip.duration)
        if track.property == "emissive":
            strength = self._strength(track.name)
            change = None if strength == 1 else lambda values: values / strength
        if change is not None and track.property != "camera.focal_length":
            curve = track.curve
            if curve.is_plain:
                scaled = Curve(curve.times, change(curve.values), curve.interpolation)
                return self._told(as_gltf(scaled, clip.duration, self.tolerance), track, clip)
        return self._told(as_gltf(track.curve, clip.duration, self.tolerance, change), track, clip)

    def _strength(self, name: str) -> float:
        number = self.materials.by_name[name][0]
        extensions = self.store.lists["materials"][number].get("extensions", {})
        strength = extensions.get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1.0)
        return float(strength)

    def _told(self, made: Fitted, track: Track, clip: Clip) -> Curve:
        if made.error:
            self.note(
                f"clip {clip.name!r}: {track.property} of {track.name!r} is sampled"
                f" with {len(made.curve.times)} keys, within {made.error:.2g}"
            )
        return made.curve

    def _target(self, place: Address) -> Thing:
        if place.path:
            return {"node": place.node, "path": place.path}
        return {"path": "pointer", **self.store.extended(POINTER, {"pointer": place.pointer})}

    def _sampler(self, curve: Curve, name: str) -> Thing:
        """Key times and values in 32 bits; what is shown or hidden in a byte."""
        shape = () if name == "weights" else curve.shape
        values = curve.values.reshape(-1, *shape)
        return {
            "input": self.store.accessor(curve.times.astype(np.float32), bounded=True),
            "output": self.store.accessor(values.astype(np.uint8 if name == "visible" else np.float32)),
            "interpolation": KINDS[curve.ways[0]],
        }


def _fov(values: FloatArray) -> FloatArray:
    return np.array([fov_of(float(value)) for value in values.reshape(-1)]).reshape(values.shape)


def _halved(values: FloatArray) -> FloatArray:
    return values / 2


# From our values to the file's
CHANGES: dict[str, Change] = {
    "camera.focal_length": _fov,
    "camera.height": _halved,
}
