"""What every visible-surface method takes, answers and counts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from eyeline.cached import cached_property
from eyeline.geometry.arrays import FloatArray, IntArray, read_only
from eyeline.jit import kernel, share, threads
from eyeline.projection.projected import Projected
from eyeline.scene.scene import Scene

if TYPE_CHECKING:
    from eyeline.visibility.area import Area
    from eyeline.visibility.visible_edges import VisibleEdges


@dataclass(frozen=True)
class Step:
    """One event of a method at work: what it did, in a sentence, with the numbers it did it with.

    What `data` holds under these names can be drawn, for every method alike; places are in pixels:
    face, faces: scene faces it is about; pixels: [(x, y), ...] where `face` is the nearest so far;
    tested: [(x, y), ...] where it was compared; rectangle, rectangles: (left, top, right, bottom);
    polygon, polygons: (N, 2) corners; segments: (N, 2, 2); hidden: (N, 2, 2) segments not seen;
    verdict: "kept", "dropped" or "split". The last step is "done" and holds the answer: face and depth
    (H, W), or segments and hidden.
    """

    kind: str
    sentence: str
    data: Mapping[str, Any]
    work: Mapping[str, int]  # the counters so far


class Method(Protocol):
    """A visible-surface algorithm: a frozen object with its parameters."""

    @property
    def name(self) -> str:
        """Its key in METHODS."""

    @property
    def space(self) -> str:
        """'object' or 'image': where it decides."""

    @property
    def answers(self) -> bool:
        """Whether it answers the pixels of every scene alone: then it is a PixelMethod."""

    @property
    def exact(self) -> bool:
        """Whether it decides by the picture's grid and its one formula for depth.

        Exact methods agree bit for bit; others agree wherever rounding cannot matter.
        """

    def __call__(self, projected: Projected) -> Visible | VisibleEdges:
        """What is seen: the face at every pixel, or the parts of edges."""

    def steps(self, projected: Projected) -> Iterator[Step]:
        """The same decisions one by one, for reading: plain Python, small scenes."""


class PixelMethod(Method, Protocol):
    """A method that answers the pixels of every scene."""

    def __call__(self, projected: Projected) -> Visible:
        """What is seen at every pixel."""


@dataclass(frozen=True, eq=False)
class Visible:
    """A method's answer: the face and the depth at every pixel."""

    face: IntArray  # (H, W) int32: scene face; -1 is background
    depth: FloatArray  # (H, W) float32, reversed; 0 is background
    projected: Projected
    method: PixelMethod
    work: Mapping[str, int]  # counters
    scene: Scene | None = None  # for node names

    @cached_property
    def node(self) -> IntArray:
        """(H, W) int32: the node of the face at every pixel; -1 is background."""
        return nodes_of(self.face, self.projected)

    @cached_property
    def distance(self) -> FloatArray:
        """(H, W) float32: metres along the view axis; inf is background."""
        camera = self.projected.camera
        matrix = camera.clip_from_eye(self.projected.width / self.projected.height)
        slope, offset = (np.float32(number) for number in matrix[2, 2:])
        with np.errstate(divide="ignore"):
            # Solved for the distance: depth = (offset - slope distance) / distance, or the same undivided
            far = offset / (self.depth + slope) if camera.fov is not None else (offset - self.depth) / slope
        return np.where(self.depth > 0, far, np.float32(np.inf))

    def area(self, node: str | int) -> Area:
        """How much of a node, and of what hangs from it, is seen, and what hides the rest."""
        from eyeline.visibility.area import area_of

        return area_of(self, node)


def counted(count: int, noun: str) -> str:
    """How many of something, in words: 1 pixel, 3 pixels."""
    return f"{count:,} {noun}{'s' * (count != 1)}"


def nodes_of(face: IntArray, projected: Projected) -> IntArray:
    """The node of every face in an array of scene faces; -1 stays -1."""
    nodes = np.array([surface.node for surface in projected.surfaces], dtype=np.int32)
    node = np.empty(face.shape, dtype=np.int32)
    flat, firsts, parts = read_only(face).reshape(-1), read_only(projected.first_faces), threads()
    share(lambda part: _nodes_of(part, parts, flat, firsts, nodes, node.reshape(-1)), parts)
    return node


@kernel
def _nodes_of(part, parts, face, firsts, nodes, node):
    begin, end, count = face.shape[0] * part // parts, face.shape[0] * (part + 1) // parts, nodes.shape[0]
    surface = 0
    for i in range(begin, end):
        number = face[i]
        if number < 0:
            node[i] = -1
            continue
        if not firsts[surface] <= number < firsts[surface + 1]:
            # The last surface whose first face is not after this one
            surface, above = 0, count
            while above - surface > 1:
                middle = (surface + above) >> 1
                if firsts[middle] <= number:
                    surface = middle
                else:
                    above = middle
        node[i] = nodes[surface]
