"""Good glTF files with something bent in them, and files that claim more than they hold."""

from __future__ import annotations

import io
import json
import struct
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from files.gltf_builder import SQUARE, SQUARE_FACES, Builder, floats


@dataclass(frozen=True)
class Broken:
    """A file that cannot be read; `sentence` follows its name and a colon."""

    name: str
    make: Callable[[], bytes | dict[str, Any]]
    sentence: str  # a regular expression
    suffix: str = ".gltf"
    beside: Mapping[str, bytes] = field(default_factory=dict)

    def write(self, folder: Path) -> Path:
        for name, data in self.beside.items():
            (folder / name).write_bytes(data)
        made = self.make()
        path = folder / f"broken{self.suffix}"
        path.write_bytes(made if isinstance(made, bytes) else json.dumps(made).encode())
        return path


def square(change: Callable[[dict[str, Any]], object] = lambda root: None) -> Builder:
    """A good file of one square, and what is changed in it."""
    builder = Builder()
    builder.node(mesh=builder.square())
    change(builder.json)
    return builder


def bent(*path: str | int, to: Any) -> Callable[[], dict[str, Any]]:
    """The square with one value changed; in `to`, ... takes the value away."""

    def make() -> dict[str, Any]:
        root = square().whole()
        thing = root
        for key in path[:-1]:
            thing = thing[key]  # type: ignore[index]
        if to is ...:
            del thing[path[-1]]  # type: ignore[arg-type]
        else:
            thing[path[-1]] = to  # type: ignore[index]
        return root

    return make


def with_image(data: bytes) -> Callable[[], dict[str, Any]]:
    def make() -> dict[str, Any]:
        builder = Builder()
        builder.add("images", bufferView=builder.view(data))
        builder.add("textures", source=0)
        builder.add("materials", emissiveTexture={"index": 0})
        builder.node(mesh=builder.square(material=0))
        return builder.whole()

    return make


def with_points(points: Any) -> Callable[[], dict[str, Any]]:
    def make() -> dict[str, Any]:
        builder = Builder()
        builder.node(mesh=builder.mesh({"POSITION": points}, SQUARE_FACES))
        return builder.whole()

    return make


def with_animation(
    times: Any, values: Any, interpolation: str = "LINEAR", path: str = "scale"
) -> Callable[[], Any]:
    def make() -> dict[str, Any]:
        builder = square()
        builder.animation(path, 0, times, values, interpolation)
        return builder.whole()

    return make


def with_skin(
    joint: int = 0, joints: list[int] | None = None, matrices: int = 1
) -> Callable[[], dict[str, Any]]:
    def make() -> dict[str, Any]:
        builder = Builder()
        attributes = {
            "POSITION": SQUARE,
            "JOINTS_0": np.full((4, 4), joint, np.uint8),
            "WEIGHTS_0": floats(*[[1, 0, 0, 0]] * 4),
        }
        builder.node(mesh=builder.mesh(attributes, SQUARE_FACES), skin=0)
        bind = builder.accessor(np.tile(np.eye(4, dtype=np.float32), (matrices, 1, 1)))
        builder.add("skins", joints=[0] if joints is None else joints, inverseBindMatrices=bind)
        return builder.whole()

    return make


def with_nodes(children: list[list[int]], roots: list[int]) -> Callable[[], dict[str, Any]]:
    def make() -> dict[str, Any]:
        nodes = [{"children": below} if below else {} for below in children]
        return {"asset": {"version": "2.0"}, "nodes": nodes, "scenes": [{"nodes": roots}]}

    return make


def with_extension(place: str, **extension: Any) -> Callable[[], dict[str, Any]]:
    """The square's first node, view or primitive with an extension."""

    def make() -> dict[str, Any]:
        root = square().whole()
        things = {
            "nodes": root["nodes"][0],
            "bufferViews": root["bufferViews"][0],
            "primitives": root["meshes"][0]["primitives"][0],
        }
        things[place]["extensions"] = extension
        return root

    return make


