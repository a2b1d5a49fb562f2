"""Python's and NumPy's objects as LLVM sees them in memory."""

from __future__ import annotations

from llvmlite import ir
from numba.core import cgutils

BYTE = ir.IntType(8).as_pointer()
WORD = ir.IntType(64)
HALF = ir.IntType(32)

# The head of every object ends with its type
HEAD = ir.LiteralStructType([ir.ArrayType(ir.IntType(8), object.__basicsize__ - 8), BYTE])
TYPE = 1

# NumPy's PyArrayObject: head, data, dimensions, *shape, *strides, base, type of elements, flags
ARRAY = ir.LiteralStructType([HEAD, BYTE, HALF, BYTE, BYTE, BYTE, BYTE, HALF])
DATA, DIMENSIONS, SHAPE, STRIDES, ELEMENT, FLAGS = 1, 2, 3, 4, 6, 7


def field(builder: ir.IRBuilder, held: ir.Value, kind: ir.Type, place: int) -> ir.Value:
    """One field of an object."""
    return builder.load(cgutils.gep_inbounds(builder, builder.bitcast(held, kind.as_pointer()), 0, place))
