"""Every deformer by its name."""

from __future__ import annotations

from collections.abc import Mapping

from eyeline.deform.bend import Bend
from eyeline.deform.composite import Composite, Mixture
from eyeline.deform.deformer import Deformer
from eyeline.deform.inflate import Inflate
from eyeline.deform.lattice import Lattice
from eyeline.deform.rigid import Reflection, Rotation, Translation
from eyeline.deform.shear import Shear
from eyeline.deform.spherify import Spherify
from eyeline.deform.stretch import Stretch
from eyeline.deform.taper import Taper
from eyeline.deform.twist import Twist
from eyeline.deform.wave import Wave

DEFORMERS: Mapping[str, type[Deformer]] = {
    one.kind: one
    for one in (
        Translation, Rotation, Reflection, Shear, Taper, Twist, Bend, Stretch, Inflate, Spherify, Wave,
        Lattice, Composite, Mixture,
    )
}  # fmt: skip
