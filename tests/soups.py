"""Faces made by chance, of the kinds that go wrong: slivers, ties, shared edges, near plane, guard band."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from eyeline.geometry.fixedpoint import GUARD
from eyeline.projection.projected import CLOCKWISE, COUNTER_CLOCKWISE, Projected
from eyeline.scene.camera import Camera
from eyeline.scene.material import Material
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene

BOTH = COUNTER_CLOCKWISE | CLOCKWISE
SNAPPED = ("tiny", "small", "ties", "slivers", "large", "huge", "flat", "grid", "mixed")


def snapped(kind: str, seed: int, size: tuple[int, int], count: int = 80) -> Projected:
    """A soup of one of the kinds SNAPPED, already on the picture's grid; sides and pieces by chance."""
    random = np.random.default_rng(seed)
    if kind == "grid":
        return grid(random, size)
    if kind == "mixed":
        reach = 256 * 10 ** random.uniform(-1.5, 2.5, (count, 1, 1))
    else:
        reach = (
            256
            * {"tiny": 0.7, "small": 4, "ties": 6, "slivers": 30, "large": 40, "huge": 1e4, "flat": 12}[kind]
        )
    middle = random.uniform(-256 * 4, 256 * (np.array(size) + 4), (count, 1, 2))
    xy = middle + random.uniform(-1, 1, (count, 3, 2)) * reach
    if kind == "ties":
        xy = np.round(xy / 128) * 128
    if kind == "slivers":
        xy[:, 2] = xy[:, 1] + random.integers(-3, 4, (count, 2))
    depth = random.uniform(-0.05, 1, (count, 1)) + random.uniform(-0.05, 0.05, (count, 3))
    if kind in ("flat", "ties"):
        depth = np.round(depth[:, :1] * 4) / 4 * np.ones(3)
    sides = random.integers(0, 4, count) if seed % 3 else np.array([1 + seed % 2 * 2])
    xy = np.clip(np.round(xy), -GUARD, GUARD).reshape(-1, 2)
    return picture(xy, depth.reshape(-1), np.arange(3 * count).reshape(-1, 3), sides, size, seed % 5)


def grid(random: np.random.Generator, size: tuple[int, int], cells: int = 9) -> Projected:
    """A net of faces that share their edges, its inner corners shaken, some on pixels' centres."""
    column, row = np.meshgrid(np.arange(cells + 1), np.arange(cells + 1))
    spread = np.stack([column, row], axis=-1).reshape(-1, 2) / cells * (np.array(size) + 4) * 256 - 512
    inner = ((column % cells > 0) & (row % cells > 0)).reshape(-1, 1)
    xy = np.round(spread + inner * random.uniform(-256, 256, spread.shape))
    xy = np.where(random.random((len(xy), 1)) < 0.4, np.round(xy / 256) * 256 + 128, xy)
    at = (row * (cells + 1) + column)[:-1, :-1].reshape(-1)
    two = [np.stack([at, at + 1, at + cells + 2], 1), np.stack([at, at + cells + 2, at + cells + 1], 1)]
    return picture(xy, random.uniform(0.2, 1, len(xy)), np.concatenate(two), np.array([BOTH]), size, 0)


def picture(xy, depth, faces, sides, size: tuple[int, int], pieces: int) -> Projected:
    """Snapped faces as a camera would give them; the last `pieces` are cut from the first."""
    whole = len(faces) - pieces
    return Projected(
        xy=np.ascontiguousarray(xy, np.int32),
        depth=np.ascontiguousarray(depth, np.float32),
        faces=np.ascontiguousarray(faces, np.int32),
        sides=np.ascontiguousarray(sides, np.uint8),
        face_count=whole,
        piece_source=np.arange(pieces, dtype=np.int32),
        first_faces=np.array([0, whole]),
        surfaces=(),
        camera=Camera(fov=1.0, near=0.1),
        width=size[0],
        height=size[1],
    )


def around_the_eye(seed: int, count: int = 60) -> tuple[Scene, Camera]:
    """Faces of all sizes before, behind and through the eye, in two meshes, one of them single-sided."""
    random = np.random.default_rng(seed)
    sizes = 10 ** random.uniform(-1, 1.5, (count, 1, 1))
    points = random.uniform(-3, 3, (count, 1, 3)) + random.uniform(-1, 1, (count, 3, 3)) * sizes
    faces = np.arange(3 * (count // 2)).reshape(-1, 3)
    half = count // 2
    meshes = [
        Mesh(points[:half].reshape(-1, 3), faces),
        Mesh(points[half : 2 * half].reshape(-1, 3), faces, material=Material(double_sided=False)),
    ]
    far = None if seed % 2 else 20.0
    lens = {"height": 4.0, "near": -1.0} if seed % 7 == 6 else {"fov": math.radians(70), "near": 0.2}
    return Scene.of(*meshes), Camera.look_at((0.1, 0.2, 0.3), (1, 0.5, -2), far=far or 30.0, **lens)


def ball(rings: int = 12) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int_]]:
    """A closed ball of radius 1: points (V, 3), faces (F, 3), fronts outside."""
    polar, turn = np.meshgrid(
        np.linspace(0, np.pi, rings + 1)[1:-1], np.linspace(0, 2 * np.pi, 2 * rings + 1)[:-1]
    )
    rows = np.stack([np.sin(polar) * np.cos(turn), np.cos(polar), -np.sin(polar) * np.sin(turn)], axis=-1)
    points = np.concatenate([rows.transpose(1, 0, 2).reshape(-1, 3), [(0, 1, 0), (0, -1, 0)]])
    around, wrap, bottom = (
        np.arange(2 * rings),
        (np.arange(2 * rings) + 1) % (2 * rings),
        2 * rings * (rings - 2),
    )
    faces = [np.stack([np.full_like(around, len(points) - 2), around, wrap], 1)]
    for ring in range(rings - 2):
        low, high = 2 * rings * ring, 2 * rings * (ring + 1)
        faces.append(np.stack([low + around, high + around, high + wrap], 1))
        faces.append(np.stack([low + around, high + wrap, low + wrap], 1))
    faces.append(np.stack([np.full_like(around, len(points) - 1), bottom + wrap, bottom + around], 1))
    return points, np.concatenate(faces)
