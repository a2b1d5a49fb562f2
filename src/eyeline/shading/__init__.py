"""Projected, Visible and Scene to pixels. Knows colours and light; never decides what is seen."""

from eyeline.shading.look import Look
from eyeline.shading.picture import shade
from eyeline.shading.styles import STYLES

__all__ = ["STYLES", "Look", "shade"]
