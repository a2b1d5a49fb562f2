"""Visible-surface detection: one question, several answers, one file a method."""

from __future__ import annotations

from eyeline.errors import OptionError
from eyeline.projection.projected import Projected
from eyeline.scene.scene import suggestion
from eyeline.visibility.area import Area
from eyeline.visibility.backface import BackFace
from eyeline.visibility.method import Method, Step, Visible
from eyeline.visibility.zbuffer import ZBuffer

METHODS: dict[str, Method] = {method.name: method for method in (ZBuffer(), BackFace())}

__all__ = ["METHODS", "Area", "Method", "Step", "Visible", "method_named", "visible_of"]


def method_named(name: str) -> Method:
    """The method of this name, if it answers alone."""
    answering = [one for one, method in METHODS.items() if method.answers]
    if name not in answering:
        raise OptionError(f"there is no method {name!r} that answers alone{suggestion(name, answering)}")
    return METHODS[name]


def visible_of(projected: Projected, method: str = "zbuffer") -> Visible:
    """What is seen of a projected scene, by the method of this name."""
    return method_named(method)(projected)
