"""An in-between of two meshes of 20,000 faces: by level sets at 128 points a side, and as rigid as possible.

There is no peer that offers either; what is measured is the first in-between, for which both shapes are made
ready, and the ones after it.
`python -m benchmarks.shapes`
"""

from __future__ import annotations

import statistics
import time

import numpy as np

import eyeline as el
from eyeline.geometry import quaternion, transform
from eyeline.samples.shapes import lathe
from eyeline.samples.solids import ball

RUNS = 7


def ring() -> el.Mesh:
    """19,800 faces."""
    turn = np.linspace(0, 2 * np.pi, 100)
    profile = np.stack([0.35 + 0.15 * np.cos(turn), 0.15 * np.sin(turn)], axis=1)
    profile[-1] = profile[0]
    return lathe(profile, 100).mesh()


def sphere() -> el.Mesh:
    """19,880 faces."""
    return ball(0.45, 71).mesh()


def turned(mesh: el.Mesh) -> el.Mesh:
    place = transform.compose((1, 2, 3), quaternion.from_axis_angle((1, 2, 3), 2.5), (1, 2, 1))
    return el.Mesh(transform.apply(place, mesh.points), mesh.faces, mesh.normals)


def measure(start: el.Mesh, end: el.Mesh, way: str) -> tuple[float, float]:
    """Median milliseconds of the first in-between and of one more."""
    first, later = [], []
    for run in range(RUNS + 1):
        begin = time.perf_counter()
        between = el.inbetween(start, end, way=way)
        between.at(0.5)
        ready = time.perf_counter()
        between.at(0.25)
        if run:  # the first run compiles
            first.append(ready - begin)
            later.append(time.perf_counter() - ready)
    return 1e3 * statistics.median(first), 1e3 * statistics.median(later)


def main() -> None:
    start, end = ring(), sphere()
    print(f"faces: {len(start.faces):,} and {len(end.faces):,}; median of {RUNS}")
    for way, pair in (("level_set", (start, end)), ("rigid", (end, turned(end)))):
        first, later = measure(*pair, way)
        print(f"{way:>9}: first in-between {first:6.0f} ms, each after it {later:5.0f} ms")
    between = el.inbetween(start, end, way="level_set")
    for name, error in zip(("start", "end"), between.error, strict=True):
        cells = [value / between.cell for value in (error.mean, error.largest, error.missed)]
        said = "mean {:.3f}, largest {:.3f}, missed {:.3f}".format(*cells)
        print(f"{name:>9}: {said} cells of {between.cell:.4f} m")


if __name__ == "__main__":
    main()
