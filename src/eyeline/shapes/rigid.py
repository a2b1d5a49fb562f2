"""As rigid as possible: each face turns and stretches its own way, the mesh follows them best."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from eyeline.cached import cached_property
from eyeline.geometry.arrays import FloatArray
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.shapes.parts import parts_of
from eyeline.shapes.poisson import Poisson
from eyeline.shapes.same_faces import Pair
from eyeline.shapes.turns import Turns
from eyeline.shapes.whole import mesh_of


@dataclass(frozen=True, eq=False)
class Rigid:
    """Turns stay turns: a limb that swings keeps its length. [Alexa00, Xu05]

    The map that takes a face from the start to the end is a rotation after a stretch; on the way the
    rotation turns about its axis, evenly, and the stretch grows straight. The points are those that minimise

        sum over faces of  area * |gradient of the points - rotation(t) stretch(t)|^2 ,

    a sparse linear system whose matrix is factored once for all times; the centroid of each part that hangs
    together goes straight. Faces that are neighbours turn the same way round, also by more than half a turn.
    start, end: meshes of the same faces, or scenes whose surfaces make such meshes.
    """

    start: Mesh | Scene
    end: Mesh | Scene

    def __post_init__(self) -> None:
        """Refuse shapes that do not answer each other."""
        self._pair  # noqa: B018  the check is in its making

    def at(self, part: float) -> Mesh:
        """The mesh at a part of the way: 0 is the start, 1 the end; others turn and stretch further."""
        return self._pair.mesh(self.sample([part])[0], part)

    def sample(self, parts: npt.ArrayLike) -> FloatArray:
        """(T, V, 3) the points at parts (T,) of the way, metres."""
        index = self._pair.spots[1]
        return np.stack([self._points(part)[index] for part in parts_of(parts)])

    def _points(self, part: float) -> FloatArray:
        start, end = (self._system.centroids(points) for points in self._ends)
        return self._system.solve(self._turns.at(part), (1 - part) * start + part * end)

    @cached_property
    def _pair(self) -> Pair:
        return Pair(mesh_of(self.start), mesh_of(self.end))

    @cached_property
    def _ends(self) -> tuple[FloatArray, FloatArray]:
        """The places of the spots, (S, 3) each."""
        first = self._pair.spots[0]
        return self._pair.start.points[first].astype(np.float64), self._pair.end.points[first].astype(
            np.float64
        )

    @cached_property
    def _system(self) -> Poisson:
        return Poisson(self._ends[0], self._pair.spots[1][self._pair.start.faces])

    @cached_property
    def _turns(self) -> Turns:
        return Turns.between(*self._ends, self._system.faces)
