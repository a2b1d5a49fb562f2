"""Functions that Numba compiles when they are first called, not at import."""

from __future__ import annotations

import os
import threading
import types
from collections.abc import Callable
from functools import cached_property, wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, cast

from eyeline.jit import kept
from eyeline.jit.fingerprint import fingerprint
from eyeline.jit.folder import announce, cache_folder
from eyeline.jit.forms import Form, form_of, marks, told

if TYPE_CHECKING:
    from eyeline.jit.machine import Loaded

Function = TypeVar("Function", bound=Callable[..., Any])

# Numba's own switch: kernels run as the Python they are written in
INTERPRETED = os.environ.get("NUMBA_DISABLE_JIT", "") not in ("", "0")

COMMON = {"nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True}  # C code calls no kernel of ours

KERNELS: list[Kernel] = []  # in order of import

_compiling = threading.RLock()


class Kernel:
    """A function that Python calls and Numba has compiled.

    The first call with arguments of a form loads the machine code for it from the user's cache folder,
    without importing Numba, or has it compiled and keeps it there.
    """

    def __init__(self, function: Callable[..., Any], options: dict[str, object]) -> None:
        wraps(function)(self)
        self.function = function
        self.options = options
        self._latest: Callable[[tuple[Any, ...]], Any] = _no_form_yet
        self._loaded: dict[Form, Loaded] = {}
        KERNELS.append(self)

    def __call__(self, *arguments: Any) -> Any:
        """Run, compiled."""
        result = self._latest(arguments)
        return self._other(arguments) if result is NotImplemented else result

    def _other(self, arguments: tuple[Any, ...]) -> Any:
        """Run with arguments of another form than the latest."""
        form = form_of(arguments)
        loaded = self._loaded.get(form) or self._load(form)
        self._latest = loaded.guarded
        return loaded.trusting(arguments)

    def _load(self, form: Form) -> Loaded:
        """The machine code for arguments of this form."""
        from eyeline.jit.machine import Loaded

        with _compiling:
            if form not in self._loaded:
                name = kept.file_name(self._identity, told(form))
                folder = cache_folder()
                file = folder and folder / name
                machine = (file and kept.read(file)) or self._compile(form, name, file)
                self._loaded[form] = Loaded(machine, marks(form))
            return self._loaded[form]

    def _compile(self, form: Form, name: str, file: Path | None) -> kept.MachineCode:
        announce("eyeline: compiling kernels for this machine, this once (up to 20 s)")
        from eyeline.jit import compiler

        function = _for_numba(self.function)
        # Machine code of all kernels is linked together; no two may have a name in common
        function.__qualname__ = name
        machine, stands_alone = compiler.compiled(function, self.options, form)
        if file and stands_alone:
            kept.write(file, machine)
        return machine

    @cached_property
    def _identity(self) -> str:
        function = self.function
        return f"{function.__module__}.{function.__qualname__}-{fingerprint(function, self.options)}"


class Helper:
    """A function that kernels call: compiled into them, without a way in from Python.

    Called from Python, which tests do, it is compiled once more, with one.
    """

    def __init__(self, function: Callable[..., Any], options: dict[str, object]) -> None:
        wraps(function)(self)
        self.function = function
        self.options = options

    def __call__(self, *arguments: Any) -> Any:
        """Run, compiled for Python."""
        return self._from_python(*arguments)

    @cached_property
    def for_kernels(self) -> Callable[..., Any]:
        """What Numba finds under its name in the globals of a kernel."""
        import numba

        wrapped = {"no_cpython_wrapper": True, "_nrt": False}
        return cast(Callable[..., Any], numba.njit(**(self.options | wrapped))(_for_numba(self.function)))

    @cached_property
    def _from_python(self) -> Callable[..., Any]:
        import numba

        return cast(Callable[..., Any], numba.njit(**self.options)(_for_numba(self.function)))


class Intrinsic(Helper):
    """A machine instruction that Numba offers and Python does not; uncompiled, the function stands in."""

    @cached_property
    def for_kernels(self) -> Callable[..., Any]:
        """Numba's own."""
        from numba.cpython.unsafe import numbers

        return cast(Callable[..., Any], getattr(numbers, self.function.__name__.lstrip("_")))


def _for_numba(function: Callable[..., Any]) -> types.FunctionType:
    """The function, with Numba's functions in its globals where ours name helpers."""
    code, scope = function.__code__, dict(function.__globals__)
    for name in code.co_names:
        if isinstance(scope.get(name), Helper):
            scope[name] = scope[name].for_kernels
    copy = types.FunctionType(code, scope, code.co_name, function.__defaults__)
    copy.__module__, copy.__qualname__ = function.__module__, function.__qualname__
    return copy


def _no_form_yet(arguments: tuple[Any, ...]) -> Any:
    return NotImplemented


def kernel(function: Function) -> Function:
    """Compile `function` when it is first called: releases the GIL, IEEE arithmetic, kept on disk."""
    return function if INTERPRETED else cast(Function, Kernel(function, COMMON))


def helper(function: Function) -> Function:
    """A scalar function that kernels call: compiled into them, without reference counts of its own."""
    return function if INTERPRETED else cast(Function, Helper(function, COMMON))


def _trailing_zeros(number: int) -> int:
    """How many zeros a whole number other than 0 ends with, in bits."""
    return (int(number) & -int(number)).bit_length() - 1


trailing_zeros = (
    _trailing_zeros if INTERPRETED else cast(Callable[[int], int], Intrinsic(_trailing_zeros, {}))
)
