"""No kernel reads or writes outside its arrays: every model, every style, with Numba's bounds checked."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

import data

PROGRAM = """
import sys
import eyeline as el

scenes = [make() for make in el.samples.SAMPLES.values()]
scenes += [el.load(path) for path in sys.argv[1:]]
for scene in scenes:
    for time in (0.0, 0.4 * scene.duration):
        el.render(scene, size=(160, 90), time=time, samples=2)
for style in el.STYLES:
    el.render(scenes[-1], size=(97, 61), style=style)
    el.render(scenes[0], size=(1, 1), style=style)
print(len(scenes))
"""


@pytest.mark.slow
def test_kernels_stay_within_their_arrays(tmp_path):
    models = [str(path) for suffix in ("gltf", "glb") for path in data.every(f"gltf/*.{suffix}")]
    environment = os.environ | {"NUMBA_BOUNDSCHECK": "1", "EYELINE_CACHE_DIR": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", PROGRAM, *models],
        capture_output=True, text=True, timeout=900, env=environment, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-2000:]
    assert int(done.stdout) >= len(models) + 1
