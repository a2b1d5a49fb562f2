"""Visible-surface detection: one question, several answers, one file a method."""

from __future__ import annotations

import importlib
from collections.abc import Iterator, Mapping
from typing import cast

from eyeline.errors import OptionError, suggestion
from eyeline.projection.projected import Projected
from eyeline.visibility.area import Area
from eyeline.visibility.method import Method, PixelMethod, Step, Visible
from eyeline.visibility.visible_edges import VisibleEdges

HOMES = {
    "zbuffer": "ZBuffer",
    "backface": "BackFace",
    "painter": "Painter",
    "roberts": "Roberts",
    "warnock": "Warnock",
    "octree": "Octree",
    "scanline": "ScanLine",
    "raycast": "RayCast",
}  # a method's name, which is its module's, -> its class there

__all__ = [
    "METHODS",
    "Area",
    "Method",
    "PixelMethod",
    "Step",
    "Visible",
    "VisibleEdges",
    "method_named",
    "visible_of",
]


class MethodTable(Mapping[str, Method]):
    """Every method by its name, imported when it is first asked for: a picture needs one of them."""

    def __init__(self, homes: Mapping[str, str]) -> None:
        self._homes = homes
        self._made: dict[str, Method] = {}

    def __getitem__(self, name: str) -> Method:
        """The method of this name, with its usual parameters."""
        if name not in self._made:
            made = self._homes[name]
            self._made[name] = getattr(importlib.import_module(f"{__name__}.{name}"), made)()
        return self._made[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._homes)

    def __len__(self) -> int:
        return len(self._homes)


METHODS: Mapping[str, Method] = MethodTable(HOMES)


def method_named(name: str) -> PixelMethod:
    """The method of this name, if it answers every pixel of every scene."""
    if name not in METHODS or not METHODS[name].answers:
        answering = [one for one, method in METHODS.items() if method.answers]
        raise OptionError(f"there is no method {name!r} that answers alone{suggestion(name, answering)}")
    return cast(PixelMethod, METHODS[name])


def visible_of(projected: Projected, method: str = "zbuffer") -> Visible:
    """What is seen of a projected scene, by the method of this name."""
    return method_named(method)(projected)
