"""Every method against our own depth buffer, in turn in one run: a million faces at 1920x1080.

Roberts is given a hundred thousand: it answers lines. Trees are kept with their meshes, as in a film.
`python -m benchmarks.methods [name ...]`; without names also how each grows with faces and with pixels.
"""

from __future__ import annotations

import sys

from benchmarks import peers, results
from benchmarks.zbuffer import CAMERA, SIZE
from eyeline import samples
from eyeline.comparison import compare
from eyeline.projection import project
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS

COUNT = {"roberts": 100_000}
USUAL = 1_000_000
BARS = {"octree": 2, "scanline": 5, "raycast": 3, "warnock": 10, "painter": 10, "roberts": 10}


def measure(name: str, bar: int, cull: str) -> results.Row:
    """One method, from projected faces to its answer, in turn with the depth buffer."""
    count = COUNT.get(name, USUAL)
    scene = Scene.of(Mesh(*peers.bumpy_sphere(count)))
    projected = project(scene, CAMERA, SIZE, cull)
    duel = peers.alternate(lambda: METHODS[name](projected), lambda: METHODS["zbuffer"](projected), rounds=9)
    backs = "dropped" if cull == "back" else "kept"
    what = f"{name}, 1920x1080, {count / 1e6:g}M faces, backs {backs}"
    print(f"{what}: {duel}   cores free {peers.free_cores():.2f}", flush=True)
    return results.Row(what, duel.ours * 1e3, duel.theirs * 1e3, "our zbuffer", bar=f"<= {bar}")


def growth() -> list[results.Row]:
    """How the time of each method grows with faces and with pixels, as the exponent of the best fit."""
    found = compare(samples.teapot(), size=(1280, 720), ladder=True)
    return [
        results.Row(f"{name}, exponent of {ladder.unit}", exponent, unit="")
        for ladder in found.ladders
        for name in ladder.seconds
        if (exponent := ladder.exponent(name)) is not None
    ]


def main(names: list[str]) -> None:
    chosen = {name: bar for name, bar in BARS.items() if not names or name in names}
    rows = [measure(name, bar, cull) for name, bar in chosen.items() for cull in ("back", "none")]
    results.record("methods", rows)
    if not names:
        results.record("growth", growth())


if __name__ == "__main__":
    main(sys.argv[1:])
