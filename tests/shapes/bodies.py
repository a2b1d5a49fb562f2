"""Bodies whose shapes and distances are known."""

from __future__ import annotations

import numpy as np

import eyeline as el
from eyeline.geometry.arrays import FloatArray
from eyeline.samples.shapes import box, lathe
from eyeline.samples.solids import ball


def sphere(radius: float, centre: tuple[float, float, float] = (0, 0, 0), rings: int = 48) -> el.Mesh:
    return ball(radius, rings).moved(centre).mesh()


def block(size: tuple[float, float, float], centre: tuple[float, float, float] = (0, 0, 0)) -> el.Mesh:
    return box(size).moved(centre).mesh()


def bar(length: float = 2.0, rings: int = 40) -> el.Mesh:
    """A round bar from the origin up y."""
    radius = np.r_[0, np.full(rings, 0.1), 0]
    height = np.r_[0, np.linspace(0, length, rings), length]
    return lathe(np.stack([radius, height], axis=1), 16).mesh()


def moved(mesh: el.Mesh, points: FloatArray) -> el.Mesh:
    return el.Mesh(points, mesh.faces, mesh.normals)


def turned(points: FloatArray, angle: FloatArray | float) -> FloatArray:
    """Points turned about z, each by its angle."""
    x, y, z = points.astype(np.float64).T
    return np.stack([np.cos(angle) * x - np.sin(angle) * y, np.sin(angle) * x + np.cos(angle) * y, z], axis=1)


def edge_lengths(points: FloatArray, faces: FloatArray) -> FloatArray:
    corners = points.astype(np.float64)[faces]
    return np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
