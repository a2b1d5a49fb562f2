"""How far one surface is from another, measured at the vertices and middles of faces of both."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import FloatArray, read_only
from eyeline.geometry.bvh import bvh_of
from eyeline.geometry.nearest import nearest
from eyeline.scene.mesh import Mesh


@dataclass(frozen=True)
class Deviation:
    """Distances from a made surface to the one it stands for, metres."""

    mean: float  # from the made surface
    largest: float  # from the made surface
    missed: float  # the largest from the other surface to the made one: what was lost


def deviation(made: Mesh, wanted: Mesh) -> Deviation:
    """Measured at vertices and middles of faces; faces buried in a body count as missed."""
    there, back = away(made, wanted), away(wanted, made)
    return Deviation(float(there.mean()), float(there.max()), float(back.max()))


def away(one: Mesh, other: Mesh) -> FloatArray:
    """How far each vertex and each middle of a face of one mesh is from another."""
    places = np.concatenate([one.points[np.unique(one.faces)], one.points[one.faces].mean(axis=1)])
    return nearest(bvh_of(read_only(other.points), other.faces), places).distance
