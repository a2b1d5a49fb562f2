"""Drive: a control moves a number of a node, straight or through driven keys."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from eyeline.errors import SceneError, suggestion
from eyeline.geometry import quaternion
from eyeline.geometry.arrays import FloatArray
from eyeline.motion.curve import Curve
from eyeline.scene.pose import Samples

PLACES = ("translation", "rotation", "scale")


@dataclass(frozen=True)
class Drive:
    """Adds to a number of a node `rate` times a control, so that several drives may share one number.

    by: the control, "NODE.CONTROL". moves: "translation", "scale", or "deform.PART.NUMBER" of the node, and
    rate is of its shape; or "rotation": rate (3,) is the axis, in the node's own space, times radians.
    curve: driven keys, from the control to what stands in its place; its times are the control's values.
    Numbers of deformers are added for a node that has a deformer, else nothing is.
    """

    name: str
    node: str
    moves: str
    by: str
    rate: npt.ArrayLike = 1.0
    curve: Curve | None = None

    def __post_init__(self) -> None:
        """Refuse what cannot be driven, and rates of another shape."""
        if self.moves not in PLACES and not self.moves.startswith("deform."):
            raise SceneError(
                f"constraint {self.name!r} moves {self.moves!r};"
                f" {', '.join(PLACES)} or deform.NUMBER is needed"
            )
        if self.moves in PLACES and np.shape(self.rate) != (3,):
            raise SceneError(
                f"constraint {self.name!r} has a rate of shape {np.shape(self.rate)}; (3,) is needed"
            )
        if "." not in self.by:
            raise SceneError(f"constraint {self.name!r} is driven by {self.by!r}; NODE.CONTROL is needed")

    def __call__(self, pose: Samples, moved: Mapping[str, FloatArray]) -> Samples:
        """The pose with the number moved."""
        node = pose.find(self.node)
        rate = np.asarray(moved.get("rate", [self.rate]), dtype=np.float64)
        amount = self._amount(pose)
        added = rate * amount.reshape(-1, *[1] * (rate.ndim - 1))
        if self.moves == "rotation":
            angle = np.sqrt((added * added).sum(axis=1))
            axis = added / np.where(angle > 0, angle, 1)[:, None]
            turn = quaternion.from_axis_angle(axis, angle)
            return pose.placed(node, rotation=quaternion.multiply(pose.rotation[:, node], turn))
        if self.moves in PLACES:
            return pose.placed(node, **{self.moves: getattr(pose, self.moves)[:, node] + added})
        number = self.moves.removeprefix("deform.")
        before = pose.deforms.get(node, {})
        driven = {**before, number: before.get(number, 0.0) + added}
        return replace(pose, deforms={**pose.deforms, node: driven})

    def _amount(self, pose: Samples) -> FloatArray:
        """(T,) the control, or what the driven keys make of it."""
        path, _, control = self.by.rpartition(".")
        controls = pose.controls.get(pose.find(path), {})
        if control not in controls:
            near = suggestion(control, controls)
            raise SceneError(f"constraint {self.name!r}: {path!r} has no control {control!r}{near}")
        return controls[control] if self.curve is None else self.curve.at(controls[control])
