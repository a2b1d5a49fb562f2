"""What a camera sees, ready for any method: snapped vertices, faces, and which of their sides count."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from eyeline.cached import cached_property
from eyeline.geometry import transform
from eyeline.geometry.arrays import BoolArray, ByteArray, FloatArray, IntArray
from eyeline.scene.camera import Camera
from eyeline.scene.surface import Surface

COUNTER_CLOCKWISE, CLOCKWISE = 1, 2  # the sides of a face, as it turns on screen with y down the page


@dataclass(frozen=True, eq=False)
class Projected:
    """Vertices on the picture's grid of 1/256 pixel, and faces over them.

    The first `face_count` faces are the surfaces' own, surface after surface; one that crosses the near plane
    or the guard band has side 0 there, and its pieces stand behind them. Depth is reversed: 1 near, 0 far.
    """

    xy: IntArray  # (V, 2) int32, 1/256 pixel, x right, y down; pixel (0, 0) is centred at (128, 128)
    depth: FloatArray  # (V,) float32, linear on the screen
    faces: IntArray  # (F, 3) int32 into the vertices
    sides: ByteArray  # (F,) or (1,) for all: which sides count, COUNTER_CLOCKWISE | CLOCKWISE; 0 is not drawn
    face_count: int  # how many faces are uncut
    piece_source: IntArray  # (F - face_count,) which of the uncut faces a piece is cut from
    first_faces: IntArray  # (S + 1,) where the faces of each surface begin among the uncut ones
    surfaces: tuple[Surface, ...]  # (S,)
    camera: Camera  # with near and far
    width: int
    height: int
    shift: tuple[int, int] = (0, 0)  # of the samples beside the pixels' centres, 1/256 pixel

    @cached_property
    def clip_from_world(self) -> FloatArray:
        """(4, 4) float64."""
        clip_from_eye = self.camera.clip_from_eye(self.width / self.height)
        return transform.product(clip_from_eye, self.camera.eye_from_world)

    @cached_property
    def places(self) -> FloatArray:
        """(S, 4, 4) float64 world_from_mesh of every surface."""
        return np.array([surface.world_from_mesh for surface in self.surfaces], np.float64).reshape(-1, 4, 4)

    @cached_property
    def clip_from_meshes(self) -> FloatArray:
        """(S, 4, 4) float64."""
        return transform.product(self.clip_from_world, self.places)

    @property
    def standing_by(self) -> str | None:
        """How `surfaces` are culled, where they alone tell everything; None where only the arrays do."""
        return None

    @cached_property
    def source(self) -> IntArray:
        """(F,) for every face, the uncut one it comes from."""
        return np.concatenate([np.arange(self.face_count, dtype=np.int32), self.piece_source])

    def only(self, wanted: BoolArray) -> Projected:
        """The same picture of the faces (face_count,) that are wanted; all keep their numbers."""
        every = np.concatenate([wanted, wanted[self.piece_source]])
        return replace(self, sides=np.where(every, self.sides, 0).astype(np.uint8))

    def shifted(self, dx: int, dy: int) -> Projected:
        """The same picture sampled dx, dy (1/256 pixel) beside the pixels' centres."""
        xy = self.xy - np.array([dx, dy], dtype=np.int32)
        return replace(self, xy=xy, shift=(self.shift[0] + dx, self.shift[1] + dy))
