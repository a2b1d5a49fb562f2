"""Files of a glTF model: .glb, all in one; .gltf, with its numbers and pictures beside it. [glTF 2.0, 4.4]"""

from __future__ import annotations

import json
import struct
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import quote

from eyeline.files.gltf.writing.store import Store, Thing
from eyeline.files.whole import whole_file
from eyeline.version import __version__

MAGIC, VERSION = 0x46546C67, 2
JSON_CHUNK, BINARY_CHUNK = 0x4E4F534A, 0x004E4942
PNG = {"mimeType": "image/png"}


@dataclass(frozen=True, eq=False)
class Pictures:
    """Where pictures go: into the buffer of a .glb, into files beside a .gltf."""

    path: Path
    store: Store
    beside: dict[str, bytes] = field(default_factory=dict)  # file name -> what it holds

    def __call__(self, data: bytes) -> Thing:
        """What the file says of a picture."""
        if is_binary(self.path):
            return {"bufferView": self.store.view(data), **PNG}
        name = f"{self.path.stem}-{len(self.beside)}.png"
        self.beside[name] = data
        return {"uri": quote(name)}


def is_binary(path: Path) -> bool:
    """Whether all goes into one file."""
    return path.suffix.lower() == ".glb"


def document(store: Store, roots: list[int], name: str) -> Thing:
    """Everything but the buffer, as JSON has it."""
    scene: Thing = {"nodes": roots} if roots else {}
    root: Thing = {"asset": {"version": "2.0", "generator": f"eyeline {__version__}"}, "scene": 0}
    root["scenes"] = [{"name": name, **scene} if name else scene]
    used = sorted(store.extensions)
    root |= {"extensionsUsed": used} if used else {}
    root |= {"extensions": store.root_extensions} if store.root_extensions else {}
    return root | {kind: things for kind, things in store.lists.items() if things}


def write(path: Path, root: Thing, data: bytes, beside: dict[str, bytes]) -> None:
    """Put all files in their places, or none: the model last, so that it never names what is not there."""
    files = dict(beside)
    if is_binary(path):
        root |= {"buffers": [{"byteLength": len(data)}]} if data else {}
        files[path.name] = chunks(text(root), data)
    else:
        numbers = f"{path.stem}.bin"
        root |= {"buffers": [{"uri": quote(numbers), "byteLength": len(data)}]} if data else {}
        files |= ({numbers: data} if data else {}) | {path.name: text(root)}
    with ExitStack() as places:
        opened = {name: places.enter_context(whole_file(path.with_name(name))) for name in reversed(files)}
        for name, content in files.items():
            opened[name].write_bytes(content)


def text(root: Thing) -> bytes:
    """JSON in UTF-8, as short as it gets."""
    return json.dumps(root, separators=(",", ":"), ensure_ascii=False, allow_nan=False).encode()


def chunks(words: bytes, data: bytes) -> bytes:
    """A .glb file: a header, the JSON and the buffer, each filled up to four bytes."""
    parts = [(JSON_CHUNK, words + b" " * (-len(words) % 4))]
    parts += [(BINARY_CHUNK, data + bytes(-len(data) % 4))] if data else []
    body = b"".join(struct.pack("<II", len(content), kind) + content for kind, content in parts)
    return struct.pack("<III", MAGIC, VERSION, 12 + len(body)) + body
