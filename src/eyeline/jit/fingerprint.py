"""What a kernel is compiled from, as a short text: equal texts, equal machine code.

Numba's own file cache looks at the file a kernel stands in: it does not see that a helper in another
file has changed, and it compiles again where only a comment has.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator
from types import CodeType, ModuleType
from typing import Any

import numpy as np

# Whose attributes a kernel may read: what they hold does not change while their version is the same
FOREIGN_MODULES = ("math", "numpy")


def fingerprint(function: Callable[..., Any], options: dict[str, object]) -> str:
    """The hash of a function, how it is compiled, all that it calls, and every value it reads."""
    digest = hashlib.sha256(repr(options).encode())
    for piece in _pieces(function, set()):
        digest.update(piece.encode() + b"\0")
    return digest.hexdigest()[:24]


def _pieces(function: Callable[..., Any], told: set[CodeType]) -> Iterator[str]:
    code = function.__code__
    if code in told:
        return
    told.add(code)
    # The first constant is the docstring where there is one; lines and places of the code are left out
    constants = code.co_consts[1:] if code.co_consts[:1] == (function.__doc__,) else code.co_consts
    yield from (function.__qualname__, code.co_code.hex(), repr(code.co_names), repr(code.co_varnames))
    yield from (str(code.co_argcount), repr(function.__defaults__))
    for value in constants:
        yield _told(value, function)
    for name in code.co_names:
        if name in function.__globals__:
            value = function.__globals__[name]
            yield name
            if callee := getattr(value, "function", None):
                yield repr(value.options)
                yield from _pieces(callee, told)
            else:
                yield _told(value, function)


def _told(value: object, function: Callable[..., Any]) -> str:
    """A value that a kernel reads, as text that no other value has."""
    if value is None or isinstance(value, bool | int | float | complex | str | np.generic | np.dtype):
        return f"{type(value).__name__} {value!r}"
    if isinstance(value, tuple):
        return f"{type(value).__name__} ({', '.join(_told(one, function) for one in value)})"
    if isinstance(value, type):
        return f"{value.__module__}.{value.__qualname__}"
    if isinstance(value, ModuleType) and value.__name__ in FOREIGN_MODULES:
        return value.__name__
    raise TypeError(
        f"{function.__qualname__} reads {value!r}; kernels read numbers, texts, tuples, types and kernels"
    )
