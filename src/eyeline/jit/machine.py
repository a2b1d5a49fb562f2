"""Machine code from a file, made ready to be called: needs LLVM's linker, not Numba."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from functools import cache, partial
from typing import Any

import llvmlite.binding as llvm

from eyeline.jit.kept import MachineCode
from eyeline.jit.results import Plan, finished

# Python's objects in and out: the code itself releases the interpreter's lock (jit/entry.py)
_ENTRY = ctypes.PYFUNCTYPE(ctypes.py_object, ctypes.c_void_p, ctypes.py_object)
_DROP = ctypes.CFUNCTYPE(None, ctypes.c_void_p)

Entry = Callable[[tuple[Any, ...]], Any]


class Loaded:
    """Machine code for one form of arguments, given in a tuple.

    `guarded` returns NotImplemented where arguments have another form, `trusting` must not be given them.
    """

    def __init__(self, machine: MachineCode, marks: list[int]) -> None:
        engine = _engine()
        engine.add_object_file(llvm.ObjectFileRef.from_data(machine.code))
        engine.finalize_object()
        entry = _ENTRY(engine.get_function_address(machine.symbol))
        self._marks = (ctypes.c_void_p * len(marks))(*marks)
        self.guarded: Entry = partial(entry, ctypes.addressof(self._marks))
        self.trusting: Entry = partial(entry, None)
        if machine.plan is not None:
            drop = _DROP(engine.get_function_address("NRT_decref"))
            self.guarded = partial(_finish, self.guarded, machine.plan, drop)
            self.trusting = partial(_finish, self.trusting, machine.plan, drop)


def _finish(entry: Entry, plan: Plan, drop: Callable[[int], None], arguments: tuple[Any, ...]) -> Any:
    result = entry(arguments)
    return result if result is NotImplemented else finished(result, plan, drop, arguments)


@cache
def processor() -> tuple[str, str, str]:
    """What machine code is compiled for: the system, the processor's name and its features."""
    features = llvm.get_host_cpu_features()
    return llvm.get_process_triple(), llvm.get_host_cpu_name(), features.flatten()


@cache
def _engine() -> llvm.ExecutionEngine:
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    target = llvm.Target.from_triple(llvm.get_process_triple())
    return llvm.create_mcjit_compiler(llvm.parse_assembly(""), target.create_target_machine())
