"""`eyeline doctor --warm` leaves nothing to compile."""

from __future__ import annotations

import subprocess
import sys

LEFT = """
import importlib, pkgutil
import eyeline
from eyeline import jit
from eyeline.render.warming import errands

for module in pkgutil.walk_packages(eyeline.__path__, "eyeline."):
    if not module.name.endswith("__main__"):
        importlib.import_module(module.name)
called = set()
for kernel in jit.KERNELS:
    kernel.load = kernel._load
    kernel._load = lambda form, kernel=kernel: (called.add(kernel), kernel.load(form))[1]
for errand in errands():
    errand()
print(*(f"{one.__module__}.{one.__name__}" for one in jit.KERNELS if one not in called))
"""


def test_every_kernel_is_run_by_an_errand() -> None:
    left = subprocess.run([sys.executable, "-c", LEFT], check=True, capture_output=True, text=True)
    assert left.stdout.split() == []
