"""The walk of a tile's rays through a tree, to be read: what `packets` does, event by event."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from eyeline.geometry.arrays import ByteArray, FloatArray, IntArray
from eyeline.geometry.bvh import CHILD, EXTENT, MIDDLE, NO_CHILD, NO_FACE, NUMBER
from eyeline.geometry.crossing import crosses, exact_crosses, side_shown
from eyeline.visibility.method import Step, counted
from eyeline.visibility.raycast.casts import Cast
from eyeline.visibility.raycast.tiles import ROUNDING, SLACK, TILE, counts_for


class Range(NamedTuple):
    """Columns x0 .. x1 and rows y0 .. y1 of a tile, both ends within."""

    x0: int
    x1: int
    y0: int
    y1: int

    @property
    def is_empty(self) -> bool:
        """Whether no pixel is in it."""
        return self.x0 > self.x1 or self.y0 > self.y1

    def within(self, other: Range) -> Range:
        """What both have in common."""
        return Range(
            max(self.x0, other.x0), min(self.x1, other.x1), max(self.y0, other.y0), min(self.y1, other.y1)
        )


class Waiting(NamedTuple):
    """A node, or ~leaf, that the rays of some pixels may have to look into."""

    nearest: np.float32  # distance to its box
    item: int
    pixels: Range


@dataclass(frozen=True, eq=False)
class Sight:
    """What the rays of a picture have hit so far, and what counts as seen."""

    face: IntArray  # (H, W)
    distance: FloatArray  # (H, W) float32
    sides: ByteArray
    lens: tuple[float, float, float, float]  # see `lens_of`
    work: dict[str, int]


@dataclass(frozen=True, eq=False)
class Packet:
    """The rays of one tile before one surface."""

    sight: Sight
    cast: Cast
    left: int  # the tile's first column
    top: int  # and row

    @property
    def middle(self) -> tuple[float, float]:
        """Of the tile, in pixels' centres."""
        return self.left + (TILE - 1) / 2, self.top + (TILE - 1) / 2

    def rectangle(self, pixels: Range) -> tuple[int, int, int, int]:
        """A range, in the picture."""
        return (
            self.left + pixels.x0,
            self.top + pixels.y0,
            self.left + pixels.x1 + 1,
            self.top + pixels.y1 + 1,
        )

    def steps(self) -> Iterator[Step]:
        """From the root down, the nearest box first."""
        height, width = self.sight.face.shape
        every = Range(0, min(TILE, width - self.left) - 1, 0, min(TILE, height - self.top) - 1)
        nearest = max(np.float32(self.sight.lens[2]), np.float32(self.cast.nearest))
        waiting = [Waiting(nearest, 0, every)]
        while waiting:
            here = waiting.pop()
            left, top, right, bottom = self.rectangle(here.pixels)
            if not (self.sight.distance[top:bottom, left:right] >= here.nearest).any():
                yield self.told("hidden", "lies behind what its rays have hit", here, verdict="dropped")
            elif here.item >= 0:
                found = list(self.children(here))
                self.sight.work["nodes opened"] += 1
                boxes = [self.rectangle(one.pixels) for one in found]
                yield self.told("opened", opens(len(found)), here, rectangles=boxes, verdict="split")
                # The nearest is looked into first
                waiting += sorted(found, key=lambda one: -one.nearest)
            else:
                self.sight.work["leaves opened"] += 1
                yield self.told("leaf", "is a leaf: its faces are tested", here, verdict="kept")
                yield from self.leaf(here)

    def told(self, kind: str, what: str, here: Waiting, **data: object) -> Step:
        """A step about a box."""
        rays = (here.pixels.x1 - here.pixels.x0 + 1) * (here.pixels.y1 - here.pixels.y0 + 1)
        sentence = f"a box {here.nearest:.4g} m away, in the way of {counted(rays, 'ray')}, {what}"
        return Step(kind, sentence, {"rectangle": self.rectangle(here.pixels), **data}, dict(self.sight.work))

    def children(self, here: Waiting) -> Iterator[Waiting]:
        """The boxes of a node that rays can meet: in float32, each as much larger as that may be wrong."""
        w0, w1, near, far = (np.float32(number) for number in self.sight.lens)
        node, tree = self.cast.tree.nodes[here.item], self.cast.tree
        middles, extents = node[MIDDLE : MIDDLE + 3], node[EXTENT : EXTENT + 3]
        reach = np.append(np.maximum(np.abs(tree.low), np.abs(tree.high)), 1.0)
        spans = []
        for row in self.rows():
            m, size = row.astype(np.float32), np.abs(row).astype(np.float32)
            terms = np.abs(row) * reach
            pad = np.float32((((terms[0] + terms[1]) + terms[2]) + terms[3]) * ROUNDING)
            middle = m[3] + m[0] * middles[0] + m[1] * middles[1] + m[2] * middles[2]
            extent = pad + size[0] * extents[0] + size[1] * extents[1] + size[2] * extents[2]
            spans.append((middle - extent, middle + extent))
        begin, end = spans[2]
        per_near = 1 / np.maximum(w0 + w1 * begin, w0 + w1 * near)
        per_far = 1 / np.maximum(w0 + w1 * end, w0 + w1 * near)
        edges = []
        for low, high in spans[:2]:
            edges += [first_pixels(low * np.where(low > 0, per_far, per_near))]
            edges += [last_pixels(high * np.where(high > 0, per_near, per_far))]
        for j, child in enumerate(tree.children[here.item, CHILD].tolist()):
            pixels = Range(*(int(edge[j]) for edge in edges)).within(here.pixels)
            beside = end[j] < near or begin[j] > far or child == NO_CHILD
            if not beside and not pixels.is_empty:
                yield Waiting(max(begin[j], near), child, pixels)

    def rows(self) -> FloatArray:
        """(3, 4) float64: x w, y w from the tile's middle, and distance."""
        w0, w1, _, _ = self.sight.lens
        view = self.cast.view.reshape(3, 4)
        w = w1 * view[2] + np.array([0, 0, 0, w0])
        return np.stack([view[0] - self.middle[0] * w, view[1] - self.middle[1] * w, view[2]])

    def leaf(self, here: Waiting) -> Iterator[Step]:
        """Every face of a leaf against every ray that may go through it."""
        w0, w1, near, _ = self.sight.lens
        tree, view = self.cast.tree, self.cast.view.reshape(3, 4)
        points = tree.leaves[~here.item, :NUMBER].reshape(3, 3, -1).astype(np.float64)
        # (3 corners, 3 rows, 8 faces)
        seen = np.stack([[r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + r[3] for r in view] for p in points])
        w = w0 + w1 * seen[:, 2]
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            per_w = np.float32(1) / w.astype(np.float32)
            x, y = ((seen[:, k] - self.middle[k] * w).astype(np.float32) * per_w for k in range(2))
            ends = [
                first_pixels(x.min(0)),
                last_pixels(x.max(0)),
                first_pixels(y.min(0)),
                last_pixels(y.max(0)),
            ]
        before = seen[:, 2].astype(np.float32).min(axis=0) < np.float32(near)
        for j, number in enumerate(tree.numbers[~here.item, NUMBER].tolist()):
            own = Range(*(int(edge[j]) for edge in ends)).within(here.pixels)
            # One that begins before the near plane may be anywhere
            pixels = here.pixels if before[j] else own
            face = number + self.cast.place[0]
            if number == NO_FACE or pixels.is_empty:
                continue
            if sides := int(self.sight.sides[min(face, len(self.sight.sides) - 1)]):
                yield self.tested(face, seen[:, :, j].tolist(), sides, pixels)

    def tested(self, face: int, corners: list[list[float]], sides: int, pixels: Range) -> Step:
        """One face against the rays of some pixels."""
        sight, (_, _, near, far) = self.sight, self.sight.lens
        left, top, right, bottom = self.rectangle(pixels)
        places = [(x, y) for y in range(top, bottom) for x in range(left, right)]
        taken = []
        for x, y in places:
            hit = crossed(corners, float(x), float(y), sides, sight.lens)
            if hit is None or hit < np.float32(near) or float(hit) >= far:
                continue
            best = sight.distance[y, x]
            if hit < best or (hit == best and face < sight.face[y, x]):
                sight.distance[y, x], sight.face[y, x] = hit, face
                taken.append((x, y))
        sight.work["faces tested"] += 1
        sight.work["ray tests"] += len(places)
        rays = counted(len(places), "ray")
        sentence = f"face {face} is tested by {rays} and is the nearest so far for {len(taken)}"
        verdict = "kept" if taken else "dropped"
        data = {"face": face, "pixels": taken, "tested": places, "verdict": verdict}
        return Step("tested", sentence, data, dict(sight.work))


