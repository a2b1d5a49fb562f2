"""A comparison as one picture."""

from __future__ import annotations

import textwrap
from functools import cache
from typing import Any

import numpy as np
import PIL.Image
import PIL.ImageDraw
import PIL.ImageFont

from eyeline.comparison.cells import HEADINGS, Row, judge_line, rows_of
from eyeline.comparison.comparison import Comparison
from eyeline.comparison.plot import plot
from eyeline.comparison.thumbnails import HEIGHT, WIDTH, answer_picture, colours_of, map_of
from eyeline.render.image import Image

PAPER, STAGE, INK, FAINT, GOOD, BAD = "#f7f5f0", "#ffffff", "#22252b", "#6c717b", "#1f8a4c", "#c2342b"
WIDE, MARGIN, HEAD, GAP = 1780, 28, 112, 14  # pixels
COLUMNS = (0, 104, 246, 346, 452, 712)  # of the headings, from where the text begins
TEXT, SMALL, TITLE = 18, 15, 26
LINE, WORK_LINE = 22, 20
WORK_LINES, WORK_COLUMN = 6, 232  # of the counters: rows, and pixels from one column to the next
REFUSAL = 42  # characters of a line


def sheet(comparison: Comparison) -> Image:
    """Every method a row: what it sees, where it differs, time, memory, work; ladders below."""
    rows, ladders = rows_of(comparison), [plot(ladder) for ladder in comparison.ladders]
    below = max((one.size[1] + GAP for one in ladders), default=0)
    tall = HEAD + len(rows) * (HEIGHT + GAP) + below + MARGIN
    image = PIL.Image.new("RGB", (WIDE, tall), PAPER)
    draw = PIL.ImageDraw.Draw(image)
    draw.text((MARGIN, 20), comparison.title, INK, type_of(TITLE))
    draw.text((MARGIN, 54), judge_line(comparison), FAINT, type_of(SMALL))
    begin = MARGIN + 2 * (WIDTH + GAP) + GAP
    for heading, column in zip(HEADINGS, COLUMNS, strict=True):
        draw.text((begin + column, HEAD - 28), heading, FAINT, type_of(SMALL))
    for left, name in ((MARGIN, "what it sees"), (MARGIN + WIDTH + GAP, "where it differs")):
        draw.text((left, HEAD - 28), name, FAINT, type_of(SMALL))
    colours = colours_of(comparison)
    for number, (row, trial) in enumerate(zip(rows, comparison.trials, strict=True)):
        top = HEAD + number * (HEIGHT + GAP)
        draw.rectangle((MARGIN, top, WIDE - MARGIN, top + HEIGHT), fill=STAGE)
        for left, shown in (
            (MARGIN, answer_picture(comparison, trial, colours)),
            (MARGIN + WIDTH + GAP, map_of(comparison, trial)),
        ):
            if shown is not None:
                spare = WIDTH - shown.size[0], HEIGHT - shown.size[1]
                image.paste(shown, (left + spare[0] // 2, top + spare[1] // 2))
        write(draw, row, begin, top + 12)
    for number, one in enumerate(ladders):
        image.paste(one, (MARGIN + number * (one.size[0] + GAP), tall - MARGIN - one.size[1]))
    return Image(np.asarray(image.convert("RGBA")))


def write(draw: PIL.ImageDraw.ImageDraw, row: Row, left: int, top: int) -> None:
    """A row's text."""
    if row.agrees is None and not row.first:
        lines: tuple[str, ...] = tuple(textwrap.wrap(row.agreement[0], REFUSAL))
    else:
        lines = row.agreement
    verdict = FAINT if row.agrees is None else GOOD if row.agrees else BAD
    cells = (
        ((row.method,), INK),
        (row.time, INK),
        ((row.first,), INK),
        ((row.memory,), INK),
        (lines, verdict),
    )
    for number, (words, colour) in enumerate(cells):
        for place, line in enumerate(words):
            shade = colour if place == 0 or number == len(cells) - 1 else FAINT
            small = place > 0 or (number == len(cells) - 1 and row.agrees is None)
            at = left + COLUMNS[number], top + LINE * place + 2 * small
            draw.text(at, line, shade, type_of(SMALL if small else TEXT))
    for place, line in enumerate(row.work):
        column, below = divmod(place, WORK_LINES)
        at = left + COLUMNS[-1] + column * WORK_COLUMN, top + 2 + WORK_LINE * below
        draw.text(at, line, FAINT, type_of(SMALL))
    draw.text((left, top + LINE + 2), row.space, FAINT, type_of(SMALL))


@cache
def type_of(height: int) -> Any:
    """The type that Pillow brings along."""
    return PIL.ImageFont.load_default(height)
