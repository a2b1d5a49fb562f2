"""A film of a walking man beside PyVista: cesium_man.gltf, 240 frames, 1280x720, 4 samples a pixel, to mp4.

Both write the same frames of the same walk through the same encoder, while the next frame is made. PyVista
does not move skins, so it is given our points and normals of every frame, made beforehand and not counted.
Ours has a floor, shadows and contact darkening. PyVista is measured twice: as it comes, with smooth
shading and texture and without any of the three, and as the same film, with its own kinds of all three.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path

import numpy as np

import eyeline as el
from benchmarks import peers, results
from eyeline.geometry import transform
from eyeline.render.encoders import encoder_for
from eyeline.render.encoders.encoder import Job
from eyeline.render.overlap import overlapped

PROJECT = Path(__file__).resolve().parent.parent
DATA = Path(os.environ.get("EYELINE_TEST_DATA", PROJECT.parent / "shared" / "data"))
MODEL = DATA / "gltf" / "cesium_man.gltf"
SIZE, FRAMES, FPS, SAMPLES = (1280, 720), 240, 120.0, 4


def film_of(frames: int) -> el.Film:
    """Our film; the clip lasts 2 s, 240 frames of 1/120 s."""
    return el.film(el.load(MODEL), fps=FPS, end=frames / FPS, size=SIZE, samples=SAMPLES)


class Peer:
    """PyVista with the same camera, mesh and texture; `alike` adds a floor, shadows and contact darkening."""

    def __init__(self, film: el.Film, alike: bool) -> None:
        import pyvista

        camera = film._steady_camera
        assert camera is not None
        poses = [film.scene.at(float(time)).surfaces for time in film.times]
        self.frames = [[placed(surface) for surface in surfaces] for surfaces in poses]
        self.plotter = pyvista.Plotter(off_screen=True, window_size=SIZE)
        self.plotter.enable_anti_aliasing("msaa", multi_samples=SAMPLES)
        self.plotter.set_background("#d5d8db")
        self.meshes = []
        for surface, (points, normals) in zip(poses[0], self.frames[0], strict=True):
            mesh = pyvista.PolyData.from_regular_faces(points, surface.mesh.faces)
            mesh.point_data["Normals"] = normals
            mesh.point_data.active_normals_name = "Normals"
            mesh.active_texture_coordinates = surface.mesh.uv[0] * (1, -1) + (0, 1)
            slot = surface.mesh.materials[0].base_color_texture
            assert slot is not None
            picture = pyvista.Texture(np.ascontiguousarray(slot.texture.pixels[..., :3]))
            self.plotter.add_mesh(mesh, texture=picture, smooth_shading=False)
            actor = list(self.plotter.actors.values())[-1]
            actor.prop.interpolation = "Phong"
            self.meshes.append(mesh)
        eye = camera.world_from_eye
        self.plotter.camera.position = eye[:3, 3]
        self.plotter.camera.focal_point = eye[:3, 3] - eye[:3, 2]
        self.plotter.camera.up = eye[:3, 1]
        self.plotter.camera.view_angle = np.degrees(camera.fov or 0)
        if alike:
            self.add_floor(film)
            self.plotter.enable_shadows()
            self.plotter.enable_ssao(radius=0.1, kernel_size=32)
        self.plotter.show(auto_close=False)

    def add_floor(self, film: el.Film) -> None:
        """A plane under everything, as wide as the picture shows."""
        import pyvista

        bounds = film._bounds
        middle = (bounds.centre[0], bounds.low[1], bounds.centre[2])
        side = 10 * bounds.diagonal
        self.plotter.add_mesh(
            pyvista.Plane(center=middle, direction=(0, 1, 0), i_size=side, j_size=side), color="#d5d8db"
        )

    def shown(self) -> Iterator[tuple[int, np.ndarray]]:
        """Every frame as RGBA."""
        for number, frame in enumerate(self.frames):
            for mesh, (points, normals) in zip(self.meshes, frame, strict=True):
                mesh.points = points
                mesh.point_data["Normals"] = normals
            self.plotter.render()  # or the screenshot would show the frame before
            pixels = self.plotter.screenshot(return_img=True, transparent_background=False)
            yield number, np.dstack([pixels, np.full(pixels.shape[:2], 255, np.uint8)])

    def save(self, path: Path) -> None:
        """The film, through our encoder."""
        with encoder_for(path)(path, Job(SIZE, FPS, len(self.frames))) as sink:
            overlapped(self.shown(), lambda item: sink.write(*item))


def placed(surface: object) -> tuple[np.ndarray, np.ndarray]:
    """World points and normals of a surface, float32."""
    matrix, mesh = surface.world_from_mesh, surface.mesh  # type: ignore[attr-defined]
    return (
        transform.apply(matrix, mesh.points).astype(np.float32),
        transform.apply_to_vectors(matrix, mesh.normals).astype(np.float32),
    )


def measured(film: el.Film, alike: bool, folder: Path) -> results.Row:
    """One comparison: ours and theirs in turn, after a first frame of each."""
    peer, ours, theirs = Peer(film, alike), folder / "ours.mp4", folder / "theirs.mp4"
    film[0].pixels, next(peer.shown())
    times = peers.seconds(lambda: film.save(ours)), peers.seconds(lambda: peer.save(theirs))
    kind = "floor, shadows and SSAO" if alike else "no shadows"
    what = f"cesium_man.gltf, {len(film)} frames, 1280x720, 4 samples, mp4"
    against = f"PyVista {version('pyvista')}, {kind}"
    return results.Row(what, times[0], times[1], against, "s", "<= 1/3")


def main(arguments: list[str]) -> None:
    film = film_of(int(arguments[0]) if arguments else FRAMES)
    with tempfile.TemporaryDirectory() as folder:
        rows = [measured(film, alike, Path(folder)) for alike in (False, True)]
    if not arguments:
        results.record("film", rows)
    for row in rows if arguments else ():
        print(row)


if __name__ == "__main__":
    main(sys.argv[1:])
