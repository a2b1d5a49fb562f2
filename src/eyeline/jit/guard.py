"""Whether a call has the form that machine code was compiled for, told by the machine code itself.

`forms.form_of` asks the same in Python, and takes longer than many a kernel.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba.core import cgutils, types

from eyeline.jit import forms, objects


def add_guard(context: Any, module: ir.Module, name: str, kinds: tuple[Any, ...]) -> ir.Function:
    """A function of a tuple of arguments and `forms.marks`: 1 where they fit, else 0."""
    pointer = objects.BYTE
    function = ir.Function(module, ir.FunctionType(objects.HALF, [pointer, pointer.as_pointer()]), name)
    builder = ir.IRBuilder(function.append_basic_block())
    arguments, marks = function.args
    with builder.goto_block(function.append_basic_block("other")) as _:
        other = builder.block
        builder.ret(objects.HALF(0))
    guard = Guard(context, builder, marks, other)
    guard.members(arguments, kinds)
    builder.ret(objects.HALF(1))
    return function


class Guard:
    """Writes one check after the other; the first that fails leads to `other`."""

    def __init__(self, context: Any, builder: ir.IRBuilder, marks: ir.Value, other: ir.Block) -> None:
        self.builder = builder
        self.python = context.get_python_api(builder)
        self.marks = marks
        self.other = other
        self.told = 0  # marks used

    def require(self, fits: ir.Value) -> None:
        """Go on only where this holds."""
        further = self.builder.append_basic_block()
        self.builder.cbranch(fits, further, self.other)
        self.builder.position_at_end(further)

    def mark(self) -> ir.Value:
        """The next pointer that Python has prepared."""
        self.told += 1
        return self.builder.load(cgutils.gep_inbounds(self.builder, self.marks, self.told - 1))

    def members(self, held: ir.Value, kinds: tuple[Any, ...]) -> None:
        """Require that a tuple has members of these types."""
        size = self.python.tuple_size(held)
        self.require(self.builder.icmp_signed("==", size, size.type(len(kinds))))
        for place, kind in enumerate(kinds):
            self.value(self.python.tuple_getitem(held, place), kind)

    def value(self, held: ir.Value, kind: Any) -> None:
        """Require that an object is of this type."""
        found = objects.field(self.builder, held, objects.HEAD, objects.TYPE)
        fits = self.builder.icmp_unsigned("==", found, self.mark())
        if not isinstance(kind, types.Array | types.BaseTuple):
            fits = self.builder.or_(fits, self.builder.icmp_unsigned("==", found, self.mark()))
        self.require(fits)
        if isinstance(kind, types.BaseTuple):
            self.members(held, tuple(kind.types))
        if isinstance(kind, types.Array):
            self.array(held, kind)

    def array(self, held: ir.Value, kind: Any) -> None:
        """Require that an array has these elements, dimensions and layout."""
        element = objects.field(self.builder, held, objects.ARRAY, objects.ELEMENT)
        self.require(self.builder.icmp_unsigned("==", element, self.mark()))
        dimensions = objects.field(self.builder, held, objects.ARRAY, objects.DIMENSIONS)
        self.require(self.builder.icmp_signed("==", dimensions, objects.HALF(kind.ndim)))
        flags = objects.field(self.builder, held, objects.ARRAY, objects.FLAGS)
        asked, wanted = forms.flags_of(kind.layout, kind.aligned, kind.mutable)
        found = self.builder.and_(flags, objects.HALF(asked))
        self.require(self.builder.icmp_signed("==", found, objects.HALF(wanted)))
