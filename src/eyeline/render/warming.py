"""Errands that between them run every kernel, so that each is compiled and kept."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from eyeline.render.frame import render

SIZE = (64, 48)


def errands() -> list[Callable[[], object]]:
    """Small pictures to make: every sample in the default style, and every style and method of one."""
    from eyeline.samples import SAMPLES
    from eyeline.shading.styles import STYLES
    from eyeline.visibility import METHODS

    scenes = {name: make() for name, make in SAMPLES.items()}
    first = next(iter(scenes.values()))
    answering = [name for name, method in METHODS.items() if method.answers]
    return [
        *(partial(render, scene, size=SIZE) for scene in scenes.values()),
        *(partial(render, first, size=SIZE, style=style) for style in STYLES),
        *(partial(render, first, size=SIZE, samples=1, method=method) for method in answering),
    ]
