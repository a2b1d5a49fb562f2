"""Pure functions of time: curves, the tracks they move, and clips of tracks."""

from eyeline.motion.clip import Clip
from eyeline.motion.curve import Curve
from eyeline.motion.easing import EASINGS, Easing, cubic_bezier, easing, steps
from eyeline.motion.key import Key
from eyeline.motion.track import Track

__all__ = ["EASINGS", "Clip", "Curve", "Easing", "Key", "Track", "cubic_bezier", "easing", "steps"]
