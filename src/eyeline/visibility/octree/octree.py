"""Hierarchical depth buffer: an octree from front to back, whole nodes left out that others hide. [Greene93]

A node whose box cannot be nearer than what stands before it is left out with all its faces, after one look
into a pyramid of depths. Time then grows with what is seen, not with what there is.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from eyeline.geometry.arrays import IntArray
from eyeline.geometry.coverage import Corner, Rectangle, clockwise, covered
from eyeline.geometry.fixedpoint import depth_at, depth_plane
from eyeline.geometry.memory import recycled
from eyeline.geometry.octree import BEGIN, CHILD, CHILDREN, END, POINT, POINTS, WIDTH
from eyeline.jit import share, threads
from eyeline.projection.cutting import cut_faces
from eyeline.projection.projected import Projected
from eyeline.projection.sides import sides_of
from eyeline.projection.vertices import place
from eyeline.visibility.method import Step, Visible, counted
from eyeline.visibility.octree.forest import Forest, of_faces, of_surfaces, on_grid, planted
from eyeline.visibility.octree.outlook import crossing, survey
from eyeline.visibility.octree.pyramid import SQUARE_BITS, TILE, key_of
from eyeline.visibility.octree.recall import recalled
from eyeline.visibility.octree.walking import COUNTERS, walk_tiles

NONE = np.empty(0, np.int32)
NOWHERE = np.empty(0, np.int64)
WORK = ("nodes visited", "nodes hidden", "faces drawn", "depth tests")  # what is counted

Picture = tuple[int, int, int, int]  # width, height, and the shift of the samples, 1/256 pixel


class Grove(NamedTuple):
    """A forest, and where its walks start: at the leaves of the hint, then at the roots."""

    forest: Forest
    starts: (
        IntArray  # (K, 7) int64 key, left, top, right, bottom, node, standing; the nearest first in each part
    )
    reminders: int  # how many of them are leaves of the hint
    recalled: (
        IntArray  # (R,) int64, rising: standing * nodes + leaf of the hint, drawn when the roots are walked
    )


@dataclass(frozen=True)
class Octree:
    """Octree and depth pyramid: answers every scene, in time that grows with what is seen of it.

    hint: what another frame saw, a film's last for example. Its faces are drawn first: that changes the work,
    never the answer.
    """

    hint: Visible | None = None
    name: str = "octree"
    space: str = "image"
    answers: bool = True
    exact: bool = True

    def __call__(self, projected: Projected) -> Visible:
        """The nearest face at every pixel."""
        parts, picture = threads(), picture_of(projected)
        face = recycled((projected.height, projected.width), np.int32)
        depth = recycled(face.shape, np.float32)
        grid, meshes = groves_of(projected, self.hint)
        work = np.zeros((parts, COUNTERS), np.int64)
        flat = depth.view(np.int32).reshape(-1), face.reshape(-1)
        share(lambda part: walk_tiles(part, parts, picture, grid, meshes, *flat, work[part]), parts)
        counted = dict(zip(WORK, work.sum(axis=0).tolist(), strict=True))
        return Visible(face, depth, projected, self, {"faces": projected.face_count, **counted})

    def steps(self, projected: Projected) -> Iterator[Step]:
        """Node by node: hidden, or opened; in leaves face by face; the last step holds the picture."""
        width, height = projected.width, projected.height
        work = {"faces": projected.face_count, **dict.fromkeys(WORK, 0)}
        canvas = Canvas(picture_of(projected), np.zeros((height, width), np.int64), work)
        groves = groves_of(projected, self.hint)
        for top in range(0, height, TILE):
            for left in range(0, width, TILE):
                tile = (left, top, min(left + TILE, width) - 1, min(top + TILE, height) - 1)
                for one in groves:
                    yield from canvas.walked(one, tile)
        depth = (canvas.keys >> 32).astype(np.int32).view(np.float32)
        face = np.where(depth > 0, ~canvas.keys.astype(np.int32), np.int32(-1))
        yield Step("done", "every node is drawn or hidden", {"face": face, "depth": depth}, dict(work))


def picture_of(projected: Projected) -> Picture:
    """What a walk must know of the picture; vertices of faces on the grid are shifted already."""
    return projected.width, projected.height, *(projected.shift if projected.standing_by else (0, 0))


def groves_of(projected: Projected, hint: Visible | None) -> tuple[Grove, Grove]:
    """Faces that are on the grid, and meshes as they stand; each drawn face is in one of them."""
    picture = picture_of(projected)
    if projected.standing_by is None:
        return grove(of_faces(projected), picture), grove(planted([]), picture)
    meshes = of_surfaces(projected, projected.standing_by)
    leaves = NOWHERE if hint is None else recalled(meshes, hint.face)
    return grove(pieces_of(projected, meshes), picture), grove(meshes, picture, leaves)


def grove(forest: Forest, picture: Picture, leaves: IntArray = NOWHERE) -> Grove:
    """A forest and the starts of its walk; leaves: standing * nodes + leaf of those to begin with."""
    standings, nodes = np.divmod(leaves, max(1, len(forest.nodes) // WIDTH))
    reminders = seen_of(forest, standings, nodes, picture)
    roots = seen_of(forest, np.arange(len(forest.roots)), forest.roots, picture)
    return Grove(forest, np.concatenate([reminders, roots]), len(reminders), leaves)


def seen_of(forest: Forest, standings: IntArray, nodes: IntArray, picture: Picture) -> IntArray:
    """(K, 7) those nodes that can be seen, the nearest first: greatest key, pixels, node and standing."""
    outlooks = np.empty((len(nodes), 5), np.int64)
    survey(forest, standings.astype(np.int32), nodes.astype(np.int32), picture, outlooks)
    rows = np.concatenate([outlooks, nodes[:, None], standings[:, None]], axis=1, dtype=np.int64)
    return rows[np.argsort(-outlooks[:, 0], kind="stable")][: int((outlooks[:, 0] > 0).sum())]


def pieces_of(projected: Projected, meshes: Forest) -> Forest:
    """The pieces of faces that the near plane or the guard band cuts, on the grid."""
    found = np.empty((1024, 2), np.int32)
    while (count := crossing(meshes, picture_of(projected), found)) > len(found):
        found = np.empty((count, 2), np.int32)
    corners, numbers, sides = [np.empty((0, 3), np.float32)], [NONE], [NONE.astype(np.uint8)]
    for standing in np.unique(found[:count, 0]):
        rows = found[:count, 1][found[:count, 0] == standing]
        first = int(meshes.firsts[standing])
        number = int(np.searchsorted(projected.first_faces, first, side="right")) - 1
        xy, depth, source = cut_faces(projected, number, rows)
        corners.append(np.concatenate([xy, depth[..., None]], axis=-1).astype(np.float32).reshape(-1, 3))
        numbers.append(source + np.int32(first))
        own = sides_of(projected.surfaces[number], projected.standing_by or "auto")
        sides.append(np.broadcast_to(np.uint8(own), len(projected.surfaces[number].mesh.faces))[source])
    points = np.concatenate(corners)
    faces = np.arange(len(points), dtype=np.int32).reshape(-1, 3)
    return on_grid(points, faces, np.concatenate(numbers), np.concatenate(sides))


# --- the same, to be read ---------------------------------------------------------------------------------


class Part(NamedTuple):
    """A node as it is seen: its greatest key, and the pixels it can cover."""

    key: int
    left: int
    top: int
    right: int
    bottom: int
    node: int
    standing: int

    def within(self, tile: Rectangle) -> Rectangle | None:
        """The pixels of a tile that it can cover."""
        left, top = max(self.left, tile[0]), max(self.top, tile[1])
        right, bottom = min(self.right, tile[2]), min(self.bottom, tile[3])
        return (left, top, right, bottom) if left <= right and top <= bottom else None


@dataclass(frozen=True, eq=False)
class Canvas:
    """A picture in the making, walked in Python."""

    picture: Picture
    keys: IntArray  # (H, W) int64: the greatest so far at every pixel, 0 where there is none
    work: dict[str, int]

    def walked(self, grove: Grove, tile: Rectangle) -> Iterator[Step]:
        """A grove in one tile: each start in order, below it from front to back."""
        drawn = set(grove.recalled.tolist())
        for number, start in enumerate(grove.starts.tolist()):
            waiting = [Part(*start)]
            while waiting:
                part = waiting.pop()
                if not part.within(tile):
                    continue
                place = part.standing * (len(grove.forest.nodes) // WIDTH) + part.node
                known = number >= grove.reminders and place in drawn
                children = yield from self.visited(grove.forest, part, tile, known)
                waiting += [Part(*row) for row in children[::-1].tolist()]

    def visited(
        self, forest: Forest, part: Part, tile: Rectangle, known: bool
    ) -> Generator[Step, None, IntArray]:
        """Leave a node out, draw it if it is a leaf not yet known, or tell its children, nearest first."""
        node = forest.nodes.reshape(-1, WIDTH)[part.node]
        faces = f"a node of {counted(int(node[END] - node[BEGIN]), 'face')}"
        left, top, right, bottom = rectangle = part.within(tile) or tile
        box = (left, top, right + 1, bottom + 1)
        children = np.arange(node[CHILD], node[CHILD] + node[CHILDREN])
        self.work["nodes visited"] += 1
        if part.key <= self.farthest(rectangle):
            self.work["nodes hidden"] += 1
            data = {"rectangle": box, "verdict": "dropped"}
            yield Step("hidden", f"{faces} lies behind what is drawn", data, dict(self.work))
            children = children[:0]
        elif len(children):
            data = {"rectangle": box, "verdict": "split"}
            yield Step("opened", f"{faces} may be seen and is opened", data, dict(self.work))
        elif not known:
            data = {"rectangle": box, "verdict": "kept"}
            yield Step("leaf", f"{faces} may be seen and is drawn", data, dict(self.work))
            yield from self.drawn(forest, part.standing, node, tile)
        return seen_of(forest, np.full_like(children, part.standing), children, self.picture)

    def farthest(self, rectangle: Rectangle) -> int:
        """The least key in a rectangle, or in all small squares that a larger one touches: the pyramid's."""
        left, top, right, bottom = rectangle
        if max(right - left, bottom - top) >> SQUARE_BITS:
            left, top = (side >> SQUARE_BITS << SQUARE_BITS for side in (left, top))
            right, bottom = (side | (1 << SQUARE_BITS) - 1 for side in (right, bottom))
        return int(self.keys[top : bottom + 1, left : right + 1].min())

    def drawn(self, forest: Forest, standing: int, leaf: IntArray, tile: Rectangle) -> Iterator[Step]:
        """Every face of a leaf, compared at the pixels it covers."""
        corners = self.placed(forest, standing, leaf)
        at, step = forest.sides_at[standing].tolist()
        for slot in range(leaf[BEGIN], leaf[END]):
            self.work["faces drawn"] += 1
            number = int(forest.numbers[slot] + forest.firsts[standing])
            three = [corners[k] for k in forest.corners[3 * slot : 3 * slot + 3]]
            turned = clockwise(three, int(forest.sides[at + step * slot]))
            if turned is None or not np.isfinite([corner[2] for corner in three]).all():
                continue
            a, b, c = depth_plane(*turned[0], *turned[1], *turned[2])
            taken, tried = [], list(covered(turned, tile))
            for x, y in tried:
                key = key_of(depth_at(a, b, c, x, y), number)
                if key > self.keys[y, x]:
                    self.keys[y, x] = key
                    taken.append((x, y))
            self.work["depth tests"] += len(tried)
            pixels = counted(len(tried), "pixel")
            sentence = f"face {number} covers {pixels} and is the nearest so far at {len(taken)}"
            verdict = "kept" if taken else "dropped"
            data = {"face": number, "pixels": taken, "tested": tried, "verdict": verdict}
            yield Step("drawn", sentence, data, dict(self.work))

    def placed(self, forest: Forest, standing: int, leaf: IntArray) -> list[Corner]:
        """The vertices of a leaf on the picture's grid."""
        width, height, dx, dy = self.picture
        points = forest.points.reshape(-1, 3)[leaf[POINT] : leaf[POINTS]]
        xy, depth = points[:, :2].astype(np.int32), points[:, 2].copy()
        if not forest.on_grid:
            place(points, forest.matrices[standing].reshape(4, 4), (width, height), xy, depth)
        return [(int(x) - dx, int(y) - dy, z) for (x, y), z in zip(xy, depth, strict=True)]
