"""Samplers of animations: key times and values as curves. [glTF 2.0, 3.11]"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from eyeline.errors import FileError, SceneError
from eyeline.files.gltf.accessors import Accessors
from eyeline.files.gltf.part import Part
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.curve import Curve, Interpolation

INTERPOLATIONS: dict[str, Interpolation] = {"STEP": "step", "LINEAR": "linear", "CUBICSPLINE": "cubic"}
TYPES = ("SCALAR", "VEC2", "VEC3", "VEC4")


@dataclass(frozen=True, eq=False)
class Keys:
    """Times and values of a sampler, not yet a curve of anything."""

    times: FloatArray  # (K,) seconds, increasing
    values: FloatArray  # (K, 1 or 3, width): with "cubic" tangent in, value, tangent out
    interpolation: Interpolation
    place: str

    def changed(self, change: Callable[[FloatArray], FloatArray]) -> Keys:
        """The same keys with values changed by a linear function, which changes tangents likewise."""
        return replace(self, values=change(self.values))

    def shaped(self, shape: tuple[int, ...]) -> Keys:
        """The same keys, refused if their values have not the numbers of `shape`."""
        if self.values.shape[2] != math.prod(shape):
            raise FileError(
                f"{self.place} has values of {self.values.shape[2]} numbers; {math.prod(shape)} are needed"
            )
        return self

    def curve(self, shape: tuple[int, ...], rotation: bool = False) -> Curve:
        """The curve of values of this shape; () is a number."""
        self.shaped(shape)
        sides = (3,) if self.interpolation == "cubic" else ()
        values = self.values.reshape(len(self.times), *sides, *shape)
        try:
            return Curve(self.times, values, self.interpolation, rotation)
        except SceneError as error:
            raise FileError(f"{self.place}: {error}") from error


def keys_of(accessors: Accessors, sampler: Part) -> Keys:
    """The keys of a sampler; of two at one time the first is left out, and that is reported."""
    times = accessors.floats(sampler.whole("input"), ("SCALAR",), sampler.at("input"))[:, 0].astype(
        np.float64
    )
    values = accessors.floats(sampler.whole("output"), TYPES, sampler.at("output")).astype(np.float64)
    interpolation = INTERPOLATIONS[sampler.choice("interpolation", tuple(INTERPOLATIONS), "LINEAR")]
    if times[0] < 0 or (np.diff(times) < 0).any():
        raise FileError(
            f"{sampler.at('input')} has times that fall or lie before 0; rising seconds are needed"
        )
    sides = 3 if interpolation == "cubic" else 1
    if values.size % (sides * len(times)):
        raise FileError(
            f"{sampler.at('output')} has {len(values)} values for {len(times)} keys;"
            f" {sides} for each are needed"
        )
    width = values.size // (sides * len(times))
    values = values.reshape(len(times), sides, width)
    last = np.append(np.diff(times) > 0, True)
    if not last.all():
        accessors.document.notes.add(
            f"{sampler.at('input')} has several keys at one time; the last of them counts"
        )
    return Keys(times[last], values[last], interpolation, sampler.at("output"))
