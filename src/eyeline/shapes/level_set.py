"""Between any two closed shapes: the surface where the mean of their signed distances is zero. [Payne92]"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.cached import cached_property
from eyeline.errors import GeometryError, OptionError
from eyeline.geometry.arrays import FloatArray
from eyeline.geometry.bounds import Bounds
from eyeline.geometry.normals import unit
from eyeline.jit import share, threads
from eyeline.scene.mesh import Mesh
from eyeline.scene.scene import Scene
from eyeline.shapes.alignment import Frame, frame_of
from eyeline.shapes.deviation import Deviation, deviation
from eyeline.shapes.distance import signed_distance
from eyeline.shapes.grid import Grid
from eyeline.shapes.parts import parts_of
from eyeline.shapes.surface_nets import surface_net
from eyeline.shapes.whole import material_between, mesh_of

CELLS = 128


@dataclass(frozen=True, eq=False)
class LevelSet:
    """Shapes may split, join and open holes: a ring becomes a teapot.

    start, end: meshes, or scenes whose surfaces make one; closed, or nearly so. Parts that overlap are
    one body, and what is thinner than a cell may be lost. cells: points of the grid along the longest side.
    align: "none" compares them where they stand, "centre" lays their centroids and mean sizes over each
    other, "box" their boxes; on the way the place and the size then go evenly from one to the other.
    """

    start: Mesh | Scene
    end: Mesh | Scene
    cells: int = CELLS
    align: str = "none"

    def __post_init__(self) -> None:
        """Refuse what has no shape, and options that are not there."""
        self._grid, self._frames  # noqa: B018  the checks are in their making

    def at(self, part: float) -> Mesh:
        """The mesh at a part of the way, 0 to 1: its faces are new at each, its normals are smooth.

        Its material is between the first materials of both. Refused: a part where nothing is left.
        """
        part = float(parts_of(part)[0])
        if not 0 <= part <= 1:
            raise OptionError(f"the part of the way is {part:g}; level sets go from 0 to 1")
        start, end = self._distances
        net = surface_net(self._grid, (1 - np.float32(part)) * start + np.float32(part) * end)
        if len(net.faces) == 0:
            raise GeometryError(
                f"nothing is left at part {part:g} of the way: the shapes do not overlap enough;"
                " align them, or use more cells"
            )
        frame = self._frames[0].towards(self._frames[1], part)
        material = material_between(self._meshes[0].materials[0], self._meshes[1].materials[0], part)
        normals = unit(net.normals / frame.scale).astype(np.float32)
        return Mesh(frame.placed(net.points), net.faces, normals, material=material)

    @cached_property
    def error(self) -> tuple[Deviation, Deviation]:
        """How far the first and the last shape are from the meshes they stand for, measured."""
        return deviation(self.at(0), self._meshes[0]), deviation(self.at(1), self._meshes[1])

    @property
    def cell(self) -> float:
        """The edge of a cell, metres: where both shapes are compared."""
        return self._grid.step

    @cached_property
    def _meshes(self) -> tuple[Mesh, Mesh]:
        return mesh_of(self.start), mesh_of(self.end)

    @cached_property
    def _frames(self) -> tuple[Frame, Frame]:
        return frame_of(self._meshes[0], self.align), frame_of(self._meshes[1], self.align)

    @cached_property
    def _laid(self) -> tuple[FloatArray, FloatArray]:
        """The points of both, laid over each other."""
        first, last = (
            frame.laid(mesh.points) for frame, mesh in zip(self._frames, self._meshes, strict=True)
        )
        return first, last

    @cached_property
    def _grid(self) -> Grid:
        return Grid.around(Bounds.of(self._laid[0]).union(Bounds.of(self._laid[1])), self.cells)

    @cached_property
    def _distances(self) -> tuple[FloatArray, FloatArray]:
        """(K,) float32 each."""

        def of(which: int) -> FloatArray:
            return signed_distance(self._grid, self._laid[which], self._meshes[which].faces)

        start, end = share(of, 2) if threads() > 1 else (of(0), of(1))
        return start, end
