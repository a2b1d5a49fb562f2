"""A film of a walking man beside PyVista: cesium_man.gltf, 240 frames, 1280x720, 4 samples a pixel, to mp4.

Both write the same frames of the same walk through the same encoder, while the next frame is made. PyVista
does not move skins, so it is given our points and normals of every frame, made beforehand and not counted.
It draws them with their texture, smooth shading and its own lights, without shadows; ours poses, projects,
and draws shadows, contact darkening and the studio floor too.
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
    """PyVista with the same camera, mesh and texture."""

    def __init__(self, film: el.Film) -> None:
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
        self.plotter.show(auto_close=False)

    def shown(self) -> Iterator[tuple[int, np.ndarray]]:
        """Every frame as RGBA."""
        for number, frame in enumerate(self.frames):
            for mesh, (points, normals) in zip(self.meshes, frame, strict=True):
                mesh.points = points
                mesh.point_data["Normals"] = normals
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


def main(arguments: list[str]) -> None:
    frames = int(arguments[0]) if arguments else FRAMES
    film = film_of(frames)
    peer = Peer(film)
    with tempfile.TemporaryDirectory() as folder:
        ours, theirs = Path(folder) / "ours.mp4", Path(folder) / "theirs.mp4"
        duel = peers.alternate(lambda: film.save(ours), lambda: peer.save(theirs), rounds=3)
        if keep := os.environ.get("EYELINE_KEEP"):
            ours.replace(Path(keep) / "ours.mp4")
            theirs.replace(Path(keep) / "theirs.mp4")
    what = f"cesium_man.gltf, {frames} frames, 1280x720, 4 samples, to mp4"
    row = results.Row(what, duel.ours, duel.theirs, f"PyVista {version('pyvista')}", "s", "<= 1/3")
    if arguments:
        print(row)
    else:
        results.record("film", [row])


if __name__ == "__main__":
    main(sys.argv[1:])
