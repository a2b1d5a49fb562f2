"""One object of a file's JSON, read with its place at hand: whatever is asked of it is checked.

So every sentence that refuses a value names where it stands: "accessors[3].count is -1; ..."
"""

from __future__ import annotations

import math
import reprlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from eyeline.errors import FileError
from eyeline.files.limits import LARGEST

LONGEST_SPOKEN = 80  # characters; the longest number that JSON may hold is shorter

_short = reprlib.Repr()
_short.maxstring = _short.maxother = _short.maxlong = 60


def spoken(value: Any) -> str:
    """A value of the file as a sentence shows it: short, on one line."""
    text = _short.repr(value)
    if len(text) <= LONGEST_SPOKEN:
        return text
    return f"{'a list' if isinstance(value, list) else 'an object'} of {len(value)}"


@dataclass(frozen=True)
class Part:
    """A JSON object, and where it stands in the file."""

    place: str
    values: Mapping[str, Any]

    def at(self, key: str) -> str:
        """The place of one of its values."""
        return f"{self.place}.{key}" if self.place else key

    def has(self, key: str) -> bool:
        """Whether a value is given."""
        return self.values.get(key) is not None

    def refuse(self, key: str, needed: str) -> FileError:
        """The error that says what a value is, and what it must be."""
        if not self.has(key):
            return FileError(f"{self.at(key)} is missing; {needed}")
        return FileError(f"{self.at(key)} is {spoken(self.values[key])}; {needed}")

    # --- numbers ----------------------------------------------------------------------------------------

    def whole(self, key: str, default: int | None = None, low: int = 0) -> int:
        """A whole number from `low`; required if there is no default."""
        value = self.values.get(key)
        if value is None and default is not None:
            return default
        if isinstance(value, float) and value.is_integer():
            value = int(value)
        if not isinstance(value, int) or isinstance(value, bool) or value < low or value >= 2**53:
            raise self.refuse(key, f"a whole number from {low} is needed")
        return value

    def link(self, key: str) -> int | None:
        """The number of something else in the file, or None."""
        return self.whole(key) if self.has(key) else None

    def wholes(self, key: str) -> list[int]:
        """A list of whole numbers from 0; empty where absent."""
        values = self.listed(key)
        for value in values:
            if not isinstance(value, int) or isinstance(value, bool) or not 0 <= value < 2**53:
                raise self.refuse(key, "a list of whole numbers from 0 is needed")
        return list(values)

    def number(self, key: str, default: float | None = None) -> float:
        """A number; required if there is no default."""
        value = self.values.get(key)
        if value is None and default is not None:
            return default
        if value is None or not _is_number(value):
            raise self.refuse(key, f"a number of at most {LARGEST:g} is needed")
        return float(value)

    def distance(self, key: str) -> float | None:
        """A distance of more than 0; None where absent, or farther than anything is."""
        value = self.values.get(key)
        if value is None or (isinstance(value, float) and value > LARGEST):
            return None
        if not _is_number(value) or value <= 0:
            raise self.refuse(key, "a distance of more than 0 is needed")
        return float(value)

    def ranged(self, key: str, default: float, low: float, high: float = math.inf) -> float:
        """A number from `low` to `high`."""
        value = self.number(key, default)
        if not low <= value <= high:
            raise self.refuse(
                key, f"a number from {low:g}{'' if math.isinf(high) else f' to {high:g}'} is needed"
            )
        return value

    def numbers(self, key: str, default: Sequence[float]) -> tuple[float, ...]:
        """As many numbers as the default has; the default where absent."""
        if not self.has(key):
            return tuple(default)
        values = self.listed(key)
        if len(values) != len(default) or not all(map(_is_number, values)):
            raise self.refuse(key, f"{len(default)} numbers of at most {LARGEST:g} are needed")
        return tuple(map(float, values))

    # --- words ------------------------------------------------------------------------------------------

    def text(self, key: str, default: str | None = None) -> str:
        """A text; required if there is no default."""
        value = self.values.get(key)
        if value is None and default is not None:
            return default
        if not isinstance(value, str):
            raise self.refuse(key, "a text is needed")
        return value

    def name(self, otherwise: str = "") -> str:
        """What it is called; a name that cannot be printed is given in escapes."""
        name = self.text("name", "") or otherwise
        return name if name.isprintable() else name.encode("unicode_escape").decode("ascii")

    def choice(self, key: str, known: Sequence[str], default: str | None = None) -> str:
        """One of the known words."""
        value = self.text(key, default)
        if value not in known:
            raise self.refuse(key, f"{' or '.join(known)} is needed")
        return value

    def flag(self, key: str) -> bool:
        """True or false; false where absent."""
        value = self.values.get(key, False)
        if not isinstance(value, bool):
            raise self.refuse(key, "true or false is needed")
        return value

    # --- other parts ------------------------------------------------------------------------------------

    def listed(self, key: str) -> list[Any]:
        """A list of anything; empty where absent."""
        value = self.values.get(key)
        if value is None:
            return []
        if not isinstance(value, list):
            raise self.refuse(key, "a list is needed")
        return value

    def part(self, key: str) -> Part:
        """An object in this one; empty where absent."""
        value = self.values.get(key)
        if value is None:
            return Part(self.at(key), {})
        if not isinstance(value, dict):
            raise self.refuse(key, "an object is needed")
        return Part(self.at(key), value)

    def parts(self, key: str) -> tuple[Part, ...]:
        """A list of objects in this one; empty where absent."""
        found = []
        for index, value in enumerate(self.listed(key)):
            if not isinstance(value, dict):
                raise FileError(f"{self.at(key)}[{index}] is {spoken(value)}; an object is needed")
            found.append(Part(f"{self.at(key)}[{index}]", value))
        return tuple(found)

    def extension(self, name: str) -> Part | None:
        """What an extension says here, or None."""
        extensions = self.part("extensions")
        return extensions.part(name) if extensions.has(name) else None


def _is_number(value: Any) -> bool:
    """Whether a value is a number that scenes are made of."""
    return not isinstance(value, bool) and isinstance(value, (int, float)) and abs(value) <= LARGEST
