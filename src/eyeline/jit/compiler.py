"""Numba, asked for the machine code of one kernel and one form of arguments."""

from __future__ import annotations

import ctypes
from typing import Any

import numba
import numpy as np
from numba.core import types
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_machinery import PassManager, register_pass
from numba.core.typed_passes import NativeLowering
from numba.np.numpy_support import as_dtype

from eyeline.jit.entry import Lowering, entry_name
from eyeline.jit.forms import Form
from eyeline.jit.kept import MachineCode
from eyeline.jit.results import Plan


class WithEntry(CompilerBase):  # type: ignore[misc]
    """Numba's passes, the last of them with our way into the function."""

    def define_pipelines(self) -> list[PassManager]:
        """One, without a way back to Python's objects."""
        passes = DefaultPassBuilder.define_nopython_pipeline(self.state)
        passes.passes = [
            (_LOWERING, name) if one is NativeLowering else (one, name) for one, name in passes.passes
        ]
        passes.finalize()
        return [passes]


_LOWERING = register_pass(mutates_CFG=True, analysis_only=False)(Lowering)


def compiled(function: Any, options: dict[str, object], form: Form) -> tuple[MachineCode, bool]:
    """Compile `function` for arguments of this form; its globals hold Numba's functions, not ours.

    Gives also whether the code can be linked where Numba has not been imported.
    """
    dispatcher = numba.njit(pipeline_class=WithEntry, **options)(function)
    signature = tuple(numba_type(one) for one in form)
    dispatcher.compile(signature)
    result = dispatcher.overloads[signature]
    library = result.library
    plan = plan_of(result.fndesc.restype)
    machine = MachineCode(entry_name(result.fndesc), plan, library._get_compiled_object())
    return machine, _stands_alone(library)


def numba_type(form: Any) -> types.Type:
    """What Numba calls the type of arguments of a form."""
    if isinstance(form, type) and not issubclass(form, bool | int | float | np.number):
        raise TypeError(f"a kernel takes no {form.__qualname__}")
    if isinstance(form, type):
        return types.boolean if form is bool else numba.from_dtype(np.dtype(form))
    if isinstance(form[0], type):
        parts = [numba_type(one) for one in form[1]]
        return types.BaseTuple.from_types(parts, form[0])
    dtype, dimensions, order, aligned, writeable = form
    return types.Array(numba.from_dtype(dtype), dimensions, order, readonly=not writeable, aligned=aligned)


def plan_of(kind: Any) -> Plan:
    """How `results.finished` makes what a kernel returns."""
    if isinstance(kind, types.Array):
        return str(as_dtype(kind.dtype).str)
    if isinstance(kind, types.BaseTuple):
        return [plan_of(one) for one in kind]
    return None


def _stands_alone(library: Any) -> bool:
    """Whether everything it calls is in Python or the C library."""
    module = library._final_module
    named = [one.name for one in (*module.functions, *module.global_variables) if one.is_declaration]
    outside = [name for name in named if not name.startswith("llvm.")]
    return not library.has_dynamic_globals and all(hasattr(ctypes.pythonapi, name) for name in outside)
