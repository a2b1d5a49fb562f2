"""The ways to draw: STYLES, name -> Style. One file a style; a new one is one line here."""

from __future__ import annotations

from eyeline.shading.style import Style
from eyeline.shading.styles.depth import Depth
from eyeline.shading.styles.id import Id
from eyeline.shading.styles.normal import Normal
from eyeline.shading.styles.shaded import Shaded
from eyeline.shading.styles.toon import Toon
from eyeline.shading.styles.traced import Traced
from eyeline.shading.styles.wire import Wire
from eyeline.shading.styles.xray import XRay

STYLES: dict[str, Style] = {
    style.name: style
    for style in (
        Shaded(),
        Shaded("flat", faceted=True),
        Traced(),
        Toon(),
        Wire(),
        XRay(),
        Depth(),
        Normal(),
        Id(),
    )
}
