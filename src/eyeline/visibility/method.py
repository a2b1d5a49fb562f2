"""What every visible-surface method takes, answers and counts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from eyeline.errors import SceneError
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.projection.projected import Projected
from eyeline.scene.scene import Scene


@dataclass(frozen=True)
class Step:
    """One event of a method at work: what it did, in a sentence, with the numbers it did it with."""

    kind: str
    sentence: str
    data: Mapping[str, Any]
    work: Mapping[str, int]  # the counters so far


class Method(Protocol):
    """A visible-surface algorithm: a frozen object with its parameters."""

    @property
    def name(self) -> str:
        """Its key in METHODS."""

    @property
    def space(self) -> str:
        """'object' or 'image': where it decides."""

    @property
    def answers(self) -> bool:
        """Whether it answers every scene alone, or only filters faces for others."""

    def __call__(self, projected: Projected) -> Visible:
        """What is seen at every pixel."""

    def steps(self, projected: Projected) -> Iterator[Step]:
        """The same decisions one by one, for reading: plain Python, small scenes."""


@dataclass(frozen=True)
class Area:
    """How much of a node is seen."""

    pixels: int  # where it is seen
    unoccluded_pixels: int  # where it would be seen with nothing else there
    occluders: Mapping[str, int]  # path of a node -> pixels of this one that it hides

    @property
    def fraction(self) -> float:
        """The seen part of what could be seen, 0..1; 0 if it is out of the picture."""
        return self.pixels / self.unoccluded_pixels if self.unoccluded_pixels else 0.0


@dataclass(frozen=True, eq=False)
class Visible:
    """A method's answer: the face and the depth at every pixel."""

    face: IntArray  # (H, W) int32: scene face; -1 is background
    depth: FloatArray  # (H, W) float32, reversed; 0 is background
    projected: Projected
    method: Method
    work: Mapping[str, int]  # counters
    scene: Scene | None = None  # for node names
