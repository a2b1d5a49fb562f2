"""How the time of each method grows: the same scene with more and more faces, and with more pixels."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from eyeline.comparison.trial import tried
from eyeline.errors import SceneError
from eyeline.projection import project
from eyeline.projection.projected import Projected
from eyeline.scene.camera import Camera
from eyeline.scene.mesh import Mesh
from eyeline.scene.node import Node
from eyeline.scene.scene import Scene
from eyeline.visibility.method import Method

MOST_FACES = 1_500_000
SLOW = 2.0  # seconds: a method that takes longer climbs no higher
SIZES = (1 / 4, 1 / 2, 1, 2)  # of the picture's width and height
MOST_PIXELS = 1 << 24


@dataclass(frozen=True)
class Ladder:
    """Seconds of each method on every rung."""

    unit: str  # "faces" or "pixels"
    rungs: tuple[int, ...]  # rising
    seconds: Mapping[str, tuple[float, ...]]  # method -> as many as it climbed

    def exponent(self, method: str) -> float | None:
        """e of the best fit time ~ rung^e; None on fewer than two rungs."""
        times = self.seconds[method]
        if len(times) < 2:
            return None
        slope, _ = np.polyfit(np.log(self.rungs[: len(times)]), np.log(times), 1)
        return float(slope)

    def data(self) -> dict[str, Any]:
        """As plain data."""
        seconds = {name: list(times) for name, times in self.seconds.items()}
        return {"unit": self.unit, "rungs": list(self.rungs), "seconds": seconds}


def ladder_of_faces(
    scene: Scene, camera: Camera, size: tuple[int, int], cull: str, methods: Sequence[Method]
) -> Ladder:
    """Every face cut in four, again and again: the same picture of more faces."""

    def rungs() -> Iterator[tuple[int, Projected]]:
        finer = scene
        while finer.face_count <= MOST_FACES:
            yield finer.face_count, project(finer, camera, size, cull)
            finer = subdivided(finer)

    if not scene.face_count:
        raise SceneError("the scene has no faces, so there is no ladder of more of them")
    return climbed("faces", rungs(), methods)


def ladder_of_pixels(
    scene: Scene, camera: Camera, size: tuple[int, int], cull: str, methods: Sequence[Method]
) -> Ladder:
    """The same scene in larger and larger pictures."""

    def rungs() -> Iterator[tuple[int, Projected]]:
        for part in SIZES:
            width, height = (max(1, round(side * part)) for side in size)
            if width * height <= MOST_PIXELS:
                yield width * height, project(scene, camera, (width, height), cull)

    return climbed("pixels", rungs(), methods)


def climbed(unit: str, rungs: Iterator[tuple[int, Projected]], methods: Sequence[Method]) -> Ladder:
    """Each method's time on every rung, until it gets slow."""
    climbing, seen = list(methods), []
    seconds: dict[str, list[float]] = {method.name: [] for method in methods}
    for rung, projected in rungs:
        seen.append(rung)
        trials = [tried(method, projected) for method in climbing]
        for trial in trials:
            if not trial.refusal:
                seconds[trial.name].append(trial.again)
        climbing = [trial.method for trial in trials if not trial.refusal and trial.again < SLOW]
        if not climbing:
            break
    return Ladder(unit, tuple(seen), {name: tuple(times) for name, times in seconds.items() if times})


def subdivided(scene: Scene) -> Scene:
    """A posed scene with every face cut in four through the middles of its edges."""
    nodes = [
        Node(scene.paths[surface.node], mesh=cut_in_four(surface.mesh), matrix=surface.world_from_mesh)
        for surface in scene.surfaces
        if surface.visible
    ]
    return replace(Scene.of(*nodes), name=scene.name)


def cut_in_four(mesh: Mesh) -> Mesh:
    """The same surface of four times the faces; corners of neighbours stay shared."""
    a, b, c = mesh.faces.T.astype(np.int64)
    ends = np.sort(np.stack([a, b, b, c, c, a], axis=1).reshape(-1, 2), axis=1)
    pairs, middle = np.unique(ends, axis=0, return_inverse=True)
    ab, bc, ca = (len(mesh.points) + middle.reshape(-1, 3)).T
    points = np.concatenate([mesh.points, mesh.points[pairs].mean(axis=1)])
    faces = np.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], axis=1).reshape(-1, 3)
    material = None if mesh.face_material is None else np.repeat(mesh.face_material, 4)
    return Mesh(points, faces, materials=mesh.materials, face_material=material, name=mesh.name)
