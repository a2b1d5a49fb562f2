"""How a picture shall look: the style, the backdrop, and how much of each effect."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from eyeline.errors import OptionError
from eyeline.scene.material import Colour

Ground = Literal["auto", "on", "off"]
Tone = Literal["neutral", "none"]


@dataclass(frozen=True)
class Look:
    """Everything about a picture that is neither the scene nor the camera.

    style: a name in STYLES. background: "studio" (a soft gradient), "transparent", or a linear colour.
    ground: the studio floor that takes the shadow; "auto": where the scene has no light of its own and
    the background is "studio". ground_height: of that floor, metres; None is the lowest point there is.
    exposure: stops, each doubles the light. tone: "neutral" rolls highlights off
    and keeps colours below them; "none" clips.
    """

    style: str = "shaded"
    background: Literal["studio", "transparent"] | Colour = "studio"
    ground: Ground = "auto"
    ground_height: float | None = None
    exposure: float = 0.0
    tone: Tone = "neutral"
    shadows: bool = True
    occlusion: float = 1.0  # how much creases darken, 0 off .. 1

    def __post_init__(self) -> None:
        """Refuse what no picture can show."""
        if not math.isfinite(self.exposure):
            raise OptionError(f"exposure is {self.exposure}; a finite number of stops is needed")
        if self.ground_height is not None and not math.isfinite(self.ground_height):
            raise OptionError(f"ground_height is {self.ground_height}; a finite number of metres is needed")
        if not 0 <= self.occlusion <= 1:
            raise OptionError(f"occlusion is {self.occlusion}; 0 to 1 is needed")
        if self.ground not in ("auto", "on", "off"):
            raise OptionError(f"ground is {self.ground!r}; auto, on or off is needed")
        if self.tone not in ("neutral", "none"):
            raise OptionError(f"tone is {self.tone!r}; neutral or none is needed")
        known = self.background in ("studio", "transparent") or (
            isinstance(self.background, tuple) and len(self.background) == 3
        )
        if not known:
            raise OptionError(
                f"background is {self.background!r}; studio, transparent or (red, green, blue) is needed"
            )
