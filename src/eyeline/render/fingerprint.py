"""A hash of data: equal data, equal hash, on every machine."""

from __future__ import annotations

import hashlib
import struct
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np

from eyeline.version import __version__


def fingerprint(value: Any) -> str:
    """The SHA-256, in hexadecimal, of frozen data: numbers, text, arrays, tuples, mappings, objects of them.

    The version of eyeline is part of it: another version may draw other pictures.
    """
    return _digest((__version__, value), {}).hex()


def _digest(value: Any, known: dict[int, bytes]) -> bytes:
    """32 bytes; `known` holds those of objects and arrays met before, by identity, for many share one."""
    kind = f"<{type(value).__qualname__}".encode()
    if value is None or isinstance(value, (bool, int, str, np.integer)):
        return hashlib.sha256(
            b"<plain" + repr(value.item() if isinstance(value, np.integer) else value).encode()
        ).digest()
    if isinstance(value, (float, np.floating)):
        return hashlib.sha256(b"<number" + struct.pack("<d", value)).digest()
    if isinstance(value, (tuple, list)):
        return hashlib.sha256(b"<row" + b"".join(_digest(one, known) for one in value)).digest()
    if isinstance(value, Mapping):
        return hashlib.sha256(
            b"<pairs" + b"".join(sorted(_digest(pair, known) for pair in value.items()))
        ).digest()
    if id(value) not in known:
        if isinstance(value, np.ndarray):
            digest = hashlib.sha256(f"<array {value.dtype.str} {value.shape}".encode())
            digest.update(np.ascontiguousarray(value).data)
            known[id(value)] = digest.digest()
        else:
            parts = (
                [getattr(value, field.name) for field in fields(value)]
                if is_dataclass(value)
                else vars(value)
            )
            known[id(value)] = hashlib.sha256(kind + _digest(parts, known)).digest()
    return known[id(value)]
