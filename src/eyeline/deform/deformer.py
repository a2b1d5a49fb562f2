"""What all deformers share: a name, a place, how much they do and where; and what they can be asked."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, ClassVar, Self

import numpy as np
import numpy.typing as npt

from eyeline.deform import run
from eyeline.deform.plan import Plan
from eyeline.errors import GeometryError
from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray

Vector = tuple[float, float, float]

ENDLESS = {"reach", "fade"}  # numbers that may be infinite, and must be above 0 or no less


@dataclass(frozen=True, eq=False, kw_only=True)
class Deformer(ABC):
    """Moves points, and with them the normals and tangents of the surface they are on.

    weight: 0 leaves all as it is, 1 does all; between them points go straight from one to the other.
    mask: (V,) a weight of each vertex besides. It is taken for even around each vertex.
    reach: how far from its origin it fades to nothing, smoothly; everywhere without.
    A deformer stands at `origin` with its y along `axis`, in the space of the mesh; or in `frame`.
    """

    kind: ClassVar[str]  # its name in DEFORMERS, and its own where it was given none

    name: str = ""
    weight: float = 1.0
    origin: Vector = (0.0, 0.0, 0.0)  # metres
    axis: Vector = (0.0, 1.0, 0.0)  # of any length but none
    towards: float = 0.0  # radians about the axis, by the right hand, that its x and z are turned
    frame: FloatArray | None = None  # (4, 4) affine, deformer_from_mesh; where given, in place of these three
    reach: float = math.inf  # metres
    mask: FloatArray | None = None  # (V,)

    def __post_init__(self) -> None:
        """Refuse numbers that are none, and an axis without direction."""
        for name, value in self.numbers().items():
            if not np.isfinite(value).all() and name not in ENDLESS:
                raise GeometryError(f"{self.label}: {name} is {value.tolist()}; every number must be finite")
        if not self.reach > 0:
            raise GeometryError(f"{self.label}: reach is {self.reach:g}; it must be above 0")
        if self.frame is None and not np.any(self.axis):
            raise GeometryError(f"{self.label}: axis is {tuple(self.axis)}, which has no direction")

    @property
    def label(self) -> str:
        """Its name, or else that of its kind: what a composite and tracks call it."""
        return self.name or self.kind

    @property
    def parameters(self) -> dict[str, FloatArray]:
        """All that can be keyed, by name."""
        return self.numbers()

    def numbers(self) -> dict[str, FloatArray]:
        """All numbers of its own, by name."""
        values = {one.name: np.asarray(getattr(self, one.name)) for one in fields(self)}
        return {name: value.astype(np.float64) for name, value in values.items() if value.dtype.kind in "fiu"}

    def changed(self, values: Mapping[str, npt.ArrayLike]) -> Self:
        """This deformer with other numbers; refused: a parameter that it has not."""
        for name in values:
            if name not in self.parameters:
                raise GeometryError(f"{self.label} has no {name!r}; it has {', '.join(self.parameters)}")
        numbers: dict[str, Any] = dict(values)
        return replace(self, **numbers)

    # --- what it does -----------------------------------------------------------------------------------

    def __call__(
        self, points: FloatArray, normals: FloatArray | None = None, tangents: FloatArray | None = None
    ) -> run.Deformed:
        """(points, normals, tangents) moved: (V, 3), unit (V, 3), and (V, 4) with w for the side.

        As float32, or float64 where the points are; what was given itself where nothing moves.
        """
        return run.deformed(self.plan(), points, normals, tangents)

    def jacobians(self, points: FloatArray) -> FloatArray:
        """(V, 3, 3) float64: how each coordinate of a moved point grows with each of the given one."""
        return run.jacobians(self.plan(), points)

    def growth(self, points: FloatArray) -> FloatArray:
        """(V,) how many times its volume what is around a point takes; below 0 where turned inside out.

        The determinant of the Jacobian, which is known in closed form: nothing is measured.
        """
        return transform.determinants(self.jacobians(points))

    @property
    def mirrors(self) -> bool:
        """Whether it turns a whole shape inside out, so that its faces must turn the other way round."""
        return self.plan().mirrored

    def plan(self) -> Plan:
        """What it does, as steps."""
        plan = Plan()
        self.join(plan)
        return plan

    def join(self, plan: Plan) -> None:
        """Add to a plan what it does, where it stands and as far as it is to be done."""
        if self.weight == 0:
            return
        plan.enter(self.deformer_from_mesh)
        if self.weight == 1 and self.mask is None and self.reach == math.inf:
            self.act(plan)
            return
        mirrored = plan.mirrored
        plan.keep()
        self.act(plan)
        plan.mix(float(self.weight), self.mask, float(self.reach))
        # A mirror image less than half done is not one yet
        if self.weight <= 1 / 2:
            plan.mirrored = mirrored

    @abstractmethod
    def act(self, plan: Plan) -> None:
        """Add to a plan what it does in its own frame, wholly."""

    @property
    def deformer_from_mesh(self) -> FloatArray:
        """(4, 4) its frame: y along the axis, turned there the short way round."""
        if self.frame is not None:
            return np.asarray(self.frame, np.float64)
        x, y, z = np.asarray(self.axis, np.float64) / np.sqrt(np.square(self.axis).sum())
        matrix = transform.identity()
        if y > -1:
            f = 1 / (1 + y)
            matrix[:3, :3] = [[1 - f * x * x, -x, -f * x * z], [x, y, z], [-f * x * z, -z, 1 - f * z * z]]
        else:
            matrix[1, 1] = matrix[2, 2] = -1
        if self.towards:
            s, c = math.sin(self.towards), math.cos(self.towards)
            turn = np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]])
            matrix[:3, :3] = transform.product(turn, matrix[:3, :3])
        matrix[:3, 3] = -(matrix[:3, :3] * np.asarray(self.origin, np.float64)).sum(axis=1)
        return matrix
