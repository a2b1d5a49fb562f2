"""A shaded picture at 1920x1080, against PyVista's `screenshot` on software OpenGL; and where our time goes.

Both rivals have the mesh in their own arrays, turn the camera a little before each picture, so that nothing
is kept from the last, and end with the picture in a numpy array, one sample a pixel. Three pairs: both plain,
both with a floor, shadows and contact darkening, and our default look beside their plain one.
`python -m benchmarks.shading [80k 1.3M]` measures them in turn.
"""

from __future__ import annotations

import math
import os
import sys
import time
from collections.abc import Callable

import numpy as np

from benchmarks import peers, results
from eyeline.geometry.normals import vertex_normals
from eyeline.projection import project
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.shading import Look, shade
from eyeline.shading.frame import Frame, Strip
from eyeline.shading.ground import shaded_backdrop
from eyeline.shading.point_shading import colours_of
from eyeline.shading.stage import stage_of
from eyeline.visibility import METHODS

SIZE = (1920, 1080)
COUNTS = {"80k": 80_000, "1.3M": 1_300_000}
FOV = math.radians(30)
DISTANCE = 5.0
ROUNDS = 5
PLAIN = Look(shadows=False, occlusion=0.0, ground="off")


def place(turn: int) -> tuple[float, float, float]:
    """Where the camera stands for one picture."""
    angle = 0.1 * turn
    return DISTANCE * math.sin(angle), 1.5, DISTANCE * math.cos(angle)


class Ours:
    """Visibility and light; by default with shadows, floor and openness."""

    def __init__(self, scene: Scene, look: Look) -> None:
        self.scene, self.look = scene, look
        self.turn = 0

    def __call__(self) -> np.ndarray:
        """The next picture."""
        self.turn += 1
        projected = project(self.scene, Camera.look_at(place(self.turn), (0, 0, 0), fov=FOV), SIZE)
        return shade(self.scene, projected, [(METHODS["zbuffer"](projected), 0, 0)], self.look)


class PyVista:
    """VTK's smooth shading under its own light; `rich` adds a floor, shadows and SSAO."""

    def __init__(self, points: np.ndarray, faces: np.ndarray, normals: np.ndarray, rich: bool) -> None:
        os.environ["LIBGL_ALWAYS_SOFTWARE"] = "1"
        import pyvista
        from vtkmodules.vtkCommonCore import vtkLogger

        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
        mesh = pyvista.PolyData.from_regular_faces(points, faces)
        mesh.point_data["Normals"] = normals
        mesh.point_data.active_normals_name = "Normals"
        self.plotter = pyvista.Plotter(off_screen=True, window_size=SIZE)
        self.plotter.add_mesh(mesh, color="white", smooth_shading=True)
        if rich:
            floor = pyvista.Plane(
                center=(0, float(points[:, 1].min()), 0), direction=(0, 1, 0), i_size=40, j_size=40
            )
            self.plotter.add_mesh(floor, color="#d5d8db")
            self.plotter.enable_shadows()
            self.plotter.enable_ssao(radius=0.2, kernel_size=32)
        self.plotter.show(auto_close=False)
        self.turn = 0
        self.name = f"PyVista {pyvista.__version__}, software GL"

    def __call__(self) -> np.ndarray:
        """The next picture."""
        self.turn += 1
        self.plotter.camera.position = place(self.turn)
        self.plotter.camera.focal_point = (0, 0, 0)
        self.plotter.camera.view_angle = math.degrees(FOV)
        self.plotter.render()
        return np.asarray(self.plotter.screenshot(return_img=True))


def measure(label: str) -> list[results.Row]:
    """One size: three pairs, each in turn."""
    points, faces = peers.bumpy_sphere(COUNTS[label])
    normals = vertex_normals(points, faces)
    scene = Scene.of(Mesh(points, faces, normals=normals))
    rows = []
    for kind, look, theirs_kind in (
        ("plain", PLAIN, "plain"),
        ("floor, shadows, openness", Look(), "floor, shadows, SSAO"),
        ("floor, shadows, openness", Look(), "plain"),
    ):
        theirs = PyVista(points, faces, normals, theirs_kind != "plain")
        duel = peers.alternate(Ours(scene, look), theirs, ROUNDS)
        theirs.plotter.close()
        what = f"picture 1920x1080, {label} faces, {kind}"
        print(f"{what} / {theirs_kind}: {duel}   cores free {peers.free_cores():.2f}", flush=True)
        against = f"{theirs.name}, {theirs_kind}"
        rows.append(results.Row(what, duel.ours * 1e3, duel.theirs * 1e3, against, bar="<= 1/5"))
    stages(scene, label)
    return rows


def stages(scene: Scene, label: str) -> None:
    """Print the processor time of each stage of one picture, all strips on one thread."""
    spent: dict[str, float] = {}

    def timed(stage: str, run: Callable[[], object]) -> object:
        start = time.process_time()
        answer = run()
        spent[stage] = spent.get(stage, 0.0) + time.process_time() - start
        return answer

    camera = Camera.look_at(place(0), (0, 0, 0), fov=FOV)
    projected = timed("project", lambda: project(scene, camera, SIZE))
    seen = timed("see", lambda: METHODS["zbuffer"](projected))
    frame = Frame(scene, projected, [(seen, 0, 0)], Look())
    stage = timed("light's views, openness", lambda: stage_of(frame))
    for top in range(0, SIZE[1], 32):
        strip = Strip(frame, top, min(SIZE[1], top + 32))
        timed("list points", lambda strip=strip: strip.points)
        timed("shade points", lambda strip=strip: colours_of(frame, stage, strip.points))
        timed("shade floor", lambda strip=strip: shaded_backdrop(strip, stage))
    for name, seconds in spent.items():
        print(f"    {label} {name:24} {seconds * 1e3:8.1f} ms of processor time")


def main(arguments: list[str]) -> None:
    """Measure and record."""
    results.record("shading", [row for label in arguments or COUNTS for row in measure(label)])


if __name__ == "__main__":
    main(sys.argv[1:])
