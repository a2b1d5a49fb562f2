"""Machine code kept on disk: a file for each kernel and form of arguments, whole or not there."""

from __future__ import annotations

import hashlib
import json
import os
import sys
import zlib
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from eyeline.jit.folder import announce
from eyeline.jit.results import Plan

CHECK = 4  # bytes, at the head of a file
MAKERS = ("compiler", "entry", "guard", "memory", "objects", "kept", "results")  # what else shapes a file


def file_name(kernel: str, form: str) -> str:
    """The name of the file for a kernel, told by its name and fingerprint, and a form of arguments."""
    key = hashlib.sha256(f"{form}\0{_surroundings()}".encode())
    return f"{kernel}.{key.hexdigest()[:16]}.kernel"


@cache
def _surroundings() -> str:
    """What else machine code depends on: versions, the processor, and what the environment asks of Numba."""
    import llvmlite

    from eyeline.jit.machine import processor

    # Numba's version without importing it, which takes as long as the rest of a first picture
    found = find_spec("numba")
    version = Path(found.origin or "").with_name("_version.py").read_bytes() if found else b""
    asked = sorted(
        pair for pair in os.environ.items() if pair[0].startswith("NUMBA_") and pair[0] != "NUMBA_NUM_THREADS"
    )
    makers = [Path(__file__).with_name(f"{name}.py").read_bytes() for name in MAKERS]
    return repr((makers, version, llvmlite.__version__, np.__version__, sys.version, processor(), asked))


@dataclass(frozen=True)
class MachineCode:
    """An object file, its symbol that Python calls, and what becomes of what that returns."""

    symbol: str
    plan: Plan
    code: bytes


def read(path: Path) -> MachineCode | None:
    """What `write` has written; None if it is not there or not whole."""
    try:
        kept = path.read_bytes()
    except OSError:
        return None
    if kept[:CHECK] != zlib.crc32(kept[CHECK:]).to_bytes(CHECK, "little") or len(kept) <= CHECK:
        announce("eyeline: a kept kernel is damaged; it is compiled again")
        return None
    head, _, code = kept[CHECK:].partition(b"\n")
    symbol, plan = json.loads(head)
    return MachineCode(symbol, plan, code)


def write(path: Path, machine: MachineCode) -> None:
    """Write a file with a check sum, for what a damaged one holds would run.

    It appears whole, so that processes that write and read it side by side do not disturb each other. A
    folder that cannot be written keeps nothing.
    """
    body = json.dumps([machine.symbol, machine.plan]).encode() + b"\n" + machine.code
    unfinished = path.with_suffix(f".{os.urandom(8).hex()}")
    try:
        unfinished.write_bytes(zlib.crc32(body).to_bytes(CHECK, "little") + body)
        unfinished.replace(path)
    except OSError:
        unfinished.unlink(missing_ok=True)
