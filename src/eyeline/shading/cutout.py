"""What is seen through holes: faces whose texture says where they end. [glTF 2.0, 3.9.4]

A method takes faces as solid. So faces of alpha mode "mask" are left out of its question and come back as
fragments; at every sample the nearest one that is no hole stands against the method's answer.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from eyeline.geometry.arrays import BoolArray
from eyeline.jit import share, threads
from eyeline.projection.projected import Projected
from eyeline.scene.scene import Scene
from eyeline.shading.alpha import cutoffs_of, faces_of, has
from eyeline.shading.attributes import attributes_of
from eyeline.shading.frame import Frame
from eyeline.shading.lanes import COVER
from eyeline.shading.look import Look
from eyeline.shading.surface_points import GRID, SurfacePoints
from eyeline.visibility.fragments import Fragments, fragments
from eyeline.visibility.method import PixelMethod, Step, Visible

CHUNK = 1 << 15  # fragments whose texture is looked up together

Shift = tuple[int, int]  # of a sample beside its pixel's centre, 1/256 pixel


def see(
    scene: Scene,
    projected: Projected,
    method: PixelMethod,
    shifts: Sequence[Shift] = ((0, 0),),
    *,
    see_through: bool = False,
) -> list[tuple[Visible, int, int]]:
    """What a method sees at each sample, with holes where masks say so, and the sample's shift.

    see_through: faces of alpha mode "blend" are left out, to be composited over the answer; otherwise they
    are solid.
    """
    if see_through and has(projected.surfaces, "blend"):
        projected = projected.only(~faces_of(projected.surfaces, "blend"))
    if has(projected.surfaces, "mask"):
        method = CutOut(method, Frame(scene, projected, (), Look()))
    return [(replace(method(projected.shifted(dx, dy)), scene=scene), dx, dy) for dx, dy in shifts]


@dataclass(frozen=True, eq=False)
class CutOut:
    """A method that sees through holes: another one, and the picture whose textures say where they are."""

    method: PixelMethod
    frame: Frame

    @property
    def name(self) -> str:
        """The other method's."""
        return self.method.name

    @property
    def space(self) -> str:
        """The other method's."""
        return self.method.space

    @property
    def answers(self) -> bool:
        """The other method's."""
        return self.method.answers

    @property
    def exact(self) -> bool:
        """The other method's."""
        return self.method.exact

    def __call__(self, projected: Projected) -> Visible:
        """The other's answer about solid faces, with the masked ones in front of it but for their holes."""
        masks = faces_of(projected.surfaces, "mask")
        solid = self.method(projected.only(~masks))
        # A masked face at the very depth of a solid one counts if its number is lower, so it must be listed
        found = fragments(projected.only(masks), np.nextafter(solid.depth, np.float32(0)))
        face, depth = found.only(is_there(self.frame, found, projected.shift)).nearest()
        nearer = (depth > solid.depth) | ((depth == solid.depth) & (depth > 0) & (face < solid.face))
        return replace(
            solid,
            face=np.where(nearer, face, solid.face),
            depth=np.where(nearer, depth, solid.depth),
            projected=projected,
            method=self,
            work={**solid.work, "alpha tests": len(found)},
        )

    def steps(self, projected: Projected) -> Iterator[Step]:
        """The other's, of all faces as solid ones."""
        return self.method.steps(projected)


def is_there(frame: Frame, found: Fragments, shift: Shift) -> BoolArray:
    """(K,) whether the surface is there at each fragment: its alpha reaches its face's cutoff."""
    there = np.empty(len(found), bool)
    cutoffs = cutoffs_of(frame.projected.surfaces)
    pixels, width = found.pixel, found.width
    dx, dy = (0.5 + part / GRID for part in shift)

    def test(part: int) -> None:
        for begin in range(part * CHUNK, len(found), threads() * CHUNK):
            chosen = slice(begin, begin + CHUNK)
            row, column = np.divmod(pixels[chosen], width)
            face = found.face[chosen]
            points = SurfacePoints(
                pixels[chosen].astype(np.int32), face,
                (column + dx).astype(np.float32), (row + dy).astype(np.float32),
            )  # fmt: skip
            there[chosen] = attributes_of(frame, points)[COVER, : len(face)] >= cutoffs[face]

    frame.geometry  # noqa: B018  made once, before threads ask for it
    share(test, threads())
    return there
