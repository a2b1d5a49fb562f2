"""Pure functions of time: curves, the tracks they move, and clips of tracks."""

from eyeline.motion.clip import Clip
from eyeline.motion.curve import Curve
from eyeline.motion.track import Track

__all__ = ["Clip", "Curve", "Track"]
