"""Small arrays of a kernel on its stack, and cache lines asked for before they are needed.

The compiler knows that what stands on the stack is nobody else's memory; with `np.empty` it checks that in
every loop over eight lanes, at more cost than the loop's.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from eyeline.jit.kernels import INTERPRETED, Helper


class Instruction(Helper):
    """A function with code of its own in kernels."""

    def __init__(self, function: Callable[..., Any], lowering: Callable[[], Callable[..., Any]]) -> None:
        super().__init__(function, {})
        self._lowering = lowering

    @cached_property
    def for_kernels(self) -> Callable[..., Any]:
        """What Numba finds under its name in the globals of a kernel."""
        return self._lowering()


def _on_stack(kind: type, count: int) -> npt.NDArray[Any]:
    return np.empty(count, kind)


def _lower_on_stack() -> Callable[..., Any]:
    from numba import types
    from numba.core import cgutils
    from numba.extending import intrinsic

    def lower(context: Any, kind: Any, count: Any) -> Any:
        scalar, length = kind.instance_type, count.literal_value
        array = types.Array(scalar, 1, "C")

        def code(target: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            element = target.get_data_type(scalar)
            memory = cgutils.alloca_once(builder, element, size=length)
            memory.align = 64
            made = target.make_array(array)(target, builder)
            size = target.get_constant(types.intp, target.get_abi_sizeof(element))
            target.populate_array(
                made,
                data=memory,
                shape=cgutils.pack_array(builder, [target.get_constant(types.intp, length)]),
                strides=cgutils.pack_array(builder, [size]),
                itemsize=size,
                meminfo=None,
            )
            return made._getvalue()

        return array(kind, count), code

    return cast(Callable[..., Any], intrinsic(prefer_literal=True)(lower))


def _fetch(address: int) -> None:
    """Uncompiled, memory comes when it comes."""


def _lower_fetch() -> Callable[..., Any]:
    from numba import types
    from numba.core import cgutils
    from numba.extending import intrinsic

    def lower(context: Any, address: Any) -> Any:
        def code(target: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            pointer, number = cgutils.voidptr_t, cgutils.int32_t
            kind = cgutils.ir.FunctionType(cgutils.ir.VoidType(), [pointer, number, number, number])
            function = builder.module.declare_intrinsic("llvm.prefetch", [pointer], kind)
            # To be read, and often, as data
            asked = builder.inttoptr(arguments[0], pointer), number(0), number(3), number(1)
            builder.call(function, asked)
            return target.get_dummy_value()

        return types.void(address), code

    return cast(Callable[..., Any], intrinsic(lower))


fetch = cast(Callable[[int], None], _fetch if INTERPRETED else Instruction(_fetch, _lower_fetch))
on_stack = cast(
    Callable[[type, int], npt.NDArray[Any]],
    _on_stack if INTERPRETED else Instruction(_on_stack, _lower_on_stack),
)
