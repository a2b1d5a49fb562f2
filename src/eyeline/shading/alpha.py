"""Which faces are solid, which have holes, and which let light through. [glTF 2.0, 3.9.4]"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from eyeline.geometry.arrays import BoolArray, FloatArray
from eyeline.scene.material import AlphaMode, Material
from eyeline.scene.surface import Surface


def has(surfaces: Sequence[Surface], mode: AlphaMode) -> bool:
    """Whether any material of any surface has this alpha mode."""
    meshes = {id(surface.mesh): surface.mesh for surface in surfaces}.values()
    return any(material.alpha_mode == mode for mesh in meshes for material in mesh.materials)


def faces_of(surfaces: Sequence[Surface], mode: AlphaMode) -> BoolArray:
    """(F,) which scene faces have a material of this alpha mode."""
    return _of_each_face(surfaces, lambda material: material.alpha_mode == mode, np.bool_)


def cutoffs_of(surfaces: Sequence[Surface]) -> FloatArray:
    """(F,) float32: at less alpha than this, a face of mode "mask" has a hole; 0 for all others."""
    return _of_each_face(
        surfaces, lambda material: material.alpha_cutoff if material.alpha_mode == "mask" else 0.0, np.float32
    )


def _of_each_face(
    surfaces: Sequence[Surface], told: Callable[[Material], object], kind: type
) -> npt.NDArray[Any]:
    """(F,) what a material tells, for each scene face."""
    columns = []
    for surface in surfaces:
        mesh = surface.mesh
        values: npt.NDArray[Any] = np.array([told(material) for material in mesh.materials], kind)
        if mesh.face_material is None:
            columns.append(np.broadcast_to(values[:1], len(mesh.faces)))
        else:
            columns.append(values[mesh.face_material])
    return np.concatenate(columns) if columns else np.empty(0, kind)
