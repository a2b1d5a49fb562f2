"""Which face and how deep at 1920x1080, against Mesa's llvmpipe; and the memory that 9 million faces take.

Both rivals have the geometry ready in their own arrays, and both end with ids and depth in numpy arrays.
`python -m benchmarks.zbuffer [5k 80k 1.3M 5M 9M]` measures them in turn.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from benchmarks import peers, results
from eyeline.projection import project
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.visibility import METHODS, Visible

SIZE = (1920, 1080)
COUNTS = {"5k": 5_000, "80k": 80_000, "1.3M": 1_300_000, "5M": 5_000_000, "9M": 9_000_000}
ROUNDS = {"5k": 101, "80k": 51, "1.3M": 15, "5M": 7, "9M": 7}
CAMERA = Camera.look_at((1.2, 0.9, 2.8), (0, 0, 0), near=0.1)

VERTEX = """
#version 330
uniform mat4 clip_from_mesh;
in vec3 point;
void main() {
    vec4 p = clip_from_mesh * vec4(point, 1);
    gl_Position = vec4(p.xy, 2 * p.z - p.w, p.w);
}
"""
FRAGMENT = """
#version 330
out int face;
void main() { face = gl_PrimitiveID; }
"""


class Llvmpipe:
    """Ids and depth of one mesh, drawn by OpenGL on the processor and read back."""

    def __init__(self, points: np.ndarray, faces: np.ndarray, clip_from_mesh: np.ndarray) -> None:
        os.environ["LIBGL_ALWAYS_SOFTWARE"] = "1"
        import moderngl

        self.context = moderngl.create_standalone_context(backend="egl")
        program = self.context.program(vertex_shader=VERTEX, fragment_shader=FRAGMENT)
        program["clip_from_mesh"].write(clip_from_mesh.T.astype(np.float32).tobytes())
        self.vertices = self.context.vertex_array(
            program,
            [(self.context.buffer(points.tobytes()), "3f", "point")],
            self.context.buffer(faces.tobytes()),
        )
        ids = self.context.texture(SIZE, 1, dtype="i4")
        self.target = self.context.framebuffer([ids], self.context.depth_texture(SIZE))
        self.context.enable_only(self.context.DEPTH_TEST)
        self.context.depth_func = ">"
        self.face = np.empty(SIZE[::-1], dtype=np.int32)
        self.depth = np.empty(SIZE[::-1], dtype=np.float32)
        self.name = f"llvmpipe, Mesa {self.context.info['GL_VERSION'].split()[-1]}"

    def cull(self, on: bool) -> None:
        """Drop back faces or keep them."""
        self.context.enable_only(self.context.DEPTH_TEST | (self.context.CULL_FACE if on else 0))

    def __call__(self) -> tuple[np.ndarray, np.ndarray]:
        """(face, depth), rows from the bottom up; background has depth 0."""
        self.target.use()
        self.target.clear(depth=0.0)
        self.vertices.render()
        self.target.read_into(self.face, components=1, dtype="i4")
        self.target.read_into(self.depth, attachment=-1, components=1, dtype="f4")
        return self.face, self.depth

    def close(self) -> None:
        """Give the context back."""
        self.context.release()


def measure(label: str) -> list[results.Row]:
    """Both culls of one size."""
    points, faces = peers.bumpy_sphere(COUNTS[label])
    scene = Scene.of(Mesh(points, faces))
    clip_from_mesh = CAMERA.clip_from_eye(SIZE[0] / SIZE[1]) @ CAMERA.eye_from_world
    theirs = Llvmpipe(points, faces, clip_from_mesh)
    rows = []
    for cull in ("back", "none"):
        theirs.cull(cull == "back")
        agree(seen(scene, cull), *theirs())
        duel = peers.alternate(lambda cull=cull: seen(scene, cull), theirs, rounds=ROUNDS[label])
        what = f"ids and depth, 1920x1080, {label} faces, backs {'dropped' if cull == 'back' else 'kept'}"
        rows.append(results.Row(what, duel.ours * 1e3, duel.theirs * 1e3, theirs.name, bar="<= 1/4"))
        print(f"{what}: {duel}   cores free {peers.free_cores():.2f}", flush=True)
    theirs.close()
    return rows


def seen(scene: Scene, cull: str, size: tuple[int, int] = SIZE) -> Visible:
    """Our answer, from scene to arrays."""
    return METHODS["zbuffer"](project(scene, CAMERA, size, cull))


def agree(ours: Visible, face: np.ndarray, depth: np.ndarray) -> None:
    """Stop if the two do not see the same thing: then there is nothing to compare."""
    depth = (depth[::-1] + 0.0) * (depth[::-1] > 0)
    both = (ours.depth > 0) & (depth > 0)
    # Theirs has 24 bits, some of which go to the map from -1..1
    same = np.abs(ours.depth - depth)[both] < 1e-4
    if (ours.depth > 0).mean() < 0.1 or both.mean() < 0.99 * (ours.depth > 0).mean() or same.mean() < 0.99:
        raise SystemExit(
            f"pictures differ: {both.mean():.4f} of the pixels in both, {same.mean():.4f} of them alike"
        )


# --- memory -----------------------------------------------------------------------------------------------


def memory(label: str) -> results.Row:
    """How much a process grows at most to see that many faces, beside the bytes of their arrays."""
    points, faces = peers.bumpy_sphere(COUNTS[label])
    with tempfile.TemporaryDirectory() as folder:
        np.save(f"{folder}/points.npy", points)
        np.save(f"{folder}/faces.npy", faces)
        command = [sys.executable, "-m", "benchmarks.zbuffer", "--grow", folder]
        grown = int(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    given = points.nbytes + faces.nbytes
    what = f"memory of ids and depth, 1920x1080, {label} faces"
    return results.Row(what, grown / 1e6, given / 1e6, "the arrays given", "MB", "<= 2.5")


def grow(folder: str) -> int:
    """Bytes that this process grows by at most while it loads a mesh and sees it."""
    seen(Scene.of(Mesh(*peers.bumpy_sphere(500))), "none", (64, 64))
    before = status("VmRSS")
    mesh = Mesh(np.load(f"{folder}/points.npy"), np.load(f"{folder}/faces.npy"))
    seen(Scene.of(mesh), "none")
    return status("VmHWM") - before


def status(name: str) -> int:
    """A line of what the system knows of this process, in bytes."""
    lines = dict(line.split(":") for line in Path("/proc/self/status").read_text().splitlines())
    return 1024 * int(lines[name].split()[0])


def main(arguments: list[str]) -> None:
    if arguments[:1] == ["--grow"]:
        print(grow(arguments[1]))
        return
    labels = arguments or list(COUNTS)
    rows = [row for label in labels for row in measure(label)]
    results.record("zbuffer", [*rows, memory("9M")])


if __name__ == "__main__":
    main(sys.argv[1:])
