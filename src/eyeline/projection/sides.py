"""Which sides of faces count: what is culled, what is mirrored, what is hidden."""

from __future__ import annotations

import numpy as np

from eyeline.errors import OptionError
from eyeline.geometry.arrays import ByteArray
from eyeline.projection.projected import CLOCKWISE, COUNTER_CLOCKWISE
from eyeline.scene.surface import Surface

CULLS = ("auto", "back", "none")


def sides_of(surface: Surface, cull: str) -> int | ByteArray:
    """The sides of a surface's faces that count: one number for all, or (F,) where its materials differ.

    cull: "auto" drops the backs of single-sided materials, "back" all backs, "none" nothing.
    """
    if not surface.visible:
        return 0
    front, both = (CLOCKWISE if surface.mirrored else COUNTER_CLOCKWISE), CLOCKWISE | COUNTER_CLOCKWISE
    if cull != "auto":
        return front if cull == "back" else both
    mesh = surface.mesh
    of_material = np.array([both if one.double_sided else front for one in mesh.materials], dtype=np.uint8)
    if mesh.face_material is None or (of_material == of_material[0]).all():
        return int(of_material[0])
    return of_material[mesh.face_material]


def joined(parts: list[int | ByteArray], counts: list[int]) -> ByteArray:
    """The sides of all faces, surface after surface: (1,) where all are the same, else (F,)."""
    single = {part if isinstance(part, int) else -1 for part in parts}
    if len(single) <= 1 and -1 not in single:
        return np.array([single.pop() if single else 0], dtype=np.uint8)
    filled = [
        np.full(count, part, np.uint8) if isinstance(part, int) else part
        for part, count in zip(parts, counts, strict=True)
    ]
    return np.concatenate(filled)


def checked_cull(cull: str) -> str:
    """`cull`, if there is such a choice."""
    if cull not in CULLS:
        raise OptionError(f"cull is {cull!r}; there is {', '.join(map(repr, CULLS))}")
    return cull
