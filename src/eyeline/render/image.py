"""A finished picture, and how it is kept."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from eyeline.errors import FileError, GeometryError
from eyeline.files.png import png_of
from eyeline.files.whole import whole_file
from eyeline.geometry.arrays import ByteArray

if TYPE_CHECKING:
    import PIL.Image

FORMATS: dict[str, tuple[str, dict[str, Any]]] = {
    ".png": ("PNG", {}),
    ".jpg": ("JPEG", {"quality": 92, "subsampling": 0}),
    ".jpeg": ("JPEG", {"quality": 92, "subsampling": 0}),
    ".webp": ("WEBP", {"quality": 90, "method": 4}),
}  # suffix -> its name, and Pillow's options


@dataclass(frozen=True, eq=False)
class Image:
    """A picture: sRGB, alpha last and not multiplied into the colours."""

    pixels: ByteArray  # (H, W, 4) uint8

    def __post_init__(self) -> None:
        """Refuse what is not an RGBA picture."""
        shape = self.pixels.shape
        if len(shape) != 3 or shape[2] != 4 or 0 in shape or self.pixels.dtype != np.uint8:
            raise GeometryError(f"pixels are {self.pixels.dtype} {shape}; uint8 (H, W, 4) is needed")

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) in pixels."""
        return self.pixels.shape[1], self.pixels.shape[0]

    @property
    def is_opaque(self) -> bool:
        """Whether nothing shines through."""
        return bool((self.pixels[..., 3] == 255).all())

    @property
    def opaque(self) -> ByteArray:
        """(H, W, 3) on white paper, for files that know no transparency."""
        color, alpha = self.pixels[..., :3], self.pixels[..., 3:]
        if self.is_opaque:
            return np.ascontiguousarray(color)
        opacity = alpha / 255
        shown: ByteArray = (color * opacity + 255 * (1 - opacity) + 0.5).astype(np.uint8)
        return shown

    def save(self, path: str | Path) -> Path:
        """Write a .png, .jpg or .webp; the file appears whole or not at all."""
        path = Path(path)
        if path.suffix.lower() not in FORMATS:
            raise FileError(f"{path}: {path.suffix or 'no suffix'} is no picture; use {', '.join(FORMATS)}")
        format_name, options = FORMATS[path.suffix.lower()]
        with whole_file(path) as unfinished:
            if format_name == "PNG":
                unfinished.write_bytes(self._repr_png_())
            else:
                self._pillow(format_name == "JPEG").save(unfinished, format_name, **options)
        return path

    def _repr_png_(self) -> bytes:
        return png_of(self.opaque if self.is_opaque else self.pixels)

    def _pillow(self, without_alpha: bool) -> PIL.Image.Image:
        import PIL.Image

        return PIL.Image.fromarray(self.opaque if without_alpha or self.is_opaque else self.pixels)
