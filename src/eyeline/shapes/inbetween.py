"""What every in-between offers, the ways there are, and the call that makes one."""

from __future__ import annotations

from dataclasses import fields
from importlib import import_module
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, cast

from eyeline.errors import OptionError

if TYPE_CHECKING:
    from eyeline.scene.mesh import Mesh
    from eyeline.scene.scene import Scene


class Inbetween(Protocol):
    """All meshes from one to another: prepared once, asked for at any part of the way, in any order."""

    def at(self, part: float) -> Mesh:
        """The mesh at a part of the way: 0 is the start, 1 the end."""


class Way(NamedTuple):
    """A way from shape to shape: the class that goes it, and whether both meshes must have the same faces."""

    module: str
    made_by: str
    same_faces: bool

    def __call__(self, start: Mesh | Scene, end: Mesh | Scene, **options: Any) -> Inbetween:
        """The in-between of two shapes. Refused: an option the way does not have."""
        make = getattr(import_module(self.module), self.made_by)
        known = {field.name for field in fields(make)} - {"start", "end"}
        for name in options.keys() - known:
            offered = f"it has {', '.join(sorted(known))}" if known else "it has none"
            raise OptionError(f"{self.made_by} has no option {name!r}; {offered}")
        return cast("Inbetween", make(start, end, **options))


WAYS: dict[str, Way] = {
    "linear": Way("eyeline.shapes.linear", "Linear", same_faces=True),
    "rigid": Way("eyeline.shapes.rigid", "Rigid", same_faces=True),
    "level_set": Way("eyeline.shapes.level_set", "LevelSet", same_faces=False),
}


def inbetween(start: Mesh | Scene, end: Mesh | Scene, way: str = "linear", **options: Any) -> Inbetween:
    """All shapes between two: `.at(0.5)` is the one half way.

    start, end: meshes, or scenes: all that is visible in one, as one shape. way: "linear", each vertex goes
    straight, or "rigid", turns stay turns, between meshes of the same faces, both with `.sample(parts)` for
    the points alone; "level_set" between any closed bodies, with cells=128, align="none" | "centre" | "box",
    and `.error`, measured. Slow in and slow out: `.at(ease(part))`.
    """
    if way not in WAYS:
        raise OptionError(f"there is no way {way!r}; there is {', '.join(WAYS)}")
    return WAYS[way](start, end, **options)