def unbacked(count: int, **values: Any) -> dict[str, Any]:
    """A file of some hundred bytes whose vertices are zeros, as many as it likes."""
    builder = Builder()
    number = builder.add("accessors", componentType=5126, count=count, type="VEC3", **values)
    builder.node(mesh=builder.mesh({"POSITION": number}))
    return builder.whole()


def many_zeros(primitives: int) -> dict[str, Any]:
    """Each primitive a million zeros of its own: each is small, all together are not."""
    builder = Builder()
    zeros = [
        builder.add("accessors", componentType=5126, count=10**6, type="VEC3") for _ in range(primitives)
    ]
    builder.add("meshes", primitives=[{"attributes": {"POSITION": number}} for number in zeros])
    builder.node(mesh=0)
    return builder.whole()


def instanced(count: int) -> dict[str, Any]:
    builder = square()
    number = builder.add("accessors", componentType=5126, count=count, type="VEC3")
    named = {"attributes": {"TRANSLATION": number}}
    builder.json["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": named}
    return builder.whole()


def meshopt_bomb() -> dict[str, Any]:
    builder = Builder()
    data = {"buffer": 0, "byteLength": 64, "byteStride": 256, "count": 2**40, "mode": "ATTRIBUTES"}
    builder.view(bytes(64))
    builder.add("bufferViews", buffer=0, byteLength=2**48, extensions={"EXT_meshopt_compression": data})
    number = builder.add("accessors", bufferView=1, componentType=5126, count=9, type="VEC3")
    builder.node(mesh=builder.mesh({"POSITION": number}))
    return builder.whole()


def png_of(width: int, height: int) -> bytes:
    """A PNG that claims a size, and holds next to nothing."""

    def piece(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + piece(b"IHDR", header)
        + piece(b"IDAT", zlib.compress(b"\0" * 64))
        + piece(b"IEND", b"")
    )


def deep(depth: int) -> bytes:
    return b'{"asset": {"version": "2.0"}, "extras": ' + b"[" * depth + b"]" * depth + b"}"


def long_paths() -> dict[str, Any]:
    """A chain of nodes whose path names would fill gigabytes."""
    nodes: list[dict[str, Any]] = [{"children": [number + 1], "name": "n" * 40} for number in range(3_000)]
    return {"asset": {"version": "2.0"}, "nodes": [*nodes, {}], "scenes": [{"nodes": [0]}]}


def huge_translation() -> bytes:
    """JSON may hold a number that no double can."""
    root = bent("nodes", 0, "translation", to=["huge", 0, 0])()
    return json.dumps(root).replace('"huge"', "1e999").encode()


def growing() -> dict[str, Any]:
    """Nodes of which each is enormous within the one above it."""
    root = with_nodes([[1], [2], []], [0])()
    for node in root["nodes"]:
        node["scale"] = [1e9] * 3
    return root


def whole_glb() -> bytes:
    return square().glb()


def gif() -> bytes:
    from PIL import Image

    file = io.BytesIO()
    Image.new("P", (2, 2)).save(file, "GIF")
    return file.getvalue()


def square_with_uv(count: int) -> dict[str, Any]:
    builder = Builder()
    builder.node(mesh=builder.mesh({"POSITION": SQUARE, "TEXCOORD_0": SQUARE[:count, :2]}, SQUARE_FACES))
    return builder.whole()


def with_target(count: int) -> dict[str, Any]:
    builder = Builder()
    target = {"POSITION": builder.accessor(np.zeros((count, 3), np.float32))}
    builder.node(mesh=builder.square(targets=[target]))
    return builder.whole()


def with_material(material: dict[str, Any]) -> dict[str, Any]:
    builder = Builder()
    builder.add("materials", **material)
    builder.node(mesh=builder.square(material=0))
    return builder.whole()


def with_camera(lens: dict[str, float]) -> dict[str, Any]:
    builder = square()
    builder.node(camera=builder.add("cameras", type="perspective", perspective=lens))
    return builder.whole()
