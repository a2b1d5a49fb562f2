"""Pure functions of time: curves, the tracks they move, clips of tracks, and shots that write them."""

from eyeline.motion.act import Act, in_turn, together
from eyeline.motion.clip import Clip
from eyeline.motion.curve import Curve
from eyeline.motion.easing import EASINGS, Easing, cubic_bezier, easing, steps
from eyeline.motion.key import Key
from eyeline.motion.layers import Layer, Layers
from eyeline.motion.path import Path
from eyeline.motion.shot import Shot
from eyeline.motion.track import Track

__all__ = [
    "EASINGS",
    "Act",
    "Clip",
    "Curve",
    "Easing",
    "Key",
    "Layer",
    "Layers",
    "Path",
    "Shot",
    "Track",
    "cubic_bezier",
    "easing",
    "in_turn",
    "steps",
    "together",
]