def opens(boxes: int) -> str:
    """What becomes of a node that is opened."""
    if not boxes:
        return "holds no smaller box that they can meet"
    return f"is opened: they can meet {boxes} smaller box{'es' * (boxes != 1)}"


def first_pixels(low: FloatArray) -> IntArray:
    """The first pixels of a tile centred at `low` pixels from its middle, or after."""
    place = low + np.float32(TILE / 2 + 0.5) - SLACK
    pixels: IntArray = np.clip(place, np.float32(0), np.float32(TILE)).astype(np.int32)
    return pixels


def last_pixels(high: FloatArray) -> IntArray:
    """The last pixels of a tile centred before `high` pixels from its middle, or -1."""
    place = high + np.float32(TILE / 2 + 0.5) + SLACK
    pixels: IntArray = np.clip(place, np.float32(0), np.float32(TILE)).astype(np.int32) - 1
    return pixels


def crossed(
    corners: list[list[float]], x: float, y: float, sides: int, lens: tuple[float, float, float, float]
) -> np.float32 | None:
    """How far a pixel's ray goes to a face, if it goes through a side of it that counts."""
    w0, w1, _, _ = lens
    # Corners as the ray sees them: it stands at 0
    (ax, ay), (bx, by), (cx, cy) = ((xw - x * (w0 + w1 * d), yw - y * (w0 + w1 * d)) for xw, yw, d in corners)
    u, v, w, unsure = crosses(ax, ay, bx, by, cx, cy)
    if unsure:
        u, v, w = exact_crosses(ax, ay, bx, by, cx, cy)
    if not counts_for(side_shown(u, v, w), sides):
        return None
    (_, _, ad), (_, _, bd), (_, _, cd) = corners
    return np.float32((u * ad + v * bd + w * cd) / (u + v + w))
