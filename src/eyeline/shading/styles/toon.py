"""A cartoon: flat tones in a few steps of light, and lines in ink."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from eyeline.geometry.arrays import ByteArray, FloatArray
from eyeline.shading.alpha import faces_of, has
from eyeline.shading.attributes import attributes_of
from eyeline.shading.frame import Frame, Strip
from eyeline.shading.ground import shaded_backdrop
from eyeline.shading.lanes import (
    ALPHA,
    BLUE,
    EMISSIVE_BLUE,
    EMISSIVE_RED,
    LIT,
    NX,
    NZ,
    RED,
    ROUGHNESS,
    UNLIT,
    VX,
    VZ,
    X,
    Z,
)
from eyeline.shading.light_table import AT, COLOR, NEARNESS
from eyeline.shading.resolve import Layers
from eyeline.shading.shadow import arrive
from eyeline.shading.stage import Stage, stage_of
from eyeline.shading.styles.ink import Ink
from eyeline.shading.surface_points import SurfacePoints
from eyeline.shading.transparency import layers, stacked

Tint = tuple[float, float, float]


@dataclass(frozen=True)
class Toon:
    """Base colours times one of a few tones, by the light that draws the picture, under ink.

    The strongest light draws; the others do not. Between tones lie `steps`: cosines between normal and light,
    0 in shadow; they are `soft` wide, so that they have no stairs. A smooth material has a spot of light.
    Blended surfaces are glass without lines.
    """

    name: str = "toon"
    lit: bool = True
    see_through: bool = True
    tones: tuple[Tint, ...] = ((0.26, 0.30, 0.42), (0.60, 0.62, 0.68), (1.0, 1.0, 1.0))  # linear
    steps: tuple[float, ...] = (0.06, 0.42)
    soft: float = 0.03
    spot: float = 0.972  # the cosine between normal and half-way direction where it begins
    spot_roughness: float = 0.5  # rougher materials have none
    ink: Ink = field(default_factory=Ink)

    def __call__(self, frame: Frame) -> ByteArray:
        """The picture (H, W, 4)."""
        stage = stage_of(frame)
        surfaces = frame.projected.surfaces
        glass = stacked(frame, faces_of(surfaces, "blend")) if has(surfaces, "blend") else ()

        def shader(points: SurfacePoints) -> FloatArray:
            return self.colours(frame, stage, points)

        def colour_of(strip: Strip) -> tuple[FloatArray, Layers]:
            lines = self.ink.layers(strip)
            if any(map(len, glass)):
                lines = beneath(lines, layers(strip, glass, shader))
            return shader(strip.points), lines

        return frame.drawn(colour_of, lambda strip: shaded_backdrop(strip, stage))

    def colours(self, frame: Frame, stage: Stage, points: SurfacePoints) -> FloatArray:
        """(K, 4) float32, linear."""
        count = len(points)
        lanes = attributes_of(frame, points)
        light = strongest(stage)
        arrive(lanes, count, stage.shadows, stage.lights, light)
        lanes = lanes[:, :count]
        to_light = towards(stage, light, lanes)
        normals, to_eye = lanes[NX : NZ + 1], lanes[VX : VZ + 1]
        level = (normals * to_light).sum(axis=0) * lanes[LIT]
        tone = np.where(lanes[UNLIT] > 0, 1, self.tone(level))
        half = to_light + to_eye
        half /= np.sqrt((half**2).sum(axis=0))
        shiny = (lanes[ROUGHNESS] < self.spot_roughness) & (level > self.steps[-1]) & (lanes[UNLIT] == 0)
        spot = rising((normals * half).sum(axis=0), self.spot, 0.2 * (1 - self.spot)) * shiny * 0.55
        colour = np.empty((count, 4), np.float32)
        lit = lanes[RED : BLUE + 1] * tone + lanes[EMISSIVE_RED : EMISSIVE_BLUE + 1]
        colour[:, :3] = np.minimum(lit + (1 - lit) * spot, 1).T
        colour[:, 3] = lanes[ALPHA]
        return colour

    def tone(self, level: FloatArray) -> FloatArray:
        """(3, K) the tint of each level of light (K,)."""
        tone = np.tile(np.array(self.tones[0])[:, None], (1, len(level)))
        for step, low, high in zip(self.steps, self.tones[:-1], self.tones[1:], strict=True):
            tone += (np.array(high) - np.array(low))[:, None] * rising(level, step, self.soft)
        return tone


def rising(value: FloatArray, step: float, soft: float) -> FloatArray:
    """0 below a step, 1 above, and a smooth rise `soft` wide around it."""
    part = np.clip((value - step) / soft + 0.5, 0, 1)
    rise: FloatArray = part * part * (3 - 2 * part)
    return rise


def strongest(stage: Stage) -> int:
    """The light whose colour adds up to most."""
    return int(stage.lights[:, COLOR : COLOR + 3].sum(axis=1).argmax())


def towards(stage: Stage, light: int, lanes: FloatArray) -> FloatArray:
    """(3, K) unit directions to a light."""
    row = stage.lights[light]
    way = row[AT : AT + 3, None] - lanes[X : Z + 1] * row[NEARNESS]
    unit: FloatArray = way / np.sqrt((way**2).sum(axis=0) + np.finfo(np.float32).tiny)
    return unit


def beneath(lower: Layers, upper: Layers) -> Layers:
    """The layers of both, at each sample the upper ones in front."""
    # Each list is the lower one's fragments, then the upper one's
    counts = [np.diff(one.first, axis=1).reshape(-1) for one in (lower, upper)]
    ends = np.cumsum(counts[0] + counts[1])
    starts = ends - counts[0] - counts[1]
    colour = np.empty((len(lower.colour) + len(upper.colour), 4), np.float32)
    for count, begin, one in ((counts[0], starts, lower), (counts[1], starts + counts[0], upper)):
        before = np.cumsum(count) - count
        colour[np.repeat(begin - before, count) + np.arange(len(one.colour))] = one.colour
    ends = ends.reshape(len(lower.first), -1)
    return Layers(np.concatenate([lower.first[:, :1] + upper.first[:, :1], ends], axis=1), colour)
