"""The eye: where it stands, and its lens."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
import numpy.typing as npt

from eyeline.cached import cached_property
from eyeline.errors import GeometryError
from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray
from eyeline.geometry.bounds import Bounds

SENSOR_HEIGHT = 0.024  # metres: the 24 mm of a 36 x 24 film frame
THREE_QUARTER = (0.55, 0.38, 1.0)  # where the eye stands that frames a scene, seen from its middle
FILLED = 0.8  # of the picture's width or height, by what is framed
NEAR_PART = 1e-3  # the near plane of a camera without one, as a part of the scene's diagonal


@dataclass(frozen=True, eq=False)
class Camera:
    """A perspective (fov) or orthographic (height) lens, and its place in the world.

    fov: the vertical angle of view, radians, 0 < fov < pi. height: metres seen from top to bottom.
    near, far: metres along the view; without near it follows from the scene, without far a
    perspective camera sees to infinity. aspect: width / height it was made for; the picture's size wins.
    """

    fov: float | None = None
    height: float | None = None
    near: float | None = None
    far: float | None = None
    aspect: float | None = None
    world_from_eye: FloatArray = field(default_factory=transform.identity)  # (4, 4) rigid
    name: str = ""

    def __post_init__(self) -> None:
        """Refuse a lens that cannot see."""
        if (self.fov is None) == (self.height is None):
            raise GeometryError("a camera has either a field of view or an orthographic height")
        if self.fov is not None and not 0 < self.fov < math.pi:
            raise GeometryError(f"fov is {self.fov} radians; between 0 and pi is needed")
        if self.height is not None and not 0 < self.height < math.inf:
            raise GeometryError(f"height is {self.height} metres; more than 0 is needed")
        if self.near is not None and not (0 if self.height is None else -math.inf) < self.near < math.inf:
            raise GeometryError(
                f"near is {self.near} metres; a finite distance in front of the eye is needed"
            )
        if self.far is not None and not (self.near or 0) < self.far:
            raise GeometryError(f"far is {self.far} metres; more than near, {self.near}, is needed")

    @classmethod
    def look_at(
        cls,
        eye: npt.ArrayLike,
        target: npt.ArrayLike,
        up: npt.ArrayLike = (0, 1, 0),
        *,
        fov: float | None = None,
        focal_length: float | None = None,
        height: float | None = None,
        near: float | None = None,
        far: float | None = None,
        name: str = "",
    ) -> Camera:
        """A camera at `eye` that looks at `target`.

        One lens: fov (vertical, radians), focal_length (millimetres on a 24 mm high sensor) or height
        (orthographic, metres); without any, fov = 45 degrees.
        """
        if sum(lens is not None for lens in (fov, focal_length, height)) > 1:
            raise GeometryError("fov, focal_length and height exclude each other; give one")
        if focal_length is not None:
            if not 0 < focal_length < math.inf:
                raise GeometryError(f"focal_length is {focal_length} mm; more than 0 is needed")
            fov = fov_of(focal_length)
        elif fov is None and height is None:
            fov = math.radians(45)
        return cls(fov, height, near, far, None, transform.look_at(eye, target, up), name)

    @classmethod
    def framing(cls, bounds: Bounds, aspect: float = 16 / 9) -> Camera:
        """A three-quarter view from the front right and above, as near as holds all of `bounds`."""
        fov = math.radians(30)
        axes = transform.look_at(THREE_QUARTER, (0, 0, 0))[:3, :3]
        points = (bounds.corners - bounds.centre if bounds.diagonal else np.eye(3)) @ axes
        eye = np.zeros(3)
        # On either axis, the eye lies between the planes through the outermost points
        for axis, tangent in ((0, math.tan(fov / 2) * aspect * FILLED), (1, math.tan(fov / 2) * FILLED)):
            highest = (points[:, axis] + points[:, 2] * tangent).max()
            lowest = (points[:, axis] - points[:, 2] * tangent).min()
            eye[axis] = (highest + lowest) / 2
            eye[2] = max(eye[2], (highest - lowest) / (2 * tangent))
        place = transform.identity()
        place[:3, :3] = axes
        place[:3, 3] = bounds.centre + axes @ eye
        return cls(fov, world_from_eye=place, name="three-quarter view")

    @property
    def focal_length(self) -> float | None:
        """Millimetres on a 24 mm high sensor; None for an orthographic camera."""
        return None if self.fov is None else 1e3 * SENSOR_HEIGHT / (2 * math.tan(self.fov / 2))

    @cached_property
    def eye_from_world(self) -> FloatArray:
        """(4, 4)."""
        return transform.inverse(self.world_from_eye)

    def moved(self, world_from_eye: FloatArray) -> Camera:
        """This lens elsewhere."""
        return replace(self, world_from_eye=world_from_eye)

    def fitted(self, bounds: Bounds) -> Camera:
        """This camera with the planes it lacks, from the world bounds of what it sees."""
        near, far = self.near, self.far
        if self.fov is not None:
            near = near if near is not None else NEAR_PART * (bounds.diagonal or 1.0)
        else:
            distances = -(bounds.moved(self.eye_from_world).corners[:, 2])
            margin = NEAR_PART * (bounds.diagonal or 1.0)
            near = (
                near
                if near is not None
                else float(distances.min(initial=0.0 if bounds.is_empty else math.inf) - margin)
            )
            far = far if far is not None else float(max(distances.max(initial=-math.inf), near) + margin)
        return replace(self, near=near, far=far)

    def clip_from_eye(self, aspect: float) -> FloatArray:
        """(4, 4) for a picture of this width / height: x, y in -w..w, reversed depth z from w (near) to 0.

        Needs near, and far if orthographic: see `fitted`.
        """
        near, far = self.near, self.far
        if near is None or (self.fov is None and far is None):
            raise GeometryError("the camera has no near or far plane yet; call fitted(bounds) first")
        if self.fov is not None:
            t = 1 / math.tan(self.fov / 2)
            # Depth is near (far - distance) / (distance (far - near)), near / distance without a far plane.
            a, b = (
                (0.0, near)
                if far is None or math.isinf(far)
                else (near / (far - near), near * far / (far - near))
            )
            return np.array([[t / aspect, 0, 0, 0], [0, t, 0, 0], [0, 0, a, b], [0, 0, -1, 0]], float)
        assert self.height is not None and far is not None
        t = 2 / self.height
        return np.array(
            [[t / aspect, 0, 0, 0], [0, t, 0, 0], [0, 0, 1 / (far - near), far / (far - near)], [0, 0, 0, 1]],
            float,
        )


def fov_of(focal_length: float) -> float:
    """The vertical angle of view, radians, of a focal length in millimetres on a 24 mm high sensor."""
    return 2 * math.atan(SENSOR_HEIGHT * 1e3 / (2 * focal_length))
