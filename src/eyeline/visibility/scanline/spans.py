"""Spans: runs of pixels of one face on a row, what a scan line method answers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.cached import cached_property
from eyeline.geometry.arrays import IntArray
from eyeline.visibility.method import Visible


@dataclass(frozen=True, eq=False)
class Spans:
    """A picture as runs of one face, row by row, each as long as it can be: S of them cover it once."""

    begins: IntArray  # (H + 1,) int64: row y has the spans begins[y] up to begins[y + 1]
    first: IntArray  # (S,) int32: the first column
    last: IntArray  # (S,) int32: the last column
    face: IntArray  # (S,) int32: scene face; -1 is background

    def __len__(self) -> int:
        return len(self.face)

    @property
    def row(self) -> IntArray:
        """(S,) int32: the row of every span."""
        counts = np.diff(self.begins)
        return np.repeat(np.arange(len(counts), dtype=np.int32), counts)

    @property
    def rectangles(self) -> IntArray:
        """(S, 4) int32: left, top, right and bottom of every span, in pixels, to be drawn."""
        row = self.row
        return np.stack([self.first, row, self.last + 1, row + 1], axis=1)

    @property
    def picture(self) -> IntArray:
        """(H, W) int32: the face at every pixel."""
        rows = len(self.begins) - 1
        return np.repeat(self.face, self.last - self.first + 1).reshape(rows, -1)


def spans_of(face: IntArray) -> Spans:
    """The spans of a picture (H, W)."""
    begin = np.ones(face.shape, dtype=bool)
    np.not_equal(face[:, 1:], face[:, :-1], out=begin[:, 1:])
    begins = np.concatenate([[0], np.cumsum(begin.sum(axis=1))])
    row, first = np.nonzero(begin)
    # The next one begins behind it, or it ends with its row
    last = np.append(first[1:], 0) - 1
    last[begins[1:] - 1] = face.shape[1] - 1
    return Spans(begins, first.astype(np.int32), last.astype(np.int32), face[row, first])


@dataclass(frozen=True, eq=False)
class Scanned(Visible):
    """A scan line method's answer: what is seen, and the spans it is seen in."""

    @cached_property
    def spans(self) -> Spans:
        """The spans of all rows; `work` counted as many."""
        return spans_of(self.face)
