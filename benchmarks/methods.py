"""Every method against our own depth buffer, in turn in one run: a million faces at 1920x1080.

Roberts is given a hundred thousand: it answers lines. The time of a method that keeps a tree is told with the
tree kept, and once more with it built.
"""

from __future__ import annotations

from benchmarks import peers, results
from benchmarks.zbuffer import CAMERA, SIZE
from eyeline.projection import project
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS

COUNT = {"roberts": 100_000}
USUAL = 1_000_000
BARS = {"octree": 2, "scanline": 5, "raycast": 3, "warnock": 10, "painter": 10, "roberts": 10}


def measure(name: str, bar: int) -> results.Row:
    """One method, from projected faces to its answer, in turn with the depth buffer."""
    count = COUNT.get(name, USUAL)
    scene = Scene.of(Mesh(*peers.bumpy_sphere(count)))
    projected = project(scene, CAMERA, SIZE)
    duel = peers.alternate(lambda: METHODS[name](projected), lambda: METHODS["zbuffer"](projected), rounds=9)
    what = f"{name}, 1920x1080, {count / 1e6:g}M faces"
    print(f"{what}: {duel}   cores free {peers.free_cores():.2f}", flush=True)
    return results.Row(what, duel.ours * 1e3, duel.theirs * 1e3, "our zbuffer", bar=f"<= {bar}")


def main(names: list[str]) -> None:
    results.record(
        "methods", [measure(name, bar) for name, bar in BARS.items() if name in (names or METHODS)]
    )


if __name__ == "__main__":
    import sys

    main(sys.argv[1:])
