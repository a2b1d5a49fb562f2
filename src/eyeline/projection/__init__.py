"""Scene and camera to Projected: transformed, clipped and snapped once, for every method."""

from eyeline.projection.project import project
from eyeline.projection.projected import CLOCKWISE, COUNTER_CLOCKWISE, Projected

__all__ = ["CLOCKWISE", "COUNTER_CLOCKWISE", "Projected", "project"]
