"""Pictures and films of scenes; the package itself can be called: `eyeline.render(scene)` is one picture."""

from __future__ import annotations

import sys
from types import ModuleType

from eyeline.render.frame import render


class _Package(ModuleType):
    """`eyeline.render` is a function to its users and the name of this folder to Python; it serves both."""

    __call__ = staticmethod(render)


sys.modules[__name__].__class__ = _Package
