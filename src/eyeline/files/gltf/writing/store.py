"""A glTF file in the making: lists of things, and the bytes that hold their numbers."""

from __future__ import annotations

import hashlib
from typing import Any

import numpy as np
import numpy.typing as npt

Thing = dict[str, Any]

VERTICES, INDICES = 34962, 34963  # what a view of the buffer is for
COMPONENTS = {"uint8": 5121, "uint16": 5123, "uint32": 5125, "float32": 5126}
TYPES = {(): "SCALAR", (2,): "VEC2", (3,): "VEC3", (4,): "VEC4", (4, 4): "MAT4"}


class Store:
    """Everything the file holds so far; equal numbers are kept once."""

    def __init__(self) -> None:
        self.lists: dict[str, list[Thing]] = {}
        self.data = bytearray()
        self.extensions: set[str] = set()
        self.root_extensions: Thing = {}
        self._accessors: dict[bytes, int] = {}

    def add(self, kind: str, thing: Thing) -> int:
        """The number of a new thing in its list."""
        things = self.lists.setdefault(kind, [])
        things.append(thing)
        return len(things) - 1

    def extended(self, name: str, values: Thing) -> Thing:
        """`extensions` of one name, which the file then says it uses."""
        self.extensions.add(name)
        return {"extensions": {name: values}}

    def view(self, data: bytes | memoryview, target: int | None = None) -> int:
        """The number of a view of these bytes, which begin at a multiple of four."""
        self.data += bytes(-len(self.data) % 4)
        view: Thing = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)}
        self.data += data
        return self.add("bufferViews", view if target is None else {**view, "target": target})

    def accessor(self, values: npt.NDArray[Any], target: int | None = None, bounded: bool = False) -> int:
        """The number of an accessor of (N, ...) float32 or unsigned whole numbers.

        Matrices (N, 4, 4) are stored column by column. bounded: with the least and greatest of each column.
        Numbers that are all zero take no bytes where they belong to vertices.
        """
        if values.shape[1:] == (4, 4):
            values = values.transpose(0, 2, 1)
        values = np.ascontiguousarray(values)
        label = repr((values.dtype.name, values.shape, target, bounded)).encode()
        key = hashlib.blake2b(values.data.cast("B"), key=hashlib.blake2b(label).digest()).digest()
        if key not in self._accessors:
            thing: Thing = {
                "componentType": COMPONENTS[values.dtype.name],
                "count": len(values),
                "type": TYPES[values.shape[1:]],
            }
            if target != VERTICES or values.any():
                thing["bufferView"] = self.view(values.data.cast("B"), target)
            if bounded:
                rows = values.reshape(len(values), -1)
                thing |= {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
            self._accessors[key] = self.add("accessors", thing)
        return self._accessors[key]


def number(value: float) -> float | int:
    """A number as JSON writes it shortest: 1 in place of 1.0."""
    return int(value) if float(value).is_integer() and abs(value) < 2**53 else float(value)


def numbers(values: npt.ArrayLike) -> list[float | int]:
    """Many of them, flat."""
    return [number(value) for value in np.asarray(values, dtype=np.float64).reshape(-1).tolist()]


def named(name: str, thing: Thing) -> Thing:
    """The thing with its name first; an empty one is left out."""
    return {"name": name, **thing} if name else thing
