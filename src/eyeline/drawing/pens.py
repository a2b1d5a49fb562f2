"""What lines are drawn with: outlines heavier than what lies inside them, hidden lines fine and dashed."""

from __future__ import annotations

from dataclasses import dataclass

PICTURE_HEIGHT = 720  # pixels, at which widths are meant; larger pictures have wider lines


@dataclass(frozen=True)
class Pen:
    """A round tip."""

    width: float  # pixels
    colour: str  # sRGB, #rrggbb
    dash: tuple[float, ...] = ()  # pixels drawn, pixels left out, by turns; none: without a gap

    def scaled(self, factor: float) -> Pen:
        """This pen for a picture so many times as large."""
        return Pen(self.width * factor, self.colour, tuple(length * factor for length in self.dash))


VISIBLE = {
    "outline": Pen(2.1, "#14161a"),
    "boundary": Pen(1.7, "#14161a"),
    "intersection": Pen(1.2, "#14161a"),
    "crease": Pen(1.0, "#14161a"),
    "mesh": Pen(0.45, "#6b7078"),
}  # kind -> its pen
HIDDEN = {
    "outline": Pen(1.0, "#8a9099", (5.0, 4.0)),
    "boundary": Pen(1.0, "#8a9099", (5.0, 4.0)),
    "intersection": Pen(0.8, "#8a9099", (4.0, 3.5)),
    "crease": Pen(0.8, "#8a9099", (4.0, 3.5)),
    "mesh": Pen(0.35, "#b4b8bf", (2.5, 2.5)),
}  # kind -> its pen where something stands before it
UNDER = ("mesh", "crease", "intersection", "boundary", "outline")  # the heaviest pen draws last
