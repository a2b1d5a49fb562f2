"""For pictures that are data: exact 8-bit colours, before one colour instead of the studio's gradient."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.scene.material import Colour
from eyeline.shading.encoding import DECODED
from eyeline.shading.frame import Frame

BLACK: Colour = (0.0, 0.0, 0.0)


def before(frame: Frame, colour: Colour) -> Frame:
    """The frame on one linear colour in place of the studio; a backdrop that was chosen stays."""
    if frame.look.background != "studio":
        return frame
    return replace(frame, look=replace(frame.look, background=colour))


def exact(shown: FloatArray) -> FloatArray:
    """(K, 4) float32 linear, opaque, of display values (K, 3) 0..1; rounded to 8 bits, so not dithered."""
    steps = np.rint(np.clip(shown, 0, 1) * 255).astype(np.intp)
    colour = np.ones((len(steps), 4), np.float32)
    colour[:, :3] = DECODED[steps]
    return colour
