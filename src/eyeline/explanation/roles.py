"""How marks look, the same in films, pages and drawings."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from eyeline.explanation.explanation import Explanation
from eyeline.explanation.frames import Frame, Outlines, Points
from eyeline.geometry.arrays import IntArray

PAPER, STAGE, INK, FAINT = "#f7f5f0", "#ffffff", "#22252b", "#8b8f98"
CHANGED = "#b85f00"  # a counter that a step moved
NETWORK = "#c9ccd3"  # the faces' edges under everything


class Look(NamedTuple):
    """A stroke, and how much of its colour fills the inside."""

    meaning: str
    colour: str
    width: float  # of the stroke, in parts of a large pixel's side
    fill: float  # 0..1
    dashed: bool = False


ROLES = {
    "subject": Look("the face it is about", "#e07a00", 0.22, 0.18),
    "rival": Look("faces it meets", "#7b4fb0", 0.14, 0.08),
    "kept": Look("stays", "#1f8a4c", 0.22, 0.14),
    "dropped": Look("goes", "#c2342b", 0.22, 0.12),
    "split": Look("is cut", "#7b2fbf", 0.26, 0.0),
    "area": Look("an area", "#2b6cb0", 0.16, 0.06),
    "hidden": Look("is hidden", "#c2342b", 0.14, 0.0, dashed=True),
}
DOT = 0.14  # of a large pixel's side: the reach of a dot
INK_WIDTH = 0.5  # of their width, for marks that stay


def title_of(explanation: Explanation) -> str:
    """What heads an explanation."""
    return f"{explanation.method.name} · {explanation.scene.name or 'scene'}"


def notes_of(explanation: Explanation) -> str:
    """What is said beside the title: what is hard about the scene, what was made smaller."""
    return "; ".join((*explanation.scene.notes, *explanation.notices))


def legend(frames: Iterable[Frame]) -> dict[str, Look]:
    """The roles that some frames use, in the order of ROLES."""
    used = {mark.role for frame in frames for mark in (*frame.marks, *frame.ink)}
    return {role: look for role, look in ROLES.items() if role in used}


def network(explanation: Explanation) -> list[Points]:
    """Every face's outline."""
    outlines = Outlines(explanation.projected)
    return [corners for face in range(explanation.projected.face_count) for corners in outlines.of(face)]


def canvas(explanation: Explanation) -> IntArray:
    """(H, W) the face seen so far at every pixel; -1 is none."""
    return np.full((explanation.projected.height, explanation.projected.width), -1, dtype=np.int32)


def paint(seen: IntArray, frame: Frame) -> None:
    """Let a frame's pixels fall on a canvas."""
    for face, pixels in frame.painted:
        if len(pixels):
            columns, rows = np.asarray(pixels).T
            seen[rows, columns] = face


def runs(seen: IntArray) -> Iterator[tuple[int, int, int, int]]:
    """(row, first column, column after the last, face) of every run of one face along a row of a canvas."""
    for y in np.flatnonzero((seen >= 0).any(axis=1)).tolist():
        row = seen[y]
        starts = np.flatnonzero(np.diff(row, prepend=row[0] - 1)).tolist()
        for begin, end in zip(starts, [*starts[1:], len(row)], strict=True):
            if row[begin] >= 0:
                yield y, begin, end, int(row[begin])
