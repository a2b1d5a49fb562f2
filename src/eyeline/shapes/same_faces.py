"""What in-betweens of meshes with the same faces share: the check, and the mesh of moved points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.cached import cached_property
from eyeline.errors import GeometryError
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.geometry.normals import SOMEWHERE, corner_angles, corner_sums, face_normals, tangents, unit
from eyeline.geometry.weld import welded
from eyeline.scene.mesh import Mesh
from eyeline.shapes.whole import material_between


@dataclass(frozen=True, eq=False)
class Pair:
    """Two meshes of the same faces."""

    start: Mesh
    end: Mesh

    def __post_init__(self) -> None:
        """Refuse meshes whose vertices do not answer each other."""
        start, end = self.start, self.end
        if len(start.points) != len(end.points) or len(start.faces) != len(end.faces):
            raise GeometryError(
                f"the meshes have {len(start.points):,} and {len(end.points):,} vertices,"
                f" {len(start.faces):,} and {len(end.faces):,} faces; the same are needed in both,"
                " or way='level_set'"
            )
        differing = np.flatnonzero((start.faces != end.faces).any(axis=1))
        if len(differing):
            first = int(differing[0])
            raise GeometryError(
                f"face {first} joins vertices {start.faces[first].tolist()} in one mesh and"
                f" {end.faces[first].tolist()} in the other; the same are needed, or way='level_set'"
            )

    @cached_property
    def spots(self) -> tuple[IntArray, IntArray]:
        """(first, index): vertices that lie at one place in both meshes are one spot."""
        return welded(np.hstack([self.start.points, self.end.points]))

    @cached_property
    def _shades(self) -> IntArray:
        """(V,) vertices at one spot with one normal share a number: seams of textures do not show."""
        both = [self.start.points, self.end.points, self.start.normals, self.end.normals]
        return welded(np.hstack([one for one in both if one is not None]))[1]

    def mesh(self, points: FloatArray, part: float) -> Mesh:
        """The start's mesh with its points (V, 3) moved, at a part of the way to the end.

        Where the start has normals they are found anew, creases stay; materials and colours mix where both
        meshes have as many. It stands: what would move it further, targets and joints, is left out.
        """
        start, end = self.start, self.end
        points = np.ascontiguousarray(points, np.float32)
        materials, colors = start.materials, start.colors
        if len(materials) == len(end.materials):
            pairs = zip(materials, end.materials, strict=True)
            materials = tuple(material_between(a, b, part) for a, b in pairs)
        if colors is not None and end.colors is not None:
            colors = np.clip(colors + np.float32(part) * (end.colors - colors), 0, 1)
        normals = None if start.normals is None else self._normals(points)
        turned = start.tangents
        if turned is not None and normals is not None and start.uv:
            turned = tangents(points, start.faces, normals, start.uv[0])
        return start.changed(
            points=points, normals=normals, tangents=turned, colors=colors, materials=materials,
            targets=(), weights=(), joints=None, influences=None,
        )  # fmt: skip

    def _normals(self, points: FloatArray) -> FloatArray:
        faces, shades = self.start.faces, self._shades
        angles, flat = corner_angles(points, faces), face_normals(points, faces)
        sums = corner_sums(shades[faces], angles, flat, int(shades.max()) + 1)
        return unit(sums, SOMEWHERE).astype(np.float32)[shades]
