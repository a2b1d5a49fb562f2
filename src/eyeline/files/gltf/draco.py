"""KHR_draco_mesh_compression: vertices and faces packed by Draco, unpacked by DracoPy."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from eyeline.errors import FileError
from eyeline.files.gltf.accessors import Numbers
from eyeline.files.gltf.attributes import read_names
from eyeline.files.gltf.buffers import Buffers
from eyeline.files.gltf.document import Document
from eyeline.files.gltf.part import Part, spoken
from eyeline.geometry.arrays import IntArray


@dataclass(frozen=True, eq=False)
class Unpacked:
    """What a packet held."""

    attributes: Mapping[str, Numbers]  # (V, width) as they are stored
    corners: IntArray  # (3 F,)


@dataclass(frozen=True, eq=False)
class Draco:
    """The packets of a document, each unpacked once."""

    document: Document
    buffers: Buffers
    _unpacked: dict[tuple[int, str], Unpacked] = field(default_factory=dict)

    def __call__(self, packed: Part) -> Unpacked:
        """The vertices and corners of a primitive."""
        view, named = packed.whole("bufferView"), packed.part("attributes")
        key = (view, repr(sorted(named.values.items())))
        if key not in self._unpacked:
            data = self.buffers.view(view, packed.at("bufferView")).data.tobytes()
            self._unpacked[key] = self._decoded(packed, named, data)
        return self._unpacked[key]

    def _decoded(self, packed: Part, named: Part, data: bytes) -> Unpacked:
        import DracoPy

        try:
            mesh = DracoPy.decode(data)
            faces = np.asarray(mesh.faces, dtype=np.int64)
            stored = {one["unique_id"]: np.asarray(one["data"]) for one in mesh.attributes}
        except MemoryError:
            raise
        except Exception as error:  # DracoPy's errors share no other ancestor
            raise FileError(
                f"{packed.place} is no mesh that Draco can unpack; the file is damaged"
            ) from error
        names = read_names(named.values)
        for name in names:
            if named.whole(name) not in stored:
                raise named.refuse(name, f"the packet holds {spoken(sorted(stored))}")
        attributes = {name: stored[named.whole(name)] for name in names}
        self.document.numbers.spend(
            faces.size + sum(values.size for values in attributes.values()), packed.place
        )
        return Unpacked(attributes, faces.reshape(-1))
