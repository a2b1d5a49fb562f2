"""Ladders as plots: time over faces or pixels, both in powers of ten."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import PIL.Image
import PIL.ImageDraw
import PIL.ImageFont

from eyeline.comparison.ladder import Ladder

SIZE = (760, 460)
FINE = 2
LEFT, RIGHT, TOP, BOTTOM = 70, 210, 50, 46  # pixels around the axes
PAPER, INK, FAINT, GRID = "#ffffff", "#22252b", "#6c717b", "#e4e6ea"
COLOURS = ("#1f6fb2", "#e07a00", "#1f8a4c", "#c2342b", "#7b4fb0", "#8c6239", "#d6498f", "#4a4f57")
ROW = 17  # pixels between labels, at least


def plot(ladder: Ladder) -> PIL.Image.Image:
    """One ladder; each line is labelled with its method and its exponent."""
    image = PIL.Image.new("RGB", (FINE * SIZE[0], FINE * SIZE[1]), PAPER)
    draw = PIL.ImageDraw.Draw(image)
    draw.text((FINE * LEFT, FINE * 18), f"time over {ladder.unit}", INK, type_of(17))
    times = [one for row in ladder.seconds.values() for one in row]
    x_axis = Axis(min(ladder.rungs), max(ladder.rungs), FINE * LEFT, FINE * (SIZE[0] - RIGHT))
    y_axis = Axis(min(times), max(times), FINE * (SIZE[1] - BOTTOM), FINE * TOP)
    grid(draw, x_axis, y_axis)
    ends = []
    for number, (name, row) in enumerate(ladder.seconds.items()):
        colour = COLOURS[number % len(COLOURS)]
        points = [(x_axis(rung), y_axis(one)) for rung, one in zip(ladder.rungs, row, strict=False)]
        draw.line(points, fill=colour, width=2 * FINE, joint="curve")
        for x, y in points:
            draw.ellipse((x - 6, y - 6, x + 6, y + 6), fill=colour)
        exponent = ladder.exponent(name)
        label = name if exponent is None else f"{name}  n^{exponent:.2f}"
        ends.append((points[-1][1], label, colour))
    for y, label, colour in apart(ends):
        draw.text((FINE * (SIZE[0] - RIGHT + 14), y), label, colour, type_of(14), anchor="lm")
    return image.reduce(FINE)


class Axis:
    """Numbers above zero, in powers of ten, onto pixels."""

    def __init__(self, low: float, high: float, begin: float, end: float) -> None:
        self.low, self.high = math.log10(low), max(math.log10(high), math.log10(low) + 0.1)
        self.begin, self.end = begin, end

    def __call__(self, value: float) -> float:
        """Where a number stands."""
        part = (math.log10(value) - self.low) / (self.high - self.low)
        return self.begin + part * (self.end - self.begin)

    def ticks(self) -> list[float]:
        """Powers of ten within, and where there are few, twice and five times them."""
        powers = range(math.floor(self.low), math.ceil(self.high) + 1)
        within = [10.0**power for power in powers if self.low - 1e-9 <= power <= self.high + 1e-9]
        if len(within) > 2:
            return within
        finer = [step * 10.0**power for power in powers for step in (1, 2, 5)]
        return [one for one in finer if self.low - 1e-9 <= math.log10(one) <= self.high + 1e-9]


def grid(draw: PIL.ImageDraw.ImageDraw, x_axis: Axis, y_axis: Axis) -> None:
    """Lines at round numbers, and the numbers."""
    for value in x_axis.ticks():
        x = x_axis(value)
        draw.line((x, y_axis.begin, x, y_axis.end), fill=GRID, width=FINE)
        draw.text((x, y_axis.begin + FINE * 8), short(value), FAINT, type_of(13), anchor="ma")
    for value in y_axis.ticks():
        y = y_axis(value)
        draw.line((x_axis.begin, y, x_axis.end, y), fill=GRID, width=FINE)
        draw.text((x_axis.begin - FINE * 8, y), told(value), FAINT, type_of(13), anchor="rm")


def apart(labels: list[tuple[float, str, str]]) -> list[tuple[float, str, str]]:
    """Labels moved down where they would lie on each other."""
    placed: list[tuple[float, str, str]] = []
    for y, label, colour in sorted(labels):
        least = placed[-1][0] + FINE * ROW if placed else y
        placed.append((max(y, least), label, colour))
    return placed


def short(value: float) -> str:
    """A count: 20k, 1.5M."""
    for unit, name in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if value >= unit:
            return f"{value / unit:g}{name}"
    return f"{value:g}"


def told(seconds: float) -> str:
    """A time: 0.2 ms, 5 ms, 2 s."""
    return f"{seconds:g} s" if seconds >= 1 else f"{seconds * 1e3:g} ms"


@cache
def type_of(height: int) -> Any:
    """The type that Pillow brings along, in fine pixels."""
    return PIL.ImageFont.load_default(FINE * height)
