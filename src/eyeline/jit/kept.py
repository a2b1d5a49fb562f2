"""Machine code kept on disk: a file for each kernel and signature, whole or not there."""

from __future__ import annotations

import hashlib
import os
import pickle
import sys
import zlib
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from eyeline.jit.folder import announce

CHECK = 4  # bytes, at the head of a file


class Kept:
    """Where a dispatcher looks for machine code before it compiles, and puts what it has compiled.

    It stands in for Numba's file cache and answers to the names that dispatchers call. Numba's own looks
    at the date or the text of one source file; here the name says all that the code depends on.
    """

    def __init__(self, folder: Path, name: str, before_compiling: Callable[[], None]) -> None:
        self.cache_path = str(folder)
        self._folder = folder
        self._name = name
        self._before_compiling = before_compiling

    def load_overload(self, signature: Any, target: Any) -> Any:
        """What was compiled for this signature and this processor, or None.

        Numba's cache first imports all that the compiler can compile, and scipy.linalg for that; loading
        needs none of it, nor the dispatchers of what the kernel calls: `before_compiling` makes them.
        """
        from numba.core.compiler import CompileResult
        from numba.core.runtime import rtsys

        path = self._path(signature, target.codegen())
        if (code := read(path)) is not None:
            rtsys.initialize(target)
            try:
                return CompileResult._rebuild(target, *pickle.loads(code))
            except Exception:  # written by something that is not us, and it can end in any of them
                path.unlink(missing_ok=True)
        announce("eyeline: compiling kernels for this machine, this once (up to 20 s)")
        self._before_compiling()
        return None

    def save_overload(self, signature: Any, result: Any) -> None:
        """Keep what was compiled."""
        from numba.core.serialize import dumps

        if not result.library.has_dynamic_globals:
            write(self._path(signature, result.codegen), dumps(result._reduce()))

    def flush(self) -> None:
        """Forget every signature of this kernel."""
        for path in self._folder.glob(f"{self._name}.*"):
            path.unlink(missing_ok=True)

    def _path(self, signature: Any, codegen: Any) -> Path:
        key = hashlib.sha256(repr((str(signature), codegen.magic_tuple(), _surroundings())).encode())
        return self._folder / f"{self._name}.{key.hexdigest()[:16]}.kernel"


@cache
def _surroundings() -> tuple[object, ...]:
    """What else machine code depends on: versions, and what is asked of Numba by its environment."""
    import numba

    asked = sorted(
        pair for pair in os.environ.items() if pair[0].startswith("NUMBA_") and pair[0] != "NUMBA_NUM_THREADS"
    )
    return (numba.__version__, np.__version__, sys.version, asked)


def read(path: Path) -> bytes | None:
    """What `write` has written; None if it is not there or not whole."""
    try:
        kept = path.read_bytes()
    except OSError:
        return None
    code = kept[CHECK:]
    if kept[:CHECK] == zlib.crc32(code).to_bytes(CHECK, "little"):
        return code
    announce("eyeline: a kept kernel is damaged; it is compiled again")
    return None


def write(path: Path, code: bytes) -> None:
    """Write a file with a check sum, for what a damaged one holds would run.

    It appears whole, so that processes that write and read it side by side do not disturb each other. A
    folder that cannot be written keeps nothing.
    """
    unfinished = path.with_suffix(f".{os.urandom(8).hex()}")
    try:
        unfinished.write_bytes(zlib.crc32(code).to_bytes(CHECK, "little") + code)
        unfinished.replace(path)
    except OSError:
        unfinished.unlink(missing_ok=True)
