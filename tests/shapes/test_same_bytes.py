"""Level sets have the same bytes for every number of threads, on plain processors, and uncompiled."""

import os
import subprocess
import sys

import pytest

PROGRAM = """
import hashlib
import numpy as np
from eyeline.samples.shapes import box
from eyeline.samples.solids import ball
from eyeline.shapes.level_set import LevelSet

middle = LevelSet(ball(0.5, 8).mesh(), box((1, 0.7, 1)).mesh(), cells=18).at(0.5)
arrays = middle.points, middle.faces, middle.normals
print(hashlib.sha256(b"".join(array.tobytes() for array in arrays)).hexdigest())
"""


def digest(**settings: str) -> str:
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        env=os.environ | settings,
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout


@pytest.mark.parametrize(
    "settings",
    [
        {"EYELINE_THREADS": "1"},
        {"EYELINE_THREADS": "3"},
        {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""},
        {"NUMBA_DISABLE_JIT": "1"},
    ],
    ids=lambda settings: next(iter(settings)) + next(iter(settings.values())),
)
def test_level_sets_have_the_same_bytes(settings: dict[str, str]) -> None:
    assert digest(**settings) == digest()
