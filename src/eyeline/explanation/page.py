"""Explanations as one web page: a scrubber, play, speed, a step back; it needs nothing beside it."""

from __future__ import annotations

import html
import json
from collections.abc import Sequence
from importlib import resources
from typing import Any

from eyeline.explanation.explanation import PAGE_FRAMES, Explanation
from eyeline.explanation.frames import Frame, Mark
from eyeline.explanation.roles import (
    DOT,
    FAINT,
    INK,
    INK_WIDTH,
    NETWORK,
    PAPER,
    STAGE,
    legend,
    network,
    notes_of,
    title_of,
)

EMBEDDED_HEIGHT = 640  # pixels in a notebook


def page(explanation: Explanation) -> str:
    """The whole page."""
    template = resources.files("eyeline.explanation").joinpath("page.html").read_text(encoding="utf-8")
    # Inside a script element, text that begins a tag or a comment is dangerous
    data = data_of(explanation).replace("<", "\\u003c")
    return template.replace("{{title}}", html.escape(title_of(explanation))).replace("{{data}}", data)


def embedded(explanation: Explanation) -> str:
    """The page inside another one."""
    inside = html.escape(page(explanation), quote=True)
    style = f"width:100%;height:{EMBEDDED_HEIGHT}px;border:0"
    return f'<iframe sandbox="allow-scripts" style="{style}" srcdoc="{inside}"></iframe>'


def data_of(explanation: Explanation) -> str:
    """Everything the page shows, as JSON."""
    projected = explanation.projected
    frames = list(explanation.frames(PAGE_FRAMES))
    counters = list(explanation.steps[-1].work) if explanation.steps else []
    data = {
        "title": title_of(explanation),
        "notes": notes_of(explanation),
        "width": projected.width,
        "height": projected.height,
        "steps": len(explanation),
        "colours": ["#" + bytes(row).hex() for row in explanation.colours],
        "network": [flat(corners) for corners in network(explanation)],
        "roles": {role: look._asdict() for role, look in legend(frames).items()},
        "theme": {"paper": PAPER, "stage": STAGE, "ink": INK, "faint": FAINT, "network": NETWORK},
        "ink_width": INK_WIDTH,
        "dot": DOT,
        "counters": counters,
        "frames": [frame_of(frame, projected.width) for frame in frames],
    }
    return json.dumps(data, separators=(",", ":"))


def frame_of(frame: Frame, width: int) -> dict[str, Any]:
    """A frame as the page reads it: painted are a face, then pixel and length of each run."""
    return {
        "n": frame.number,
        "k": frame.kind,
        "s": frame.sentence,
        "w": list(frame.work.values()),
        "m": [mark_of(mark) for mark in frame.marks],
        "i": [mark_of(mark) for mark in frame.ink],
        "p": [[face, *runs(pixels, width)] for face, pixels in frame.painted if len(pixels)],
    }


def mark_of(mark: Mark) -> list[Any]:
    """Shape, role, x, y, x, y ..."""
    return [mark.shape, mark.role, *flat(mark.points)]


def flat(points: Sequence[tuple[float, float]]) -> list[float]:
    """Pairs one after the other."""
    return [number for pair in points for number in pair]


def runs(pixels: Sequence[tuple[int, int]], width: int) -> list[int]:
    """Pixels as the first and the length of each run along a row."""
    told: list[int] = []
    for number in sorted(y * width + x for x, y in pixels):
        if told and number == told[-2] + told[-1] and number % width:
            told[-1] += 1
        else:
            told += [number, 1]
    return told
