"""What makes an edge worth a line."""

from __future__ import annotations

from collections.abc import Iterable

from eyeline.errors import OptionError

OUTLINE, BOUNDARY, CREASE, INTERSECTION, MESH = 1, 2, 3, 4, 5

KINDS = ("outline", "boundary", "crease", "intersection", "mesh")  # by number, from 1
USUAL = KINDS[:4]  # what is drawn if nobody says


def checked_kinds(edges: Iterable[str]) -> tuple[str, ...]:
    """The names of some kinds in the order of KINDS, each once. Refused: none, and unknown ones."""
    names = [edges] if isinstance(edges, str) else list(edges)
    for name in names:
        if name not in KINDS:
            raise OptionError(f"there is no kind of edge {name!r}; there is {', '.join(map(repr, KINDS))}")
    if not names:
        raise OptionError(f"edges is empty; name at least one of {', '.join(map(repr, KINDS))}")
    return tuple(kind for kind in KINDS if kind in names)
