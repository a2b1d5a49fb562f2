"""The outermost shell: JSON text alone (.gltf), or JSON and one binary chunk in a GLB. [glTF 2.0, 4]"""

from __future__ import annotations

import json
import struct
from typing import Any, NoReturn

import numpy as np

from eyeline.errors import FileError
from eyeline.files.limits import JSON_BYTES
from eyeline.geometry.arrays import ByteArray

MAGIC = b"glTF"
HEADER = struct.Struct("<4sII")  # magic, version, length of the file
CHUNK = struct.Struct("<II")  # length of the data, type
JSON_CHUNK, BINARY_CHUNK = 0x4E4F534A, 0x004E4942


def opened(data: bytes) -> tuple[dict[str, Any], ByteArray | None]:
    """The JSON object and the binary chunk of a file's bytes; what the bytes are decides, not the suffix."""
    if data[:4] == MAGIC:
        text, binary = _chunks(data)
        return _parsed(text), binary
    if not data.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"{"):
        raise FileError(f"begins with {data[:4]!r}, which is neither JSON nor 'glTF'; export the model again")
    return _parsed(data), None


def _chunks(data: bytes) -> tuple[bytes, ByteArray | None]:
    """The JSON text and the binary chunk of a GLB; chunks of other types are skipped, as the format asks."""
    if len(data) < HEADER.size + CHUNK.size:
        raise FileError(
            f"has {len(data)} bytes; a GLB has at least {HEADER.size + CHUNK.size}, so it is cut off"
        )
    _, version, length = HEADER.unpack_from(data)
    if version != 2:
        raise FileError(f"is GLB version {version}; version 2 is needed, so export the model as glTF 2.0")
    if length > len(data):
        raise FileError(f"claims {length:,} bytes and has {len(data):,}; it is cut off, so copy it again")
    found: dict[int, memoryview] = {}
    view = memoryview(data)
    offset = HEADER.size
    while offset + CHUNK.size <= length:
        size, kind = CHUNK.unpack_from(data, offset)
        offset += CHUNK.size
        if size > length - offset:
            raise FileError(
                f"a chunk claims {size:,} bytes where {length - offset:,} are left; the file is damaged"
            )
        if offset == HEADER.size + CHUNK.size and kind != JSON_CHUNK:
            raise FileError(
                f"its first chunk has type {kind:#x}; JSON is needed there, so the file is damaged"
            )
        found.setdefault(kind, view[offset : offset + size])
        offset += size + -size % 4
    if JSON_CHUNK not in found:
        raise FileError(f"claims {length} bytes, which hold no JSON; the file is damaged")
    binary = found.get(BINARY_CHUNK)
    return bytes(found[JSON_CHUNK]), None if binary is None else np.frombuffer(binary, np.uint8)


def _parsed(text: bytes) -> dict[str, Any]:
    """The JSON object of UTF-8 text."""
    if len(text) > JSON_BYTES:
        raise FileError(
            f"has {len(text):,} bytes of JSON; at most {JSON_BYTES:,} are read, so use a binary buffer"
        )
    try:
        value = json.loads(text.decode("utf-8-sig"), parse_constant=_refuse_constant)
    except UnicodeDecodeError as error:
        raise FileError(f"its JSON is not UTF-8 at byte {error.start}; export the model again") from error
    except RecursionError as error:
        raise FileError("its JSON is nested too deep; the file is damaged") from error
    except json.JSONDecodeError as error:
        raise FileError(
            f"its JSON breaks at line {error.lineno} column {error.colno}: {error.msg}; export it again"
        ) from error
    except ValueError as error:
        raise FileError("its JSON holds a number of thousands of digits; the file is damaged") from error
    if not isinstance(value, dict):
        raise FileError(f"its JSON is a {type(value).__name__}; an object is needed")
    return value


def _refuse_constant(word: str) -> NoReturn:
    raise FileError(f"its JSON holds {word}, which is no JSON number; export the model again")
