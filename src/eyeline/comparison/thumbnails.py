"""Small pictures of answers: what a method sees, and where it differs."""

from __future__ import annotations

import numpy as np
import PIL.Image
import PIL.ImageDraw

from eyeline.comparison.comparison import Comparison
from eyeline.comparison.trial import Trial
from eyeline.geometry.arrays import BoolArray, ByteArray, FloatArray
from eyeline.shading.face_colours import face_colours
from eyeline.visibility.method import Visible

WIDTH, HEIGHT = 256, 144  # pixels: the most
PALEST = 0.4  # of DIFFERENT, where a single pixel differs
PAPER, SEEN, DIFFERENT, WRONG, INK = (
    (255, 255, 255),
    (222, 224, 229),
    (232, 160, 32),
    (194, 24, 24),
    (34, 37, 43),
)


def size_of(comparison: Comparison) -> tuple[int, int]:
    """(width, height) of a thumbnail, in the picture's proportions."""
    width, height = comparison.size
    scale = min(WIDTH / width, HEIGHT / height)
    return max(1, round(width * scale)), max(1, round(height * scale))


def answer_picture(comparison: Comparison, trial: Trial, colours: ByteArray) -> PIL.Image.Image | None:
    """What a method sees, each face in its colour, or its lines; None where it refused."""
    if trial.refusal:
        return None
    size = size_of(comparison)
    if isinstance(trial.answer, Visible):
        shown = np.full((*trial.answer.face.shape, 3), PAPER, np.uint8)
        covered = trial.answer.face >= 0
        shown[covered] = colours[trial.answer.face[covered]]
        return PIL.Image.fromarray(shown).resize(size, PIL.Image.Resampling.BOX)
    fine = 4
    image = PIL.Image.new("RGB", (fine * size[0], fine * size[1]), PAPER)
    draw, scale = PIL.ImageDraw.Draw(image), fine * size[0] / comparison.size[0]
    for (x0, y0), (x1, y1) in np.asarray(trial.answer.segments, dtype=np.float64) * scale:
        draw.line((x0, y0, x1, y1), fill=INK, width=fine // 2)
    return image.reduce(fine)


def map_of(comparison: Comparison, trial: Trial) -> PIL.Image.Image | None:
    """Where a method differs from the judge: amber where rounding decides, red where it is wrong.

    Amber is the stronger the more of a thumbnail's pixel differs; red is red, however little is wrong.
    """
    found = comparison.agreements.get(trial.name)
    if found is None:
        return None
    size = size_of(comparison)
    shown = np.full((size[1], size[0], 3), PAPER, np.float64)
    shown[any_in_block(comparison.judge.face >= 0, size)] = SEEN
    strength = any_in_block(found.different, size) * np.sqrt(share_in_block(found.different, size)).clip(
        PALEST
    )
    shown += strength[..., None] * (np.array(DIFFERENT) - shown)
    shown[any_in_block(found.wrong, size)] = WRONG
    return PIL.Image.fromarray(np.round(shown).astype(np.uint8))


def share_in_block(where: BoolArray, size: tuple[int, int]) -> FloatArray:
    """(h, w) the part of the pixels that falls on each pixel of a smaller picture and is marked."""
    fine = PIL.Image.fromarray(where.astype(np.float32))
    return np.asarray(fine.resize(size, PIL.Image.Resampling.BOX), dtype=np.float64)


def any_in_block(where: BoolArray, size: tuple[int, int]) -> BoolArray:
    """(h, w) whether any pixel that falls on each pixel of a smaller picture is marked: none gets lost."""
    rows, columns = np.nonzero(where)
    small = np.zeros((size[1], size[0]), bool)
    small[rows * size[1] // where.shape[0], columns * size[0] // where.shape[1]] = True
    return small


def colours_of(comparison: Comparison) -> ByteArray:
    """(F, 3) sRGB of every face."""
    return face_colours(comparison.scene, comparison.projected.camera)
