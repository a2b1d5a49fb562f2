"""Writes small glTF files for tests: the JSON is a plain dict, so that a test can bend any of it."""

from __future__ import annotations

import base64
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np

COMPONENTS = {"int8": 5120, "uint8": 5121, "int16": 5122, "uint16": 5123, "uint32": 5125, "float32": 5126}
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], np.float32)
SQUARE_FACES = np.array([0, 1, 2, 0, 2, 3], np.uint16)


class Builder:
    """A glTF file in the making; every method answers the number of what it added."""

    def __init__(self) -> None:
        self.json: dict[str, Any] = {"asset": {"version": "2.0"}}
        self.data = bytearray()

    def add(self, kind: str, **values: Any) -> int:
        things = self.json.setdefault(kind, [])
        things.append(values)
        return len(things) - 1

    def view(self, data: bytes, **values: Any) -> int:
        self.data += bytes(-len(self.data) % 4)
        offset = len(self.data)
        self.data += data
        return self.add("bufferViews", buffer=0, byteOffset=offset, byteLength=len(data), **values)

    def accessor(self, array: Any, **values: Any) -> int:
        """One for an array (N,) or (N, width); a (N, 4, 4) one is written column by column."""
        array = np.asarray(array)
        if array.ndim == 3:
            array = array.transpose(0, 2, 1)
        rows = np.ascontiguousarray(array).reshape(len(array), -1)
        kind = COMPONENTS[rows.dtype.name]
        values = {"componentType": kind, "count": len(rows), "type": TYPES[rows.shape[1]], **values}
        return self.add("accessors", bufferView=self.view(rows.tobytes()), **values)

    def mesh(self, attributes: dict[str, Any], indices: Any = None, **values: Any) -> int:
        """A mesh of one primitive; arrays become accessors, numbers name them."""
        primitive = {"attributes": {name: self._number(one) for name, one in attributes.items()}, **values}
        if indices is not None:
            primitive["indices"] = self._number(indices)
        return self.add("meshes", primitives=[primitive])

    def square(self, **values: Any) -> int:
        """A mesh of two faces in the plane z = 0."""
        return self.mesh({"POSITION": SQUARE}, SQUARE_FACES, **values)

    def node(self, **values: Any) -> int:
        """A node at the root of the first scene."""
        number = self.add("nodes", **values)
        if "scenes" not in self.json:
            self.json.update(scenes=[{"nodes": []}], scene=0)
        self.json["scenes"][0]["nodes"].append(number)
        return number

    def animation(self, path: str, node: int, times: Any, values: Any, interpolation: str = "LINEAR") -> int:
        target = {"node": node, "path": path}
        return self.channels([(target, times, values, interpolation)])

    def channels(self, channels: list[tuple[dict[str, Any], Any, Any, str]], **extra: Any) -> int:
        samplers = [
            {"input": self._number(times), "output": self._number(values), "interpolation": interpolation}
            for _, times, values, interpolation in channels
        ]
        listed = [{"sampler": number, "target": one[0]} for number, one in enumerate(channels)]
        return self.add("animations", samplers=samplers, channels=listed, **extra)

    def pointer(self, pointer: str, times: Any, values: Any, interpolation: str = "LINEAR") -> int:
        target = {"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": pointer}}}
        return self.channels([(target, times, values, interpolation)])

    def _number(self, thing: Any) -> int:
        return thing if isinstance(thing, int) else self.accessor(thing)

    # --- what is written --------------------------------------------------------------------------------

    def whole(self) -> dict[str, Any]:
        """The JSON with its buffer as a data URI."""
        if not self.data:
            return self.json
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        rest = self.json.get("buffers", [])[1:]
        return {**self.json, "buffers": [{"byteLength": len(self.data), "uri": uri}, *rest]}

    def glb(self) -> bytes:
        """The file as one binary."""
        if self.data:
            rest = self.json.get("buffers", [])[1:]
            self.json["buffers"] = [{"byteLength": len(self.data)}, *rest]
        return glb(json.dumps(self.json).encode(), bytes(self.data) or None)

    def write(self, folder: Path, name: str = "model.gltf") -> Path:
        path = folder / name
        path.write_bytes(self.glb() if name.endswith(".glb") else json.dumps(self.whole()).encode())
        return path


def chunk(kind: int, data: bytes, padding: bytes = b"\0") -> bytes:
    data += padding * (-len(data) % 4)
    return struct.pack("<II", len(data), kind) + data


def glb(text: bytes, binary: bytes | None = None) -> bytes:
    """A GLB of JSON text and a binary chunk."""
    chunks = chunk(0x4E4F534A, text, b" ")
    if binary is not None:
        chunks += chunk(0x004E4942, binary)
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def floats(*rows: Any) -> np.ndarray:
    return np.array(rows, np.float32)
