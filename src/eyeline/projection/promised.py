"""A picture whose arrays are made when somebody asks for them: who needs none of them waits for none."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from eyeline.projection.projected import Projected

LATER = ("xy", "depth", "faces", "sides", "piece_source")  # what is made at the first question


class Promised(Projected):
    """What a camera sees of surfaces as they stand, every one of them by `cull`.

    It is a Projected in every respect. What is changed in it by `replace` or `only` is no promise any more.
    """

    @classmethod
    def of(cls, make: Callable[[], Projected], cull: str, **known: Any) -> Promised:
        """The picture that `make` gives, when it must, and whose other values are known now."""
        picture = object.__new__(cls)
        vars(picture).update(known, _make=make, _cull=cull)
        return picture

    def __getattr__(self, name: str) -> Any:
        """Make the arrays; from then on Python finds them with the object, and does not ask here."""
        if name not in LATER or "_make" not in vars(self):
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
        made = vars(self)["_make"]()
        vars(self).update({one: getattr(made, one) for one in LATER})
        return vars(self)[name]

    @property
    def standing_by(self) -> str | None:
        """How its surfaces are culled; None once something in it was changed."""
        cull: str | None = vars(self).get("_cull")
        return cull

    def shifted(self, dx: int, dy: int) -> Projected:
        """The same picture sampled dx, dy (1/256 pixel) beside the pixels' centres: a promise again."""
        if self.standing_by is None:
            return super().shifted(dx, dy)
        known = {name: value for name, value in vars(self).items() if name not in (*LATER, "_make", "_cull")}
        shift = self.shift[0] + dx, self.shift[1] + dy
        later = super().shifted
        return Promised.of(lambda: later(dx, dy), self.standing_by, **{**known, "shift": shift})
