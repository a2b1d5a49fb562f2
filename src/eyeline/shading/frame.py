"""One frame to draw: what is seen at every sample, cut into strips that threads draw side by side."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from eyeline.cached import cached_property
from eyeline.geometry.arrays import ByteArray, FloatArray, IntArray
from eyeline.jit import share, threads
from eyeline.projection.projected import Projected
from eyeline.scene.scene import Scene
from eyeline.shading.backdrop import backdrop
from eyeline.shading.floor import Floor, floor_of
from eyeline.shading.geometry_table import Geometry, geometry_of, meshes_of
from eyeline.shading.look import Look
from eyeline.shading.material_table import Materials, materials_of
from eyeline.shading.resolve import Layers, resolve
from eyeline.shading.surface_points import GRID, SurfacePoints, distinct_points
from eyeline.visibility.method import Visible

STRIP_PIXELS = 1 << 16  # so that what a thread works on stays near it


@dataclass(frozen=True, eq=False)
class Frame:
    """A scene, what is seen of it at every antialiasing sample, and how it shall look."""

    scene: Scene
    projected: Projected
    visibles: Sequence[tuple[Visible, int, int]]  # one answer for each sample, and its shift, 1/256 pixel
    look: Look

    @property
    def size(self) -> tuple[int, int]:
        """(width, height)."""
        return self.projected.width, self.projected.height

    @cached_property
    def shifts(self) -> FloatArray:
        """(n, 2) float32: where each sample lies beside its pixel's centre, pixels."""
        return np.array([(dx, dy) for _, dx, dy in self.visibles], np.float32).reshape(-1, 2) / np.float32(
            GRID
        )

    @cached_property
    def backdrop(self) -> ByteArray:
        """(H, W, 4) the picture where nothing stands."""
        return backdrop(self.look.background, *self.size)

    @cached_property
    def _materials(self) -> tuple[Materials, list[int]]:
        return materials_of(meshes_of(self.projected))

    @property
    def materials(self) -> Materials:
        """Every material, as numbers."""
        return self._materials[0]

    @cached_property
    def textured(self) -> bool:
        """Whether any material has a texture."""
        return bool((self.materials.slots[..., 0] >= 0).any())

    @cached_property
    def geometry(self) -> Geometry:
        """Every mesh, as flat arrays."""
        return geometry_of(self.projected, self._materials[1])

    @cached_property
    def floor(self) -> Floor | None:
        """The studio floor, where there is one to see."""
        return floor_of(self.scene, self.projected, self.look, not self.scene.lights)

    @cached_property
    def sight(self) -> FloatArray:
        """(4,) float32: the direction to an orthographic eye, or 0, and 1 for a perspective one."""
        camera = self.projected.camera
        if camera.fov is None:
            return np.array([*camera.world_from_eye[:3, 2], 0.0], np.float32)
        return np.array([0.0, 0.0, 0.0, 1.0], np.float32)

    def drawn(
        self,
        colour_of: Callable[[Strip], FloatArray | tuple[FloatArray, Layers]],
        behind: Callable[[Strip], ByteArray] | None = None,
    ) -> ByteArray:
        """The picture (H, W, 4) whose surface points have the colours that `colour_of` gives.

        colour_of(strip) -> (K, 4) float32 for strip.points: linear 0..1, alpha last, not multiplied by it;
        optionally with the layers in front of them. behind(strip) -> (rows, W, 4) sRGB, where nothing stands;
        without it the backdrop. Both are called on several threads at once.
        """
        width, height = self.size
        picture = np.empty((height, width, 4), np.uint8)
        step = max(1, STRIP_PIXELS // width)
        tops = list(range(0, height, step))

        def draw(part: int) -> None:
            for top in tops[part :: threads()]:
                strip = Strip(self, top, min(height, top + step))
                answer = colour_of(strip)
                colour, layers = answer if isinstance(answer, tuple) else (answer, None)
                back = strip.backdrop if behind is None else behind(strip)
                resolve(strip.of_sample, colour, layers, back, picture[top : strip.bottom], top)

        share(draw, min(threads(), len(tops)))
        return picture


@dataclass(frozen=True, eq=False)
class Strip:
    """Some rows of a frame."""

    frame: Frame
    top: int
    bottom: int  # the first row below

    @property
    def first_pixel(self) -> int:
        """row * W of its first pixel."""
        return self.top * self.frame.projected.width

    @cached_property
    def _distinct(self) -> tuple[SurfacePoints, IntArray]:
        rows = [visible.face[self.top : self.bottom].reshape(1, -1) for visible, _, _ in self.frame.visibles]
        faces = rows[0] if len(rows) == 1 else np.concatenate(rows)
        return distinct_points(faces, self.frame.shifts, self.first_pixel, self.frame.projected.width)

    @property
    def points(self) -> SurfacePoints:
        """The places to shade."""
        return self._distinct[0]

    @property
    def of_sample(self) -> IntArray:
        """(n, P) which point each sample of each pixel sees; -1 is the backdrop."""
        return self._distinct[1]

    @property
    def backdrop(self) -> ByteArray:
        """(rows, W, 4)."""
        return self.frame.backdrop[self.top : self.bottom]
