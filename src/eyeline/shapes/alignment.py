"""How two shapes are laid over each other before they are compared."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from eyeline.errors import GeometryError, OptionError
from eyeline.geometry.arrays import FloatArray
from eyeline.geometry.bounds import Bounds
from eyeline.scene.mesh import Mesh


@dataclass(frozen=True, eq=False)
class Frame:
    """A shape's own place and size: at `centre`, `scale` metres long where the laid-over shape is one."""

    centre: FloatArray  # (3,)
    scale: FloatArray  # (3,) above 0

    def laid(self, points: FloatArray) -> FloatArray:
        """Points (V, 3) from the world to where shapes are compared."""
        laid: FloatArray = (np.asarray(points, np.float64) - self.centre) / self.scale
        return laid

    def placed(self, points: FloatArray) -> FloatArray:
        """Points (V, 3) back in the world."""
        placed: FloatArray = points * self.scale + self.centre
        return placed

    def towards(self, other: Frame, part: float) -> Frame:
        """The frame at a part of the way: it moves straight, and grows by equal factors in equal parts."""
        centre = self.centre + part * (other.centre - self.centre)
        return Frame(centre, self.scale * (other.scale / self.scale) ** part)


def as_they_stand(mesh: Mesh) -> Frame:
    """Where it is."""
    return Frame(np.zeros(3), np.ones(3))


def by_centre(mesh: Mesh) -> Frame:
    """About the centroid of its surface, as large as its points are away from it in the mean."""
    corners = mesh.points.astype(np.float64)[mesh.faces]
    areas = np.sqrt((np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) ** 2).sum(axis=1))
    if not areas.sum() > 0:
        raise GeometryError(f"mesh {mesh.name!r} has no area, so it has no centre to align; a body is needed")
    centre = np.average(corners.mean(axis=1), axis=0, weights=areas)
    spread = np.average(((corners.mean(axis=1) - centre) ** 2).sum(axis=1), weights=areas)
    return Frame(centre, np.full(3, np.sqrt(spread)))


def by_box(mesh: Mesh) -> Frame:
    """Its box is the unit cube, each axis on its own."""
    bounds = Bounds.of(mesh.points)
    extent = bounds.high - bounds.low
    return Frame(bounds.centre, np.where(extent > 0, extent, 1))


ALIGNMENTS: dict[str, Callable[[Mesh], Frame]] = {"none": as_they_stand, "centre": by_centre, "box": by_box}


def frame_of(mesh: Mesh, align: str) -> Frame:
    """The frame of a mesh. Refused: an alignment that is not there."""
    if align not in ALIGNMENTS:
        raise OptionError(f"align is {align!r}; there is {', '.join(ALIGNMENTS)}")
    return ALIGNMENTS[align](mesh)
