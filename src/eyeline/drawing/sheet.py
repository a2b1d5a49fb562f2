"""A drawing ready for the pen, whatever file it goes to: groups of paths, each with a pen."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from eyeline.drawing.kinds import CREASE, KINDS
from eyeline.drawing.lines import Lines
from eyeline.drawing.pens import HIDDEN, PICTURE_HEIGHT, UNDER, VISIBLE, Pen
from eyeline.geometry.arrays import BoolArray, IntArray
from eyeline.geometry.normals import together

PARTS = 100  # of a pixel, to which places are rounded
SPECK = 12.0  # pixels of a picture PICTURE_HEIGHT high: shorter creases that touch no other line are noise


@dataclass(frozen=True, eq=False)
class Group:
    """Lines of one node drawn with one pen."""

    node: str  # its path in the scene
    kind: str
    seen: bool
    pen: Pen
    paths: tuple[IntArray, ...]  # (K, 2) hundredths of a pixel, x right, y down


@dataclass(frozen=True, eq=False)
class Sheet:
    """Groups in the order in which they are drawn, node after node."""

    size: tuple[int, int]  # pixels
    groups: tuple[Group, ...]
    title: str = ""
    metres: float | None = None  # in a pixel, everywhere: of an orthographic camera

    @property
    def nodes(self) -> Iterator[tuple[str, list[Group]]]:
        """Each node that has lines, and its groups."""
        names = dict.fromkeys(group.node for group in self.groups)
        return ((name, [group for group in self.groups if group.node == name]) for name in names)


def sheet_of(lines: Lines, names: Sequence[str], hidden: bool, title: str, metres: float | None) -> Sheet:
    """Lines with their pens; names: of the scene's nodes. hidden: whether hidden lines are drawn."""
    found: dict[tuple[int, bool, int], list[IntArray]] = {}
    factor = lines.size[1] / PICTURE_HEIGHT
    for path in lines.only(~specks(lines, SPECK * factor)).paths:
        points = plain(np.rint(path.points * PARTS).astype(np.int64))
        if (path.seen or hidden) and len(points) > 1:
            order = UNDER.index(KINDS[path.kind - 1])
            found.setdefault((path.node, path.seen, order), []).append(points)
    groups = []
    for (node, seen, order), paths in sorted(found.items()):
        pen = (VISIBLE if seen else HIDDEN)[UNDER[order]].scaled(factor)
        groups.append(Group(names[node], UNDER[order], seen, pen, tuple(paths)))
    return Sheet(lines.size, tuple(groups), title, metres)


def specks(lines: Lines, least: float) -> BoolArray:
    """(N,) which pieces are of creases shorter than `least` pixels that begin and end on a bare surface.

    What something hides in part, and what touches a line of another kind, is no speck however short.
    """
    ends = lines.name.reshape(-1)
    half = np.flatnonzero(ends >= 0)
    half = half[np.argsort(ends[half], kind="stable")]
    meet = ends[half[1:]] == ends[half[:-1]]
    group = together(len(lines.kind), half[:-1][meet] // 2, half[1:][meet] // 2)
    length = np.sqrt(((lines.pixels[:, 1] - lines.pixels[:, 0]) ** 2).sum(axis=1))
    total = np.bincount(group, weights=length, minlength=len(group))
    clear = (lines.kind == CREASE) & (lines.name >= 0).all(axis=1)
    bare = np.bincount(group, weights=~clear, minlength=len(group)) == 0
    short: BoolArray = (bare & (total < least))[group]
    return short


def plain(points: IntArray) -> IntArray:
    """A path (K, 2) without points that repeat the one before or lie straight between their neighbours."""
    moved = np.ones(len(points), bool)
    moved[1:] = (points[1:] != points[:-1]).any(axis=1)
    points = points[moved]
    if len(points) < 3:
        return points
    (ax, ay), (bx, by) = (points[1:-1] - points[:-2]).T, (points[2:] - points[1:-1]).T
    bends = np.ones(len(points), bool)
    bends[1:-1] = (ax * by != ay * bx) | (ax * bx + ay * by < 0)
    return points[bends]
