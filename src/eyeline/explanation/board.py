"""Explanations as pictures: the stage, what is marked on it, the sentence, the counters."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import PIL.Image
import PIL.ImageColor
import PIL.ImageDraw
import PIL.ImageFont

from eyeline.cached import cached_property
from eyeline.explanation.explanation import Explanation
from eyeline.explanation.frames import Frame, Mark, Points
from eyeline.explanation.roles import (
    CHANGED,
    DOT,
    FAINT,
    INK,
    INK_WIDTH,
    NETWORK,
    PAPER,
    ROLES,
    STAGE,
    Look,
    canvas,
    legend,
    network,
    notes_of,
    paint,
    runs,
    title_of,
)
from eyeline.geometry.arrays import ByteArray, IntArray
from eyeline.render.encoders import encoder_for
from eyeline.render.encoders.encoder import Job
from eyeline.render.film import Progress
from eyeline.render.overlap import overlapped

SIZE = (1280, 720)
FINE = 2  # the stage is drawn so many times larger, then made smaller: that smooths its edges
MARGIN, HEAD, FOOT, SIDE = 28, 76, 110, 300  # pixels around the stage
TEXT, SMALL, TITLE = 21, 17, 26  # heights of type
ROW, KEY_ROW = 26, 24  # pixels from a counter to the next, and from a colour's meaning to the next
LAST_SECONDS = 2.0  # the answer stays


@dataclass(frozen=True, eq=False)
class Board:
    """Where an explanation's pictures are drawn: the stage in fine pixels, all else in plain ones."""

    explanation: Explanation
    legend: Mapping[str, Look]  # of the roles that are used

    @cached_property
    def scale(self) -> float:
        """Fine pixels of one explained pixel."""
        projected = self.explanation.projected
        across, down = SIZE[0] - SIDE - 2 * MARGIN, SIZE[1] - HEAD - FOOT
        return FINE * min(across / projected.width, down / projected.height)

    @cached_property
    def stage(self) -> PIL.Image.Image:
        """The stage with the edges of all faces, under everything."""
        projected = self.explanation.projected
        # Whole plain pixels
        width, height = (max(1, round(n * self.scale / FINE)) for n in (projected.width, projected.height))
        image = PIL.Image.new("RGB", (FINE * width, FINE * height), STAGE)
        draw = PIL.ImageDraw.Draw(image)
        for corners in network(self.explanation):
            draw.polygon(self.placed(corners), outline=NETWORK, width=FINE)
        return image

    @cached_property
    def corner(self) -> tuple[int, int]:
        """The stage's upper left corner, plain pixels."""
        across, down = SIZE[0] - SIDE - 2 * MARGIN, SIZE[1] - HEAD - FOOT
        width, height = self.stage.size
        return MARGIN + (across - width // FINE) // 2, HEAD + (down - height // FINE) // 2

    @cached_property
    def background(self) -> PIL.Image.Image:
        """What no step changes."""
        image = PIL.Image.new("RGB", SIZE, PAPER)
        draw = PIL.ImageDraw.Draw(image)
        notes = notes_of(self.explanation)
        middle = 0.33 * HEAD if notes else 0.5 * HEAD
        draw.text((MARGIN, middle), title_of(self.explanation), INK, type_of(TITLE), anchor="lm")
        draw.text((MARGIN, 0.74 * HEAD), notes, FAINT, type_of(SMALL), anchor="lm")
        left, y = SIZE[0] - SIDE, SIZE[1] - FOOT - KEY_ROW * len(self.legend)
        for row, look in enumerate(self.legend.values()):
            middle = y + KEY_ROW * row + KEY_ROW / 2
            draw.rectangle((left, middle - 6, left + 12, middle + 6), fill=look.colour)
            draw.text((left + 22, middle), look.meaning, FAINT, type_of(SMALL), anchor="lm")
        return image

    def placed(self, points: Points) -> Points:
        """Explained pixels on the stage."""
        return [(x * self.scale, y * self.scale) for x, y in points]

    def settle(self, stage: PIL.Image.Image, seen: IntArray, frame: Frame) -> None:
        """Let a frame's pixels fall on the canvas (H, W) and the stage, and its marks that stay."""
        before = seen.copy()
        paint(seen, frame)
        draw = PIL.ImageDraw.Draw(stage, "RGBA")
        for y, begin, end, face in runs(np.where(seen != before, seen, -1)):
            (left, top), (right, low) = self.placed([(begin, y), (end, y + 1)])
            box = round(left), round(top), round(right) - 1, round(low) - 1
            draw.rectangle(box, fill=tuple(self.explanation.colours[face].tolist()))
        for mark in frame.ink:
            self.mark(draw, mark, INK_WIDTH)

    def drawn(self, frame: Frame, stage: PIL.Image.Image, before: Mapping[str, int]) -> ByteArray:
        """(H, W, 4): a frame on what is settled.

        before: the counters of the frame before this one; those that changed stand out.
        """
        stage = stage.copy()
        draw = PIL.ImageDraw.Draw(stage, "RGBA")
        for mark in frame.marks:
            self.mark(draw, mark, 1.0)
        image = self.background.copy()
        image.paste(stage.reduce(FINE), self.corner)
        self.say(PIL.ImageDraw.Draw(image), frame, before)
        return np.asarray(image.convert("RGBA"))

    def mark(self, draw: PIL.ImageDraw.ImageDraw, mark: Mark, weight: float) -> None:
        """Draw one mark on the stage."""
        look, points = ROLES[mark.role], self.placed(mark.points)
        width = max(FINE, round(look.width * weight * self.scale))
        if mark.shape == "dots":
            reach = DOT * self.scale
            for x, y in points:
                draw.ellipse((x - reach, y - reach, x + reach, y + reach), fill=look.colour)
        elif mark.shape == "polygon":
            fill = (*PIL.ImageColor.getrgb(look.colour)[:3], round(255 * look.fill * weight))
            draw.polygon(points, fill=fill)
            draw.line([*points, points[0]], fill=look.colour, width=width, joint="curve")
        elif look.dashed:
            for piece in dashes(points[0], points[-1], 0.8 * self.scale):
                draw.line(piece, fill=look.colour, width=width)
        else:
            draw.line(points, fill=look.colour, width=width, joint="curve")

    def say(self, draw: PIL.ImageDraw.ImageDraw, frame: Frame, before: Mapping[str, int]) -> None:
        """The sentence under the stage, the counters beside it, and how far the method is."""
        for row, line in enumerate(lines_of(frame.sentence, SIZE[0] - 2 * MARGIN)[:2]):
            draw.text((MARGIN, SIZE[1] - FOOT + 16 + 28 * row), line, INK, type_of(TEXT))
        whole, y = SIZE[0] - 2 * MARGIN, SIZE[1] - 26
        part = whole * frame.number / max(1, len(self.explanation))
        draw.rectangle((MARGIN, y, MARGIN + whole, y + 3), fill=NETWORK)
        draw.rectangle((MARGIN, y, MARGIN + part, y + 3), fill=ROLES["subject"].colour)
        place = f"{frame.number:,} of {len(self.explanation):,}"
        rows = [("step", place, INK), ("", "", INK)]
        for name, count in frame.work.items():
            rows.append((name, f"{count:,}", INK if count == before.get(name, 0) else CHANGED))
        for row, (name, value, colour) in enumerate(rows):
            y = HEAD + ROW * row
            draw.text((SIZE[0] - SIDE, y), name, FAINT, type_of(SMALL))
            draw.text((SIZE[0] - MARGIN, y), value, colour, type_of(SMALL), anchor="ra")


def lines_of(sentence: str, width: int) -> list[str]:
    """A sentence in lines of at most `width` pixels."""
    lines = [""]
    for word in sentence.split():
        longer = f"{lines[-1]} {word}".lstrip()
        if lines[-1] and type_of(TEXT).getlength(longer) > width:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines


@cache
def type_of(height: int) -> Any:
    """The type that Pillow brings along."""
    return PIL.ImageFont.load_default(height)


def dashes(
    start: tuple[float, float], end: tuple[float, float], length: float
) -> Iterator[list[tuple[float, float]]]:
    """A line's dashes, as long as the gaps between them."""
    a, b = np.array(start), np.array(end)
    whole = float(np.hypot(*(b - a)))
    for at in np.arange(0, whole, 2 * length):
        pieces = (a + (b - a) * (min(reach, whole) / whole) for reach in (at, at + length))
        yield [(float(x), float(y)) for x, y in pieces]


def pictures(explanation: Explanation, most: int) -> Iterator[ByteArray]:
    """(H, W, 4) of every frame."""
    frames = list(explanation.frames(most))
    board, seen = Board(explanation, legend(frames)), canvas(explanation)
    stage, work = board.stage.copy(), dict[str, int]()
    for frame in frames:
        board.settle(stage, seen, frame)
        yield board.drawn(frame, stage, work)
        work = dict(frame.work)


def write(explanation: Explanation, path: Path, most: int, fps: int, progress: Progress | None) -> None:
    """A film whose last frame stays a while."""
    encoder = encoder_for(path)
    stay = round(LAST_SECONDS * fps)
    count = min(most, max(1, len(explanation))) + stay

    def made() -> Iterator[tuple[int, ByteArray]]:
        last = None
        for number, last in enumerate(pictures(explanation, most)):
            yield number, last
            if progress:
                progress(number + 1, count)
        if last is not None:
            for number in range(count - stay, count):
                yield number, last

    with encoder(path, Job(SIZE, fps, count)) as sink:
        overlapped(made(), lambda item: sink.write(*item))
