"""Painter's algorithm: faces from back to front, ordered by five tests, cut where there is no order."""

from eyeline.visibility.painter.painter import Painter as Painter
