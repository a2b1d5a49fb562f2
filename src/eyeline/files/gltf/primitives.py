"""Primitives: the vertices and faces of one part of a mesh, as they are stored. [glTF 2.0, 3.7.2]"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from eyeline.errors import FileError
from eyeline.files.gltf.accessors import Accessors, normalized
from eyeline.files.gltf.attributes import TYPES, read_names
from eyeline.files.gltf.draco import Draco, Unpacked
from eyeline.files.gltf.part import Part, spoken
from eyeline.files.gltf.topology import TRIANGLES, UNDRAWN, left_over, triangles
from eyeline.geometry.arrays import FloatArray, IntArray

Attributes = Mapping[str, FloatArray]


@dataclass(frozen=True, eq=False)
class Vertices:
    """What the vertices carry, by attribute."""

    attributes: Attributes  # (V, width) float32
    targets: tuple[Attributes, ...]  # differences

    @property
    def count(self) -> int:
        """Vertices."""
        return len(self.attributes["POSITION"])


@dataclass(frozen=True, eq=False)
class Primitive:
    """Faces over vertices that it may share with others, and the number of their material."""

    vertices: Vertices
    faces: IntArray  # (F, 3)
    material: int | None


@dataclass(frozen=True, eq=False)
class Primitives:
    """Reads primitives: from accessors, or from Draco's packets."""

    accessors: Accessors
    draco: Draco
    _vertices: dict[tuple[object, ...], Vertices] = field(default_factory=dict)

    def __call__(self, part: Part, mesh_name: str) -> Primitive | None:
        """A primitive of a mesh; None for one without faces, which is reported."""
        notes = self.accessors.document.notes
        mode = part.whole("mode", TRIANGLES)
        if mode in UNDRAWN:
            notes.add(f"mesh {spoken(mesh_name)} has {UNDRAWN[mode]}, which are not drawn")
            return None
        if mode > max(UNDRAWN) + 3:
            raise part.refuse("mode", "0 to 6 is needed")
        named = part.part("attributes")
        if not named.has("POSITION"):
            notes.add(f"mesh {spoken(mesh_name)} has a primitive without POSITION, which is not drawn")
            return None
        packed = part.extension("KHR_draco_mesh_compression")
        unpacked = None if packed is None else self.draco(packed)
        vertices = self._shared(part, unpacked)
        if unpacked is None:
            corners = self._corners(part, vertices.count)
        else:
            corners, mode = inside(unpacked.corners, vertices.count, part.place), TRIANGLES
        if loose := left_over(len(corners), mode):
            notes.add(f"mesh {spoken(mesh_name)} has {loose} corners left over that make no face")
        faces = triangles(corners, mode)
        self.accessors.document.numbers.spend(faces.size, part.place)
        return Primitive(vertices, faces, part.link("material"))

    def _shared(self, part: Part, unpacked: Unpacked | None) -> Vertices:
        """The vertices of a primitive, the same for all that name the same accessors."""
        named = part.part("attributes")
        key = (
            repr(sorted(named.values.items())),
            repr(part.values.get("targets")),
            unpacked and id(unpacked),
        )
        if key not in self._vertices:
            attributes = {name: self._attribute(named, name, unpacked) for name in read_names(named.values)}
            count = equally_long(attributes, named)
            targets = tuple(self._target(target, count) for target in part.parts("targets"))
            self._vertices[key] = Vertices(attributes, targets)
        return self._vertices[key]

    def _attribute(self, named: Part, name: str, unpacked: Unpacked | None) -> FloatArray:
        """(V, width) an attribute of the vertices; colours are widened by their alpha, 1."""
        index, place = named.whole(name), named.at(name)
        types = TYPES[name.split("_")[0]]
        if unpacked is not None and name in unpacked.attributes:
            values = self.accessors.unpacked(index, types, place, unpacked.attributes[name])
        elif name.startswith("JOINTS"):
            values = self.accessors.wholes(index, types, place).astype(np.float32)
        elif name.startswith(("COLOR", "WEIGHTS")) and self.accessors.is_whole(index, place):
            self.accessors.document.notes.add(f"{place} is not marked as normalized; it is read as 0 to 1")
            values = normalized(self.accessors.wholes(index, types, place))
        else:
            values = self.accessors.floats(index, types, place)
        return widened(values, 1) if name.startswith("COLOR") else values

    def _corners(self, part: Part, count: int) -> IntArray:
        """(N,) vertex numbers; one after the other where none are listed."""
        if not part.has("indices"):
            return np.arange(count, dtype=np.int32)
        index = part.whole("indices")
        return inside(
            self.accessors.wholes(index, ("SCALAR",), part.at("indices"))[:, 0], count, part.at("indices")
        )

    def _target(self, target: Part, count: int) -> Attributes:
        """(V, width) the differences of a morph target."""
        found = {}
        for name in read_names(target.values):
            if name.startswith(("JOINTS", "WEIGHTS")):
                continue
            types = ("VEC3",) if name == "TANGENT" else TYPES[name.split("_")[0]]
            values = self.accessors.floats(target.whole(name), types, target.at(name))
            if len(values) != count:
                raise FileError(f"{target.at(name)} has {len(values)} differences for {count} vertices")
            found[name] = widened(values, 0) if name.startswith("COLOR") else values
        return found


def widened(colors: FloatArray, alpha: float) -> FloatArray:
    """(V, 4) colours (V, 3) or (V, 4) with an alpha."""
    if colors.shape[1] == 4:
        return colors
    return np.column_stack([colors, np.full(len(colors), alpha, np.float32)])


def inside(corners: IntArray, count: int, place: str) -> IntArray:
    """(N,) int32 corners, each refused that is no vertex."""
    if len(corners) and corners.max() >= count:
        at = int(corners.argmax())
        raise FileError(
            f"{place} names vertex {corners[at]} at {at}, and there are {count}; the file is damaged"
        )
    return corners.astype(np.int32)


def equally_long(attributes: Attributes, named: Part) -> int:
    """How many vertices there are; refused if two attributes do not agree."""
    counts = {name: len(values) for name, values in attributes.items()}
    if len(set(counts.values())) > 1:
        raise FileError(f"{named.place} has attributes of {counts} vertices; all must have as many")
    return counts["POSITION"]
