"""Images: PNG, JPEG and WebP as RGBA bytes; the pixels are counted before any is decoded."""

from __future__ import annotations

from dataclasses import dataclass, field

from eyeline.files.gltf.addresses import beside, embedded, present
from eyeline.files.gltf.buffers import Buffers
from eyeline.files.gltf.document import Document
from eyeline.files.gltf.part import Part, spoken
from eyeline.files.pictures import decoded
from eyeline.geometry.arrays import ByteArray

FORMATS = ("PNG", "JPEG", "WebP")


@dataclass(frozen=True, eq=False)
class Images:
    """The images of a document, each decoded once."""

    document: Document
    buffers: Buffers
    _images: dict[int, ByteArray | None] = field(default_factory=dict)

    def __call__(self, index: int, place: str) -> ByteArray | None:
        """(H, W, 4) the image that `place` names; None where its file is not there, which is reported."""
        if index not in self._images:
            part = self.document.one("images", index, place)
            data = self._encoded(part)
            self._images[index] = (
                None if data is None else decoded(data, part.place, FORMATS, self.document.pixels)
            )
        return self._images[index]

    def _encoded(self, part: Part) -> bytes | None:
        if part.has("bufferView"):
            return self.buffers.view(part.whole("bufferView"), part.at("bufferView")).data.tobytes()
        data = embedded(part)
        if data is None:
            path = beside(part, self.document.folder)
            if not present(part, path):
                uri = spoken(part.text("uri"))
                self.document.notes.add(
                    f"the image {uri} is not in the model's folder; what it covers is drawn without it"
                )
                return None
            data = path.read_bytes()
            self.document.count(len(data))
        return data
