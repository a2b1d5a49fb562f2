"""Functions that Numba compiles when they are first called, not at import."""

from __future__ import annotations

import threading
import types
from collections.abc import Callable
from functools import cached_property, wraps
from typing import Any, TypeVar, cast

from eyeline.jit.fingerprint import fingerprint
from eyeline.jit.folder import cache_folder
from eyeline.jit.kept import Kept

Function = TypeVar("Function", bound=Callable[..., Any])

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

        keeps = self.options.get("cache") and not numba.config.DISABLE_JIT
        folder = cache_folder() if keeps else None
        dispatcher = numba.njit(**(self.options | {"cache": False}))(function)
        if folder:
            name = f"{function.__module__}.{function.__qualname__}-{fingerprint(self.function, self.options)}"
            dispatcher._cache = Kept(folder, name, name_kernels)
        else:
            name_kernels()
        return cast(Callable[..., Any], dispatcher)


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
