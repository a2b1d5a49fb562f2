"""What a scene asks of a constraint, so that the nouns need not know how poses are solved."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Protocol

from eyeline.geometry.arrays import FloatArray

if TYPE_CHECKING:
    from eyeline.scene.pose import Samples


class Constraint(Protocol):
    """A rule that places nodes after the tracks have: a frozen dataclass whose numbers tracks can move."""

    @property
    def name(self) -> str:
        """What it is called, for people and for tracks; one of its kind in a scene."""

    def __call__(self, pose: Samples, moved: Mapping[str, FloatArray]) -> Samples:
        """The pose with the rule kept, at all T times in one batch; what it leaves alone stays as it is.

        moved: its own numbers that tracks move, by name, (T, ...); the others are its fields.
        """
