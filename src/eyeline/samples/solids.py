"""Sphere, cube and torus: the plainest models."""

from __future__ import annotations

import math

import numpy as np

from eyeline.samples.shapes import Shape, box, lathe
from eyeline.scene.material import Material
from eyeline.scene.scene import Scene

CORAL = Material("coral", (0.78, 0.16, 0.10, 1.0), roughness=0.38)
SKY = Material("sky", (0.07, 0.24, 0.62, 1.0), roughness=0.42)
HONEY = Material("honey", (0.86, 0.42, 0.06, 1.0), roughness=0.30)


def sphere() -> Scene:
    """A ball one metre across."""
    return Scene.of(ball(0.5).mesh(CORAL, "sphere"), name="sphere")


def cube() -> Scene:
    """A cube with edges of one metre, each side with the whole texture."""
    return Scene.of(box((1, 1, 1)).mesh(SKY, "cube"), name="cube")


def torus() -> Scene:
    """A ring one metre across and 0.3 metres thick, lying flat."""
    turn = np.linspace(0, 2 * math.pi, 49)
    profile = np.stack([0.35 + 0.15 * np.cos(turn), 0.15 * np.sin(turn)], axis=1)
    profile[-1] = profile[0]
    return Scene.of(lathe(profile, 96).mesh(HONEY, "torus"), name="torus")


def ball(radius: float, rings: int = 48) -> Shape:
    """A sphere about the origin, its poles on y."""
    turn = np.linspace(0, math.pi, rings + 1)
    profile = radius * np.stack([np.sin(turn), -np.cos(turn)], axis=1)
    profile[[0, -1], 0] = 0
    return lathe(profile, 2 * rings)
