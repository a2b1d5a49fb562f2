"""How far away: near is light, far is dark."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import ByteArray, FloatArray
from eyeline.shading.frame import Frame, Strip
from eyeline.shading.styles.plain import BLACK, before, exact
from eyeline.visibility.method import Visible


@dataclass(frozen=True)
class Depth:
    """Grey by the distance along the view axis, in even steps from the nearest that is seen to the farthest.

    nearest, farthest: their display values, 0..1; what lies all at one distance is drawn as nearest.
    `eyeline.visible` gives the metres themselves.
    """

    name: str = "depth"
    lit: bool = False
    see_through: bool = False
    nearest: float = 0.96
    farthest: float = 0.12

    def __call__(self, frame: Frame) -> ByteArray:
        """The picture (H, W, 4)."""
        near, far = seen_range([visible for visible, _, _ in frame.visibles])
        span = far - near or 1.0

        def colour_of(strip: Strip) -> FloatArray:
            part = np.clip((distances(strip) - near) / span, 0, 1)
            grey = self.nearest + (self.farthest - self.nearest) * part
            return exact(np.stack([grey, grey, grey], axis=-1))

        return before(frame, BLACK).drawn(colour_of)


def seen_range(visibles: list[Visible]) -> tuple[float, float]:
    """The least and the greatest distance seen, metres; 0 and 0 of nothing."""
    distances = [visible.distance[visible.face >= 0] for visible in visibles]
    seen = [one for one in distances if one.size]
    if not seen:
        return 0.0, 0.0
    return min(float(one.min()) for one in seen), max(float(one.max()) for one in seen)


def distances(strip: Strip) -> FloatArray:
    """(K,) float32 metres along the view axis, where the last sample of each point of a strip sees it."""
    found = np.empty(len(strip.points), np.float32)
    for of_sample, (visible, _, _) in zip(strip.of_sample, strip.frame.visibles, strict=True):
        seen = of_sample >= 0
        found[of_sample[seen]] = visible.distance[strip.top : strip.bottom].reshape(-1)[seen]
    return found
