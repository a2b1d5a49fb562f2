"""What every style takes and gives: one frame of a scene in, one picture out."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from eyeline.geometry.arrays import ByteArray

if TYPE_CHECKING:
    from eyeline.shading.frame import Frame


class Style(Protocol):
    """A way to draw what is seen: a frozen object with its parameters."""

    @property
    def name(self) -> str:
        """Its key in STYLES."""

    @property
    def lit(self) -> bool:
        """Whether lights, shadows and the studio ground play a part."""

    @property
    def see_through(self) -> bool:
        """Whether blended surfaces let light through; otherwise they are drawn as solid."""

    def __call__(self, frame: Frame) -> ByteArray:
        """The picture (H, W, 4), straight alpha, sRGB.

        Most styles are three steps: take `frame.points`, give each a colour (K, 4), and
        `frame.resolve` them.
        """
