"""The part of Numba's memory manager that kernels use, to be compiled along with each of them.

A kernel may make arrays for itself. Numba counts their references in a head before the data, a `MemInfo`;
arrays from Python have none.
"""

from __future__ import annotations

from llvmlite import ir
from numba.core import cgutils
from numba.core.runtime.nrtdynmod import incref_decref_ty, meminfo_data_ty

BYTE = ir.IntType(8).as_pointer()
WORD = ir.IntType(64)

# References, destructor, its argument, data, size, allocator
HEAD = ir.LiteralStructType([WORD, BYTE, BYTE, BYTE, WORD, BYTE])
HEAD_BYTES = 48
REFERENCES, DATA, SIZE = 0, 3, 4


def add_memory(module: ir.Module) -> None:
    """Define what Numba's code calls by name."""
    _define_allocation(module)
    _define_data(module)
    _define_count(module, "NRT_incref", "add")
    _define_count(module, "NRT_decref", "sub")


def _function(module: ir.Module, name: str, shape: ir.FunctionType) -> tuple[ir.Function, ir.IRBuilder]:
    function = cgutils.get_or_insert_function(module, shape, name)
    # Weak: linked although only libraries of Numba call it that are linked later, and once among all kernels
    function.linkage = "weak_odr"
    # Numba's optimiser looks for calls by these names
    function.attributes.add("noinline")
    return function, ir.IRBuilder(function.append_basic_block())


def _field(builder: ir.IRBuilder, head: ir.Value, field: int) -> ir.Value:
    return cgutils.gep_inbounds(builder, builder.bitcast(head, HEAD.as_pointer()), 0, field)


def _define_allocation(module: ir.Module) -> None:
    shape = ir.FunctionType(BYTE, [WORD, ir.IntType(32)])
    function, builder = _function(module, "NRT_MemInfo_alloc_aligned", shape)
    size, alignment = function.args[0], builder.zext(function.args[1], WORD)
    allocate = cgutils.get_or_insert_function(module, ir.FunctionType(BYTE, [WORD]), "malloc")
    head = builder.call(allocate, [builder.add(builder.add(size, alignment), WORD(HEAD_BYTES))])
    with builder.if_then(cgutils.is_null(builder, head), likely=False):
        builder.ret(head)

    # The first multiple of the alignment, a power of two, after the head
    least = builder.add(builder.ptrtoint(head, WORD), builder.add(WORD(HEAD_BYTES - 1), alignment))
    data = builder.inttoptr(builder.and_(least, builder.neg(alignment)), BYTE)
    builder.store(HEAD(None), builder.bitcast(head, HEAD.as_pointer()))
    builder.store(WORD(1), _field(builder, head, REFERENCES))
    builder.store(data, _field(builder, head, DATA))
    builder.store(size, _field(builder, head, SIZE))
    builder.ret(head)


def _define_data(module: ir.Module) -> None:
    function, builder = _function(module, "NRT_MemInfo_data_fast", meminfo_data_ty)
    builder.ret(builder.load(_field(builder, function.args[0], DATA)))


def _define_count(module: ir.Module, name: str, change: str) -> None:
    function, builder = _function(module, name, incref_decref_ty)
    head = function.args[0]
    with builder.if_then(cgutils.is_null(builder, head)):
        builder.ret_void()
    before = builder.atomic_rmw(change, _field(builder, head, REFERENCES), WORD(1), ordering="acq_rel")
    if change == "sub":
        release = cgutils.get_or_insert_function(module, ir.FunctionType(ir.VoidType(), [BYTE]), "free")
        with builder.if_then(builder.icmp_unsigned("==", before, WORD(1)), likely=False):
            builder.call(release, [head])
    builder.ret_void()
