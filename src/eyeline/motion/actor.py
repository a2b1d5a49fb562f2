"""A thing of a scene as an author directs it: `shot["ball"].animate.move_to((1, 0, 0)).rotate(1.5)`."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
import numpy.typing as npt

from eyeline.errors import SceneError
from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.act import Act, Change, Read, Way

Y = (0.0, 1.0, 0.0)
X = (1.0, 0.0, 0.0)
Z = (0.0, 0.0, 1.0)


@dataclass(frozen=True, eq=False)
class Animate(Act):
    """An act of one node or material, written verb after verb; each verb gives a longer act.

    Places and turns count against the parent. Camera verbs are those of a film crew: they move the camera
    along, or turn it about, its own axes as they stand when the act begins.
    """

    name: str = ""

    def set(self, what: str, value: npt.ArrayLike) -> Self:
        """Any property, by its name: "light.intensity", "roughness", "deform.angle", "controls.smile"."""
        wanted = np.asarray(value, dtype=np.float64)
        return self._to(what, lambda start: wanted)

    # --- nodes -------------------------------------------------------------------------------------------

    def move_to(self, place: npt.ArrayLike) -> Self:
        """To a place, metres, straight."""
        return self.set("translation", place)

    def move_by(self, offset: npt.ArrayLike) -> Self:
        """By an offset, metres, straight."""
        return self._to("translation", lambda start: start + np.asarray(offset, np.float64))

    def rotate(self, angle: float, axis: npt.ArrayLike = Y, about: npt.ArrayLike | None = None) -> Self:
        """By an angle, radians, however many times around; about its own origin, or a place of its parent."""
        unit = _unit(axis)

        def turn(read: Read, parts: FloatArray) -> FloatArray:
            return quaternion.multiply(quaternion.from_axis_angle(unit, angle * parts), read("rotation"))

        turned = self._and("rotation", turn, straight=abs(angle) < math.pi)
        if about is None:
            return turned
        centre = np.asarray(about, np.float64)

        def carry(read: Read, parts: FloatArray) -> FloatArray:
            matrices = quaternion.to_matrix(quaternion.from_axis_angle(unit, angle * parts))
            return centre + matrices @ (read("translation") - centre)

        return turned._and("translation", carry, straight=False)

    def rotate_to(self, rotation: npt.ArrayLike) -> Self:
        """To a rotation x y z w, the short way."""
        return self.set("rotation", quaternion.normalized(rotation))

    def scale(self, factor: npt.ArrayLike) -> Self:
        """By a factor, or by three."""
        return self._to("scale", lambda start: start * np.asarray(factor, np.float64))

    def show(self) -> Self:
        """Seen from when the act ends."""
        return self.set("visible", 1.0)

    def hide(self) -> Self:
        """Not seen from when the act ends."""
        return self.set("visible", 0.0)

    # --- materials ---------------------------------------------------------------------------------------

    def paint(self, color: npt.ArrayLike) -> Self:
        """To a base colour, linear; three numbers leave the alpha as it is."""
        wanted = np.asarray(color, np.float64)
        return self._to("base_color", lambda start: np.concatenate([wanted, start[len(wanted) :]]))

    def fade_to(self, alpha: float) -> Self:
        """To an alpha, 0 is clear; seen if the material's alpha_mode is "blend"."""
        return self._to("base_color", lambda start: np.concatenate([start[:3], [alpha]]))

    # --- cameras -----------------------------------------------------------------------------------------

    def pan(self, angle: float) -> Self:
        """Turns to the left by an angle, radians, about the upright."""
        return self.rotate(angle, Y)

    def tilt(self, angle: float) -> Self:
        """Looks up by an angle, radians."""
        return self._turn_itself(angle, X)

    def roll(self, angle: float) -> Self:
        """Turns about its view by an angle, radians: the picture turns clockwise."""
        return self._turn_itself(angle, Z)

    def dolly(self, metres: float) -> Self:
        """Goes ahead, along its view."""
        return self._shift((0, 0, -metres))

    def truck(self, metres: float) -> Self:
        """Goes to its right."""
        return self._shift((metres, 0, 0))

    def crane(self, metres: float) -> Self:
        """Goes up, along the upright."""
        return self.move_by((0, metres, 0))

    def orbit(self, target: npt.ArrayLike, angle: float, axis: npt.ArrayLike = Y) -> Self:
        """Around a place by an angle, radians, its eye kept on it as it was."""
        return self.rotate(angle, axis, about=target)

    def zoom(self, focal_length: float) -> Self:
        """To a focal length, millimetres on a 24 mm high sensor."""
        return self.set("camera.focal_length", focal_length)

    def dolly_zoom(self, target: npt.ArrayLike, focal_length: float) -> Self:
        """To a focal length, and nearer or farther, so that what is at `target` keeps its size."""
        place = np.asarray(target, np.float64)

        def go(read: Read, parts: FloatArray) -> FloatArray:
            growth = 1 + parts[:, None] * (focal_length / read("camera.focal_length") - 1)
            return place + growth * (read("translation") - place)

        return self.zoom(focal_length)._and("translation", go)

    # --- how verbs are written ---------------------------------------------------------------------------

    def _turn_itself(self, angle: float, axis: npt.ArrayLike) -> Self:
        """About one of its own axes."""

        def turn(read: Read, parts: FloatArray) -> FloatArray:
            return quaternion.multiply(read("rotation"), quaternion.from_axis_angle(axis, angle * parts))

        return self._and("rotation", turn, straight=abs(angle) < math.pi)

    def _shift(self, offset: npt.ArrayLike) -> Self:
        """Along its own axes as they are when it begins."""

        def go(read: Read, parts: FloatArray) -> FloatArray:
            way = quaternion.to_matrix(read("rotation")) @ np.asarray(offset, np.float64)
            return read("translation") + parts[:, None] * way

        return self._and("translation", go)

    def _to(self, what: str, value: Callable[[FloatArray], FloatArray]) -> Self:
        """To a value that may depend on the one it starts from; what moves is only ever asked at the ends."""

        def go(read: Read, parts: FloatArray) -> FloatArray:
            start = read(what)
            wanted = value(start)
            if wanted.shape != start.shape:
                wanted = np.broadcast_to(wanted, start.shape)
            return np.where(parts.reshape(-1, *[1] * start.ndim) >= 1, wanted, start)

        return self._and(what, go)

    def _and(self, what: str, way: Way, *, straight: bool = True) -> Self:
        """One change more; what this act already changes is refused: it can go only one way."""
        if any(change.property == what for change in self.changes):
            raise SceneError(f"{self.name}.{what} is changed twice in one act; play them in turn")
        return replace(self, changes=(*self.changes, Change(self.name, what, way, straight)))


def _unit(axis: npt.ArrayLike) -> FloatArray:
    vector: FloatArray = np.asarray(axis, dtype=np.float64)
    length = np.sqrt((vector * vector).sum())
    if vector.shape != (3,) or not 0 < length < math.inf:
        raise SceneError(f"axis is {axis!r}; three numbers that are not all 0 are needed")
    unit: FloatArray = vector / length
    return unit


@dataclass(frozen=True)
class Actor:
    """A node, material or constraint of a shot, by its name."""

    name: str

    @property
    def animate(self) -> Animate:
        """An act of it, still empty: verbs fill it."""
        return Animate(name=self.name)
