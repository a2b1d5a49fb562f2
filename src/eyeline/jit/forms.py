"""What machine code must know of a call's arguments: the types of scalars and arrays, not their values."""

from __future__ import annotations

from typing import Any

import numpy as np

Form = tuple[Any, ...]

# Bits of an array's flags, fixed by NumPy
C_ORDER, FORTRAN_ORDER, ALIGNED, WRITEABLE = 0x1, 0x2, 0x100, 0x400

# Scalars of Python and of NumPy that machine code cannot tell apart
_ALIKE: dict[type, type] = {int: np.int64, float: np.float64, bool: np.bool}
_PLAIN = {scalar: plain for plain, scalar in _ALIKE.items()}


def form_of(arguments: tuple[Any, ...]) -> Form:
    """Equal for calls that the same machine code serves; a key of dictionaries.

    Of an array (elements, dimensions, order, aligned, writeable), of a tuple (class, forms of members), of
    a scalar its type.
    """
    return tuple(_form(one) for one in arguments)


def _form(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        flags = value.flags.num
        # An array of one row has both orders, and is like others of C's
        order = "C" if flags & C_ORDER else "F" if flags & FORTRAN_ORDER else "A"
        return value.dtype, value.ndim, order, bool(flags & ALIGNED), bool(flags & WRITEABLE)
    kind = type(value)
    if isinstance(value, tuple):
        return kind, tuple(_form(one) for one in value)
    return _PLAIN.get(kind, kind)


def told(form: Any) -> str:
    """A form as text, which says the same in every process.

    The names of a named tuple's fields are part of it: a kernel finds the fields by their places.
    """
    if isinstance(form, type):
        return f"{form.__module__}.{form.__qualname__}{getattr(form, '_fields', '')}"
    if isinstance(form, tuple):
        return f"({', '.join(told(one) for one in form)})"
    return repr(form)


def marks(form: Form) -> list[int]:
    """The addresses that `guard` compares, in its order; they hold for this process, while the form lives."""
    found = []
    for one in form:
        if isinstance(one, type):
            found += [id(one), id(_ALIKE.get(one, one))]
        elif isinstance(one[0], type):
            found += [id(one[0]), *marks(one[1])]
        else:
            found += [id(np.ndarray), id(one[0])]
    return found


def flags_of(order: str, aligned: bool, writeable: bool) -> tuple[int, int]:
    """Which of an array's flags a form tells, and what they are."""
    orders = {"C": (C_ORDER, C_ORDER), "F": (C_ORDER | FORTRAN_ORDER, FORTRAN_ORDER)}
    asked, wanted = orders.get(order, (C_ORDER | FORTRAN_ORDER, 0))
    return asked | ALIGNED | WRITEABLE, wanted | (ALIGNED if aligned else 0) | (WRITEABLE if writeable else 0)
