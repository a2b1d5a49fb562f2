"""What is seen, and how it shall look, to pixels."""

from __future__ import annotations

from collections.abc import Sequence

from eyeline.errors import OptionError, suggestion
from eyeline.geometry.arrays import ByteArray
from eyeline.projection.projected import Projected
from eyeline.scene.scene import Scene
from eyeline.shading.frame import Frame
from eyeline.shading.look import Look
from eyeline.shading.styles import STYLES
from eyeline.visibility.method import Visible


def shade(
    scene: Scene, projected: Projected, visibles: Sequence[tuple[Visible, int, int]], look: Look
) -> ByteArray:
    """The picture (H, W, 4) uint8, sRGB, straight alpha.

    visibles: what is seen at each antialiasing sample, and the sample's shift, 1/256 pixel, each made
    of `projected.shifted(dx, dy)`.
    """
    if look.style not in STYLES:
        raise OptionError(f"there is no style {look.style!r}{suggestion(look.style, STYLES)}")
    return STYLES[look.style](Frame(scene, projected, visibles, look))
