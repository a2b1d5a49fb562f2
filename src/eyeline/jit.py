"""The only place that knows Numba: kernels, where they are kept, and the threads they run on.

A kernel is compiled at its first call, not at import, so that `import eyeline` does not load Numba.
Compiled code is kept in a folder named by a hash of every source file of the package: Numba's own
cache does not see that a helper in another file has changed.
"""

from __future__ import annotations

import hashlib
import os
import pickle
import sys
import threading
import types
import zlib
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache, cached_property, wraps
from pathlib import Path
from typing import Any, TypeVar, cast

Function = TypeVar("Function", bound=Callable[..., Any])
Result = TypeVar("Result")

COMMON = {"nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True}  # C code calls no kernel of ours

KERNELS: list[Kernel] = []  # every kernel and helper, in order of import

_compiling = threading.RLock()


class Kernel:
    """A function that Numba compiles when it is first called.

    Called from Python it compiles itself and every kernel or helper its body names, once, and keeps
    the machine code in the user's cache folder.
    """

    def __init__(self, function: Callable[..., Any], options: dict[str, object]) -> None:
        wraps(function)(self)
        self.function = function
        self.options = options
        self._compiled: Callable[..., Any] | None = None
        KERNELS.append(self)

    def __call__(self, *arguments: Any) -> Any:
        """Run, compiled."""
        return (self._compiled or self.compiled())(*arguments)

    def compiled(self) -> Callable[..., Any]:
        """The dispatcher of this kernel, made at the first request."""
        with _compiling:
            if self._compiled is None:
                self._compiled = self._compile()
            return self._compiled

    def _compile(self) -> Callable[..., Any]:
        import numba

        code = self.function.__code__
        scope = dict(self.function.__globals__)
        function = types.FunctionType(code, scope, code.co_name, self.function.__defaults__)
        function.__module__ = self.function.__module__
        function.__qualname__ = self.function.__qualname__

        def name_kernels() -> None:
            # The body's globals name other kernels; Numba must find their dispatchers there.
            for name in code.co_names:
                if isinstance(scope.get(name), Kernel):
                    scope[name] = scope[name].compiled()

        folder = cache_folder() if self.options.get("cache") else None
        kept = numba.config.CACHE_DIR
        numba.config.CACHE_DIR = str(folder or "")
        try:
            dispatcher = numba.njit(**(self.options | {"cache": folder is not None}))(function)
        finally:
            numba.config.CACHE_DIR = kept
        if folder is None or numba.config.DISABLE_JIT:
            name_kernels()
        else:
            load_without_compiler(dispatcher, name_kernels)
            refuse_damage(dispatcher)
        return cast(Callable[..., Any], dispatcher)


def load_without_compiler(dispatcher: Any, before_compiling: Callable[[], None]) -> None:
    """Let kept machine code be loaded without the compiler: a process's first picture comes 0.4 s sooner.

    Before Numba looks into its cache it imports all that it can compile, and scipy.linalg for that;
    loading needs none of it, and a compilation that follows imports it anyway. Nor does loading need the
    dispatchers of what a kernel calls: `before_compiling` makes them.
    """
    from numba.core.runtime import rtsys

    kept = dispatcher._cache

    def load_overload(signature: Any, target: Any) -> Any:
        rtsys.initialize(target)
        try:
            found = kept._load_overload(signature, target)
        except Exception:  # a damaged file can end in any of them
            announce("eyeline: a kept kernel is damaged; it is compiled again")
            kept.flush()
            found = None
        if found is None:
            before_compiling()
        return found

    kept.load_overload = load_overload


def refuse_damage(dispatcher: Any) -> None:
    """Keep machine code with a check sum, for what a damaged file holds would run."""
    from numba.core.serialize import dumps

    form = dispatcher._cache._impl
    reduce, rebuild = form.reduce, form.rebuild

    def reduce_checked(result: Any) -> tuple[int, bytes]:
        code = dumps(reduce(result))
        return zlib.crc32(code), code

    def rebuild_checked(target: Any, kept: tuple[int, bytes]) -> Any:
        check, code = kept
        if zlib.crc32(code) != check:
            raise ValueError("the check sum is wrong")
        return rebuild(target, pickle.loads(code))

    form.reduce, form.rebuild = reduce_checked, rebuild_checked


class Intrinsic(Kernel):
    """A machine instruction that Numba offers and Python does not; uncompiled, the function stands in."""

    def _compile(self) -> Callable[..., Any]:
        import numba

        if numba.config.DISABLE_JIT:
            return self.function
        from numba.cpython.unsafe import numbers

        return cast(Callable[..., Any], getattr(numbers, self.function.__name__))


class Helper(Kernel):
    """A function that kernels call.

    It is compiled without a way in from Python, which no kernel needs and which takes as long as the body;
    called from Python, which tests do, it is compiled once more, with one.
    """

    @cached_property
    def _from_python(self) -> Kernel:
        return Kernel(self.function, self.options | {"no_cpython_wrapper": False})

    def __call__(self, *arguments: Any) -> Any:
        """Run, compiled for Python."""
        return self._from_python(*arguments)


def kernel(function: Function) -> Function:
    """Compile `function` when it is first called: releases the GIL, IEEE arithmetic, kept on disk."""
    return cast(Function, Kernel(function, COMMON | {"cache": True}))


def helper(function: Function) -> Function:
    """A scalar function that kernels call: compiled into them, without reference counts of its own."""
    return cast(Function, Helper(function, COMMON | {"no_cpython_wrapper": True, "_nrt": False}))


def _trailing_zeros(number: int) -> int:
    return (int(number) & -int(number)).bit_length() - 1


_trailing_zeros.__name__ = "trailing_zeros"
trailing_zeros = cast(Callable[[int], int], Intrinsic(_trailing_zeros, {}))


# --- where compiled kernels are kept ------------------------------------------------------------------


@cache
def cache_folder() -> Path | None:
    """The folder of compiled kernels for exactly these sources, or None where none can be written.

    EYELINE_CACHE_DIR overrides the user's cache directory. Says one line on a terminal when empty.
    """
    folder = cache_root() / f"kernels-{_hash_of_sources()}"
    if not folder.is_dir():
        announce("eyeline: compiling kernels for this machine, this once (10 to 20 s)")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return None
    return folder if os.access(folder, os.W_OK) else None


def cache_root() -> Path:
    """The user's cache directory for eyeline."""
    if chosen := os.environ.get("EYELINE_CACHE_DIR"):
        return Path(chosen)
    base = os.environ.get("XDG_CACHE_HOME")
    return (Path(base) if base else Path.home() / ".cache") / "eyeline"


def _hash_of_sources() -> str:
    import numba

    package = Path(__file__).parent
    digest = hashlib.sha256(f"{numba.__version__} {sys.version}".encode())
    for source in sorted(package.rglob("*.py")):
        digest.update(source.read_bytes())
    return digest.hexdigest()[:16]


def announce(line: str) -> None:
    """One line on the terminal, and nothing in a pipe."""
    if sys.stderr is not None and sys.stderr.isatty():
        print(line, file=sys.stderr, flush=True)


# --- threads --------------------------------------------------------------------------------------------


@cache
def threads() -> int:
    """How many threads kernels run on: EYELINE_THREADS or NUMBA_NUM_THREADS, else the cores we may use."""
    for name in ("EYELINE_THREADS", "NUMBA_NUM_THREADS"):
        if (value := os.environ.get(name, "")).isdigit() and int(value) > 0:
            return int(value)
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@cache
def _pool() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(max(1, threads() - 1), thread_name_prefix="eyeline")


if hasattr(os, "register_at_fork"):
    # Threads do not follow into a forked process: work shared there would wait for them for ever
    os.register_at_fork(after_in_child=_pool.cache_clear)


def share(task: Callable[[int], Result], parts: int) -> list[Result]:
    """[task(0), ... task(parts - 1)], side by side; part 0 on the caller's thread.

    A task must not share again: it would wait for the thread it runs on.
    """
    rest = [_pool().submit(task, part) for part in range(1, parts)]
    first = task(0)
    return [first, *(later.result() for later in rest)]
