"""Names that tell things apart."""

from __future__ import annotations

from collections.abc import Iterable


def unique(names: Iterable[str], taken: Iterable[str] = ()) -> tuple[str, ...]:
    """The names in their order; one that is taken already gets '.1', '.2' ..."""
    used = set(taken)
    counts: dict[str, int] = {}
    made = []
    for own in names:
        name = own
        while name in used:
            counts[own] = counts.get(own, 0) + 1
            name = f"{own}.{counts[own]}"
        used.add(name)
        made.append(name)
    return tuple(made)
