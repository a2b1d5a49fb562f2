"""Attributes of vertices: which are read, and of what types they may be. [glTF 2.0, 3.7.2.1]"""

from __future__ import annotations

from collections.abc import Iterable

TYPES: dict[str, tuple[str, ...]] = {
    "POSITION": ("VEC3",),
    "NORMAL": ("VEC3",),
    "TANGENT": ("VEC4",),
    "TEXCOORD": ("VEC2",),
    "COLOR": ("VEC3", "VEC4"),
    "JOINTS": ("VEC4",),
    "WEIGHTS": ("VEC4",),
}
UV_SETS = 2


def read_names(names: Iterable[str]) -> list[str]:
    """Those of the attributes that are read: two UV sets, one colour, all joints and weights in order."""
    found = []
    for name in sorted(names):
        kind, _, number = name.partition("_")
        single = kind in ("POSITION", "NORMAL", "TANGENT") and not number
        numbered = kind in TYPES and number.isascii() and number.isdigit()
        limit = {"TEXCOORD": UV_SETS, "COLOR": 1}.get(kind, 16)
        if single or (numbered and len(number) < 3 and int(number) < limit):
            found.append(name)
    return found
