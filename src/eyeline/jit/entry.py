"""The way from Python into a kernel, compiled along with it.

Numba's own way in needs Numba to be there when it is called, checks what `forms` has checked, and takes as
long to compile as the kernel. This one reads each array's address, shape and strides where NumPy keeps them,
releases the interpreter's lock, and calls. What it and the kernel need of Numba's memory manager stands in
the same object file, so that the file can be linked in a process that has not imported Numba.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.lowering import Lower
from numba.core.typed_passes import NativeLowering
from numba.np.arrayobj import populate_array

from eyeline.jit import objects
from eyeline.jit.guard import add_guard
from eyeline.jit.memory import add_memory
from eyeline.jit.objects import BYTE, WORD


class Lowering(NativeLowering):  # type: ignore[misc]
    """Numba's pass from typed code to LLVM's, with our way in."""

    @property
    def lowering_class(self) -> type[Lower]:
        """What lowers one function."""
        return LowerWithEntry


class LowerWithEntry(Lower):  # type: ignore[misc]
    """Lowers a function and adds `entry` where Numba would add its wrapper."""

    def create_cpython_wrapper(self, release_gil: bool = False) -> None:
        """Add the way in, and the memory manager."""
        module = self.context.create_module("entry")
        add_entry(self.context, module, self.fndesc)
        add_memory(module)
        self.library.add_ir_module(module)


def entry_name(described: Any) -> str:
    """The symbol of the way into a function that Numba describes so."""
    return f"entry.{described.mangled_name}"


def add_entry(context: Any, module: ir.Module, described: Any) -> None:
    """A function of C's calling convention that takes `forms.marks` and a tuple of arguments.

    It returns the result, NULL where it has raised, and NotImplemented where the arguments have another form.
    Without marks it trusts them to have this one.
    """
    name, kinds = entry_name(described), described.argtypes
    entry = ir.Function(module, ir.FunctionType(BYTE, [BYTE.as_pointer(), BYTE]), name)
    marks, arguments = entry.args
    builder = ir.IRBuilder(entry.append_basic_block())
    python = context.get_python_api(builder)
    guard = add_guard(context, module, f"guard.{name}", kinds)
    with builder.if_then(cgutils.is_not_null(builder, marks)):
        fits = builder.call(guard, [arguments, marks])
        with builder.if_then(cgutils.is_null(builder, fits), likely=False):
            refusal = python.get_c_object("_Py_NotImplementedStruct")
            python.incref(refusal)
            builder.ret(refusal)

    # The arguments, as the kernel takes them
    values = [
        unboxed(context, builder, kind, python.tuple_getitem(arguments, place))
        for place, kind in enumerate(kinds)
    ]
    with builder.if_then(cgutils.is_not_null(builder, python.err_occurred()), likely=False):
        builder.ret(python.get_null_object())

    # The kernel, without the lock
    shape = context.call_conv.get_function_type(described.restype, described.argtypes)
    kernel = ir.Function(module, shape, described.llvm_func_name)
    thread = python.save_thread()
    status, result = context.call_conv.call_function(
        builder, kernel, described.restype, described.argtypes, values, attrs=("noinline",)
    )
    python.restore_thread(thread)
    with builder.if_then(status.is_error, likely=False):
        reason = "failed: no memory, or an index outside of its array"
        python.err_set_string("PyExc_RuntimeError", f"kernel {described.qualname} {reason}")
        builder.ret(python.get_null_object())
    builder.ret(boxed(context, builder, described.restype, result))


def unboxed(context: Any, builder: ir.IRBuilder, kind: Any, value: ir.Value) -> ir.Value:
    """A Python object as a kernel takes it."""
    python = context.get_python_api(builder)
    if isinstance(kind, types.Array):
        return array_at(context, builder, kind, value)
    if isinstance(kind, types.BaseTuple):
        parts = [
            unboxed(context, builder, one, python.tuple_getitem(value, place))
            for place, one in enumerate(kind.types)
        ]
        return context.make_tuple(builder, kind, parts)
    if isinstance(kind, types.Boolean):
        return cgutils.is_not_null(builder, python.object_istrue(value))
    native = context.get_value_type(kind)
    if isinstance(kind, types.Integer) and kind.signed:
        number = python.long_as_longlong(value)
        return builder.trunc(number, native) if kind.bitwidth < 64 else number
    if isinstance(kind, types.Float):
        number = python.float_as_double(value)
        return builder.fptrunc(number, native) if kind.bitwidth < 64 else number
    raise TypeError(f"a kernel takes no {kind}")


def array_at(context: Any, builder: ir.IRBuilder, kind: Any, value: ir.Value) -> ir.Value:
    """NumPy's array object as Numba's array; nobody owns it for as long as the call lasts."""

    def words(place: int) -> list[ir.Value]:
        first = builder.bitcast(objects.field(builder, value, objects.ARRAY, place), WORD.as_pointer())
        return [builder.load(cgutils.gep_inbounds(builder, first, axis)) for axis in range(kind.ndim)]

    array = context.make_array(kind)(context, builder)
    data = objects.field(builder, value, objects.ARRAY, objects.DATA)
    populate_array(
        array,
        data=builder.bitcast(data, array.data.type),
        shape=words(objects.SHAPE),
        strides=words(objects.STRIDES),
        itemsize=context.get_constant(types.intp, context.get_abi_sizeof(context.get_data_type(kind.dtype))),
        meminfo=None,
    )
    return array._getvalue()


def boxed(context: Any, builder: ir.IRBuilder, kind: Any, result: ir.Value) -> ir.Value:
    """What a kernel returns, as a Python object; of an array what `results.Held` needs to know."""
    python = context.get_python_api(builder)
    if isinstance(kind, types.NoneType):
        return python.make_none()
    if isinstance(kind, types.Boolean):
        return python.bool_from_bool(result)
    if isinstance(kind, types.Integer) and kind.signed:
        return python.long_from_longlong(builder.sext(result, WORD) if kind.bitwidth < 64 else result)
    if isinstance(kind, types.Float):
        wide = builder.fpext(result, ir.DoubleType()) if kind.bitwidth < 64 else result
        return python.float_from_double(wide)
    if isinstance(kind, types.BaseTuple):
        parts = cgutils.unpack_tuple(builder, result, len(kind))
        return packed(
            python, [boxed(context, builder, one, part) for one, part in zip(kind, parts, strict=True)]
        )
    if isinstance(kind, types.Array):
        array = context.make_array(kind)(context, builder, result)
        numbers = [builder.ptrtoint(array.meminfo, WORD), builder.ptrtoint(array.data, WORD)]
        numbers += cgutils.unpack_tuple(builder, array.shape, kind.ndim)
        numbers += cgutils.unpack_tuple(builder, array.strides, kind.ndim)
        return packed(python, [python.long_from_longlong(number) for number in numbers])
    raise TypeError(f"a kernel returns no {kind}")


def packed(python: Any, members: list[ir.Value]) -> ir.Value:
    """A tuple that owns these objects."""
    made = python.tuple_new(len(members))
    for place, one in enumerate(members):
        python.tuple_setitem(made, place, one)
    return made
