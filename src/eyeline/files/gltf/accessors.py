"""Accessors: bytes as arrays of numbers, sparse and normalized ones too. [glTF 2.0, 3.6.2]"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from eyeline.errors import FileError
from eyeline.files.gltf.buffers import Buffers
from eyeline.files.gltf.document import Document
from eyeline.files.gltf.part import Part, spoken
from eyeline.files.limits import LARGEST
from eyeline.geometry.arrays import FloatArray, IntArray

Numbers = npt.NDArray[Any]

COMPONENTS: dict[int, np.dtype[Any]] = {
    5120: np.dtype("<i1"),
    5121: np.dtype("<u1"),
    5122: np.dtype("<i2"),
    5123: np.dtype("<u2"),
    5125: np.dtype("<u4"),
    5126: np.dtype("<f4"),
}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


@dataclass(frozen=True, eq=False)
class Accessors:
    """The arrays of a document, each made once."""

    document: Document
    buffers: Buffers
    _floats: dict[int, FloatArray] = field(default_factory=dict)
    _wholes: dict[int, IntArray] = field(default_factory=dict)

    def floats(self, index: int, types: tuple[str, ...], place: str) -> FloatArray:
        """(count, width) float32; whole numbers become 0..1 or -1..1 where they are normalized."""
        part = self._checked(index, types, place)
        if index not in self._floats:
            self._floats[index] = as_floats(part, self._stored(part))
        return self._floats[index]

    def unpacked(self, index: int, types: tuple[str, ...], place: str, stored: Numbers) -> FloatArray:
        """The same for numbers that were stored elsewhere, in a packet."""
        part = self._checked(index, types, place)
        if stored.ndim != 2 or stored.shape[1] != WIDTHS[part.text("type")]:
            raise FileError(f"{part.place} is {part.text('type')}, and its packet has shape {stored.shape}")
        return as_floats(part, stored)

    def wholes(self, index: int, types: tuple[str, ...], place: str) -> IntArray:
        """(count, width) unsigned whole numbers, as wide as they are stored."""
        part = self._checked(index, types, place)
        if index not in self._wholes:
            stored = self._stored(part)
            if stored.dtype.kind != "u":
                raise part.refuse("componentType", "whole numbers, 5121, 5123 or 5125, are needed")
            self._wholes[index] = stored
        return self._wholes[index]

    def is_whole(self, index: int, place: str) -> bool:
        """Whether an accessor stores whole numbers that are not normalized."""
        part = self.document.one("accessors", index, place)
        return part.whole("componentType") != 5126 and not part.flag("normalized")

    def count(self, index: int, place: str) -> int:
        """How many elements an accessor has, unread."""
        return self.document.one("accessors", index, place).whole("count", low=1)

    def _checked(self, index: int, types: tuple[str, ...], place: str) -> Part:
        part = self.document.one("accessors", index, place)
        if part.text("type") not in types:
            raise part.refuse("type", f"{place} needs {' or '.join(types)}")
        return part

    def _stored(self, part: Part) -> Numbers:
        """(count, width) a copy of the numbers as they are stored."""
        count, width, kind = part.whole("count", low=1), WIDTHS[part.text("type")], component(part)
        self.document.numbers.spend(count * width, part.place)
        if part.has("bufferView"):
            values = self._elements(part, count, width, kind)
        else:
            values = np.zeros((count, width), kind)
        return self._patched(part, values) if part.has("sparse") else values

    def _elements(self, part: Part, count: int, width: int, kind: np.dtype[Any]) -> Numbers:
        """(count, width) a copy of the numbers in the view that a part names."""
        view = self.buffers.view(part.whole("bufferView"), part.at("bufferView"))
        offset = part.whole("byteOffset", 0)
        size = width * kind.itemsize
        stride = view.stride or size
        if stride < size:
            raise FileError(f"{part.place} has elements of {size} bytes in a view of stride {stride}")
        end = offset + stride * (count - 1) + size
        if end > len(view.data):
            raise FileError(
                f"{part.place} ends at byte {end:,} of a view of {len(view.data):,}; the file is damaged"
            )
        window = np.ndarray((count, width), kind, view.data.data, offset, (stride, kind.itemsize))
        return np.array(window, order="C")

    def _patched(self, part: Part, values: Numbers) -> Numbers:
        """The values with those that the sparse part gives put in their places."""
        sparse = part.part("sparse")
        count = sparse.whole("count", low=1)
        if count > len(values):
            raise sparse.refuse("count", f"at most the accessor's own count, {len(values)}, is needed")
        self.document.numbers.spend(count * (1 + values.shape[1]), sparse.place)
        where, what = sparse.part("indices"), sparse.part("values")
        if component(where).kind != "u":
            raise where.refuse("componentType", "whole numbers, 5121, 5123 or 5125, are needed")
        rows = self._elements(where, count, 1, component(where))[:, 0]
        if rows.max() >= len(values) or (rows[1:] <= rows[:-1]).any():
            raise FileError(f"{where.place} must rise and stay below {len(values)}; the file is damaged")
        values[rows] = self._elements(what, count, values.shape[1], values.dtype)
        return values


def component(part: Part) -> np.dtype[Any]:
    """How one number of an accessor is stored."""
    kind = COMPONENTS.get(part.whole("componentType"))
    if kind is None:
        raise part.refuse("componentType", f"one of {', '.join(map(str, COMPONENTS))} is needed")
    return kind


def as_floats(part: Part, stored: Numbers) -> FloatArray:
    """The numbers an accessor means by those it stores."""
    values = normalized(stored) if part.flag("normalized") else stored.astype(np.float32)
    sound = np.abs(values) <= LARGEST
    if not sound.all():
        row = int(np.flatnonzero(~sound.all(axis=1))[0])
        raise FileError(
            f"{part.place} holds {spoken(values[row].tolist())} at {row};"
            f" numbers of at most {LARGEST:g} are needed"
        )
    return values


def normalized(stored: Numbers) -> FloatArray:
    """Whole numbers as 0..1, or -1..1 where they have a sign. [glTF 2.0, 3.6.2.2]"""
    if stored.dtype.kind == "f":
        return stored.astype(np.float32)
    largest = np.float32(np.iinfo(stored.dtype).max)
    values: FloatArray = np.maximum(stored.astype(np.float32) / largest, np.float32(-1))
    return values
