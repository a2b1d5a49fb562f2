"""Properties that are computed once, at their first use, without a lock."""

from __future__ import annotations

import functools
from typing import Any, TypeVar, overload

Value = TypeVar("Value", covariant=True)


class cached_property(functools.cached_property[Value]):  # noqa: N801  the name of what it stands for
    """A property whose value is computed at its first use and kept with its object.

    Until Python 3.12 the one of functools lets one thread at a time compute, for all objects of a class:
    strips of a picture would wait for each other, and whoever shares work among threads could wait for one
    that waits for him. Here two threads may compute at once; both find the same, and one value is kept.
    """

    @overload
    def __get__(self, thing: None, owner: type[Any] | None = None) -> cached_property[Value]: ...
    @overload
    def __get__(self, thing: object, owner: type[Any] | None = None) -> Value: ...
    def __get__(self, thing: object, owner: type[Any] | None = None) -> cached_property[Value] | Value:
        """The value; from then on Python finds it with the object, and does not ask here."""
        if thing is None:
            return self
        value: Value = vars(thing).setdefault(self.func.__name__, self.func(thing))
        return value
