"""Images: PNG, JPEG and WebP as RGBA bytes; the pixels are counted before any is decoded."""

from __future__ import annotations

import io
import warnings
from dataclasses import dataclass, field

import numpy as np
from PIL import Image

from eyeline.errors import FileError
from eyeline.files.gltf.addresses import beside, embedded, present
from eyeline.files.gltf.buffers import Buffers
from eyeline.files.gltf.document import Document
from eyeline.files.gltf.limits import IMAGE_PIXELS
from eyeline.files.gltf.part import Part, spoken
from eyeline.geometry.arrays import ByteArray

FORMATS = ("PNG", "JPEG", "WEBP")


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
            self._images[index] = None if data is None else self._decoded(part, data)
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

    def _decoded(self, part: Part, data: bytes) -> ByteArray:
        # Pillow warns of large images; ours are counted and refused instead
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                with Image.open(io.BytesIO(data), formats=FORMATS) as image:
                    width, height = image.size
                    if width * height > IMAGE_PIXELS:
                        raise FileError(
                            f"{part.place} has {width} x {height} pixels; at most {IMAGE_PIXELS:,} are read,"
                            " so shrink it"
                        )
                    self.document.pixels.spend(width * height, part.place)
                    return _rgba(image)
            except Image.DecompressionBombError as error:
                raise FileError(
                    f"{part.place} has too many pixels; at most {IMAGE_PIXELS:,} are read"
                ) from error
            except (OSError, SyntaxError, ValueError, EOFError, IndexError, KeyError, TypeError) as error:
                raise FileError(
                    f"{part.place} is no PNG, JPEG or WebP image that can be read ({type(error).__name__});"
                    " save it again"
                ) from error


def _rgba(image: Image.Image) -> ByteArray:
    """(H, W, 4) uint8; deep greys lose their low bits; colour profiles are left aside, as the format asks."""
    if image.mode.startswith("I"):
        deep = np.asarray(image)
        grey = (deep >> 8).clip(0, 255).astype(np.uint8)
        return np.dstack([grey, grey, grey, np.full_like(grey, 255)])
    return np.array(image.convert("RGBA"))
