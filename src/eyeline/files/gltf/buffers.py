"""Bytes: buffers from the binary chunk, data URIs and files, and views that cut them. [glTF 2.0, 3.6.1]"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from eyeline.errors import FileError
from eyeline.files.gltf import meshopt
from eyeline.files.gltf.addresses import beside, embedded, present
from eyeline.files.gltf.document import Document
from eyeline.files.gltf.part import Part
from eyeline.geometry.arrays import ByteArray


@dataclass(frozen=True, eq=False)
class View:
    """A stretch of bytes, and how far apart its elements are; stride 0 is one after the other."""

    data: ByteArray  # (N,)
    stride: int


@dataclass(frozen=True, eq=False)
class Buffers:
    """The bytes of a document, read when first asked for."""

    document: Document
    _buffers: dict[int, ByteArray] = field(default_factory=dict)
    _views: dict[int, View] = field(default_factory=dict)

    def view(self, index: int, place: str) -> View:
        """The view that `place` names, decompressed where it is compressed."""
        if index not in self._views:
            part = self.document.one("bufferViews", index, place)
            packed = meshopt.extension(part)
            if packed is None:
                stride = part.whole("byteStride") if part.has("byteStride") else 0
                if part.has("byteStride") and not 4 <= stride <= 252:
                    raise part.refuse("byteStride", "4 to 252 is needed")
                self._views[index] = View(self.cut(part), stride)
            else:
                self.document.numbers.spend(meshopt.size(packed) // 4, packed.place)
                stride = part.whole("byteStride", 0)
                self._views[index] = View(meshopt.unpacked(packed, self.cut(packed)), stride)
        return self._views[index]

    def cut(self, part: Part) -> ByteArray:
        """The bytes from `byteOffset`, `byteLength` long, of the buffer that a part names."""
        data = self.buffer(part.whole("buffer"), part.at("buffer"))
        offset, length = part.whole("byteOffset", 0), part.whole("byteLength", low=1)
        if offset + length > len(data):
            raise FileError(
                f"{part.place} wants bytes {offset:,} to {offset + length:,} of {len(data):,};"
                " the file is damaged"
            )
        return data[offset : offset + length]

    def buffer(self, index: int, place: str) -> ByteArray:
        """The buffer that `place` names, as long as it says it is."""
        if index not in self._buffers:
            part = self.document.one("buffers", index, place)
            length = part.whole("byteLength", low=1)
            data = self._stored(part, index, length)
            if len(data) < length:
                raise FileError(
                    f"{part.at('byteLength')} is {length:,}, and there are {len(data):,} bytes; it is cut off"
                )
            self._buffers[index] = data[:length]
        return self._buffers[index]

    def _stored(self, part: Part, index: int, length: int) -> ByteArray:
        """What is really there of a buffer; of a file, no more than is wanted."""
        if not part.has("uri"):
            if index != 0 or self.document.binary is None:
                raise part.refuse("uri", "only the first buffer of a GLB may do without")
            return self.document.binary
        data = embedded(part)
        if data is None:
            path = beside(part, self.document.folder)
            if not present(part, path):
                raise part.refuse("uri", "there is no such file in the model's folder, so put it there")
            with path.open("rb") as file:
                data = file.read(min(length, path.stat().st_size))
            self.document.count(len(data))
        return np.frombuffer(data, np.uint8)
