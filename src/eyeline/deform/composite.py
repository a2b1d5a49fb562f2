"""Deformers in order, or side by side, as one: all of it is done in one pass over the points."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

import numpy.typing as npt

from eyeline.deform.block import Work
from eyeline.deform.deformer import Deformer
from eyeline.deform.plan import Plan
from eyeline.errors import GeometryError
from eyeline.geometry.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Composite(Deformer):
    """Deformers one after another: each moves what the one before it left.

    A composite is a deformer: it stands in others, with its own weight and mask, and its parts count their
    places from its place. Parts are called by their names, which differ.
    """

    kind: ClassVar[str] = "composite"

    parts: tuple[Deformer, ...] = ()

    @classmethod
    def of(cls, *parts: Deformer, **common: Any) -> Self:
        """These parts in order; `common` is what all deformers have: name, weight, origin, axis ..."""
        return cls(parts, **common)

    def __post_init__(self) -> None:
        """Refuse parts of one name."""
        super().__post_init__()
        labels = [part.label for part in self.parts]
        for label in labels:
            if labels.count(label) > 1:
                raise GeometryError(f"{labels.count(label)} deformers are called {label!r}; name them apart")

    @property
    def parameters(self) -> dict[str, FloatArray]:
        """Its own numbers, and those of its parts as part.number."""
        found = self.numbers()
        for part in self.parts:
            found |= {f"{part.label}.{name}": value for name, value in part.parameters.items()}
        return found

    def changed(self, values: Mapping[str, npt.ArrayLike]) -> Self:
        """This composite with other numbers: {"bend.angle": 1.2}."""
        own = {name: value for name, value in values.items() if "." not in name}
        theirs: dict[str, dict[str, npt.ArrayLike]] = {}
        for path, value in values.items():
            label, dot, name = path.partition(".")
            if dot:
                theirs.setdefault(label, {})[name] = value
        labels = [part.label for part in self.parts]
        for label in theirs:
            if label not in labels:
                raise GeometryError(f"there is no deformer {label!r}; there are {', '.join(labels)}")
        parts = tuple(
            part.changed(theirs[part.label]) if part.label in theirs else part for part in self.parts
        )
        return replace(super().changed(own), parts=parts)

    def act(self, plan: Plan) -> None:
        """Part after part, from its own frame and back to it."""
        root, plan.root = plan.root, plan.frame
        for part in self.parts:
            part.join(plan)
        plan.go(plan.root)
        plan.root = root


@dataclass(frozen=True, eq=False)
class Mixture(Composite):
    """Deformers side by side: each moves the points as they come, and their moves add up."""

    kind: ClassVar[str] = "mixture"

    def act(self, plan: Plan) -> None:
        """Each part from the points as they came; the differences are summed."""
        root, plan.root = plan.root, plan.frame
        plan.keep()
        plan.keep()
        for part in self.parts:
            plan.do(begin_anew)
            part.join(plan)
            plan.go(plan.root)
            plan.do(add_up)
        plan.do(take_sum)
        plan.root = root


def begin_anew(work: Work) -> None:
    """Back to the points as they came: the last but one of those kept; the last is the sum."""
    work.state[:] = work.kept[-2]


def add_up(work: Work) -> None:
    """Add to the sum by how much the points were moved."""
    work.kept[-1] += work.state - work.kept[-2]


def take_sum(work: Work) -> None:
    """Go on with the sum."""
    work.state[:] = work.kept.pop()
    work.kept.pop()
