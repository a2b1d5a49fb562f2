"""A method's kernels are compiled once on a machine: the next process links what was kept."""

from __future__ import annotations

import subprocess
import sys

import pytest

from eyeline.visibility import METHODS

PROGRAM = """
import sys
import eyeline as el
from eyeline.projection import project
camera = el.Camera.look_at((3, 2, 4), (0, 0, 0))
for method in sys.argv[1:]:
    el.METHODS[method](project(el.samples.sphere(), camera, (64, 48)))
print("numba" in sys.modules)
"""


@pytest.mark.parametrize("name", METHODS)
def test_the_second_process_needs_no_compiler(name: str) -> None:
    answers = [
        subprocess.run(
            [sys.executable, "-c", PROGRAM, name], capture_output=True, text=True, check=True, timeout=300
        ).stdout.strip()
        for _ in range(2)
    ]
    assert answers[1] == "False"
