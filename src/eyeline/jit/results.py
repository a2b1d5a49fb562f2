"""What a kernel returns, made of what its machine code gives: of arrays only numbers that describe them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

# None for a number or nothing; for an array the text of its element type; for a tuple those of its members
Plan = str | list[Any] | None

# Counts one reference less of memory with this head
Drop = Callable[[int], None]


class Held:
    """Memory that a kernel has made, or a part of its arguments, as NumPy takes it over without a copy."""

    def __init__(
        self, numbers: tuple[int, ...], element: str, drop: Callable[[int], None], source: Any
    ) -> None:
        head, data, *lengths = numbers
        dimensions = len(lengths) // 2
        self._head, self._drop = head, drop
        self._source = (
            None if head else source
        )  # an array without a head is one of the arguments, or lies in it
        self.__array_interface__ = {
            "version": 3,
            "data": (data, False),
            "typestr": element,
            "shape": tuple(lengths[:dimensions]),
            "strides": tuple(lengths[dimensions:]),
        }

    def __del__(self) -> None:
        """Count one reference less; the last frees the memory."""
        if self._head:
            self._drop(self._head)


def finished(result: Any, plan: Plan, drop: Drop, source: Any) -> Any:
    """The result as Python's callers expect it; `drop` counts references, `source` are the arguments."""
    if plan is None:
        return result
    if isinstance(plan, str):
        return np.asarray(Held(result, plan, drop, source))
    return tuple(finished(one, part, drop, source) for one, part in zip(result, plan, strict=True))
