"""The ways to draw: STYLES, name -> Style. One file a style; a new one is one line here."""

from __future__ import annotations

from eyeline.shading.style import Style
from eyeline.shading.styles.shaded import Shaded

STYLES: dict[str, Style] = {style.name: style for style in (Shaded(), Shaded("flat", faceted=True))}
