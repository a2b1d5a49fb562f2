"""Deformers: points in, points out; one a file, and each by its name here: `eyeline.deform.Twist`.

Names are imported when they are first used: skinning needs none of them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from eyeline.deform.bend import Bend
    from eyeline.deform.composite import Composite, Mixture
    from eyeline.deform.deformer import Deformer
    from eyeline.deform.inflate import Inflate
    from eyeline.deform.lattice import Lattice
    from eyeline.deform.rigid import Reflection, Rotation, Translation
    from eyeline.deform.shear import Shear
    from eyeline.deform.spherify import Spherify
    from eyeline.deform.stretch import Stretch
    from eyeline.deform.table import DEFORMERS
    from eyeline.deform.taper import Taper
    from eyeline.deform.twist import Twist
    from eyeline.deform.wave import Wave

__all__ = [
    "DEFORMERS",
    "Bend",
    "Composite",
    "Deformer",
    "Inflate",
    "Lattice",
    "Mixture",
    "Reflection",
    "Rotation",
    "Shear",
    "Spherify",
    "Stretch",
    "Taper",
    "Translation",
    "Twist",
    "Wave",
]


def __getattr__(name: str) -> Any:
    """A deformer's class, or their table, imported at its first use."""
    if name not in __all__:
        raise AttributeError(f"module 'eyeline.deform' has no attribute {name!r}")
    from eyeline.deform import table

    return getattr(table, name)
