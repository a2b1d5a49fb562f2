"""A contact sheet: a film at one look."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from eyeline.render.image import Image

if TYPE_CHECKING:
    from eyeline.render.film import Film

MARGIN = 8  # pixels between pictures
PAPER = 255


def contact_sheet(film: Film, columns: int = 4, rows: int = 3, width: int = 400) -> Image:
    """Pictures of the film at even steps from its first to its last frame, row by row, on white paper."""
    height = max(1, round(width * film.shot.size[1] / film.shot.size[0]))
    small = replace(film, shot=replace(film.shot, size=(width, height)))
    count = min(columns * rows, len(film))
    numbers = np.linspace(0, len(film) - 1, count).round().astype(int)
    rows = -(-count // columns)
    sheet = np.full(
        (rows * (height + MARGIN) + MARGIN, columns * (width + MARGIN) + MARGIN, 4), PAPER, np.uint8
    )
    for place, number in enumerate(numbers):
        top = MARGIN + (place // columns) * (height + MARGIN)
        left = MARGIN + (place % columns) * (width + MARGIN)
        sheet[top : top + height, left : left + width] = small[int(number)].pixels
    return Image(sheet)
