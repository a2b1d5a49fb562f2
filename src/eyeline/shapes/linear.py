"""Each vertex goes straight from its place in one mesh to its place in the other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from eyeline.cached import cached_property
from eyeline.geometry.arrays import FloatArray
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.shapes.parts import parts_of
from eyeline.shapes.same_faces import Pair
from eyeline.shapes.whole import mesh_of


@dataclass(frozen=True, eq=False)
class Linear:
    """Straight lines, the cheapest way. What turns on its way from shape to shape shrinks.

    start, end: meshes of the same faces, or scenes whose surfaces make such meshes.
    """

    start: Mesh | Scene
    end: Mesh | Scene

    def __post_init__(self) -> None:
        """Refuse shapes that do not answer each other."""
        self._pair  # noqa: B018  the check is in its making

    def at(self, part: float) -> Mesh:
        """The mesh at a part of the way: 0 is the start, 1 the end; others go on along the lines."""
        return self._pair.mesh(self.sample([part])[0], part)

    def sample(self, parts: npt.ArrayLike) -> FloatArray:
        """(T, V, 3) the points at parts (T,) of the way, metres."""
        part = parts_of(parts)[:, None, None]
        pair = self._pair
        return (1 - part) * pair.start.points + part * pair.end.points.astype(np.float64)

    @cached_property
    def _pair(self) -> Pair:
        return Pair(mesh_of(self.start), mesh_of(self.end))
