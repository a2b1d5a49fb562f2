"""Ray casting: a ray through every pixel's centre, and the first face it meets. [Appel68]

Every mesh has a tree of its own, kept for as long as the mesh lives; rays come into the mesh's own space, so
that a node that moves, or a mesh that stands in many places, costs nothing more.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import ByteArray, IntArray, read_only
from eyeline.geometry.memory import recycled
from eyeline.jit import in_parts, kernel, share, threads
from eyeline.projection.projected import Projected
from eyeline.visibility.method import Step, Visible
from eyeline.visibility.raycast.casts import casts_of, lens_of
from eyeline.visibility.raycast.packet_steps import Packet, Sight
from eyeline.visibility.raycast.packets import trace_tiles
from eyeline.visibility.raycast.tiles import TILE

WORK = ("rays", "nodes opened", "leaves opened", "faces tested", "ray tests")  # what is counted

LEAST_DEPTH = np.finfo(np.float32).tiny


@dataclass(frozen=True)
class RayCast:
    """Ray casting over a tree of boxes: answers every scene; time grows with pixels, hardly with faces."""

    name: str = "raycast"
    space: str = "image"
    answers: bool = True
    exact: bool = False

    def __call__(self, projected: Projected) -> Visible:
        """The first face that the ray through every pixel meets."""
        shape, parts = (projected.height, projected.width), threads()
        face, distance = recycled(shape, np.int32), recycled(shape, np.float32)
        face[:], distance[:] = -1, np.inf
        sides, lens = read_only(sides_of_faces(projected)), lens_of(projected)
        counts = np.zeros((parts, 8), np.int64)
        casts = casts_of(projected)

        def trace(part: int) -> None:
            for one in casts:
                rays = one.tree, one.view, lens, one.place, one.nearest
                trace_tiles(part, parts, *rays, sides, distance, face, counts[part])

        share(trace, parts)
        depth = distance.reshape(-1)
        in_parts(parts, to_depth, depth, depth_of(projected))
        return Visible(face, distance, projected, self, work_of(projected, counts.sum(axis=0)))

    def steps(self, projected: Projected) -> Iterator[Step]:
        """Surface by surface, tile by tile, down the tree: boxes opened or left aside, faces tested."""
        shape = projected.height, projected.width
        face, distance = np.full(shape, -1, np.int32), np.full(shape, np.inf, np.float32)
        work = dict.fromkeys(WORK, 0) | {"rays": face.size}
        sight = Sight(face, distance, sides_of_faces(projected), lens_of(projected), work)
        for one in casts_of(projected):
            _, left, right, top, bottom = one.place
            for row in range(top, bottom + 1):
                for column in range(left, right + 1):
                    yield from Packet(sight, one, column * TILE, row * TILE).steps()
        depth = distance.reshape(-1)
        to_depth(0, 1, depth, depth_of(projected))
        yield Step("done", "every ray has found its face", {"face": face, "depth": distance}, dict(work))


def sides_of_faces(projected: Projected) -> ByteArray:
    """(face_count,) or (1,) for all: the sides of faces that count; a cut one has those of its pieces."""
    if len(projected.sides) == 1:
        return projected.sides
    sides = projected.sides[: projected.face_count].copy()
    sides[projected.piece_source] = projected.sides[projected.face_count :]
    return sides


def depth_of(projected: Projected) -> tuple[float, float, float, float]:
    """(a, b, w0, w1): depth is (b - a distance) / (w0 + w1 distance), as the camera's lens has it."""
    clip = projected.camera.clip_from_eye(projected.width / projected.height)
    return float(clip[2, 2]), float(clip[2, 3]), float(clip[3, 3]), float(-clip[3, 2])


def work_of(projected: Projected, counts: IntArray) -> Mapping[str, int]:
    """The counters, named."""
    numbers = projected.width * projected.height, *(int(count) for count in counts[: len(WORK) - 1])
    return dict(zip(WORK, numbers, strict=True))


@kernel
def to_depth(part, parts, distance, lens):
    """Make reversed depth of distances; one that was hit is before the back, however that rounds."""
    a, b, w0, w1 = lens
    count = distance.shape[0]
    for i in range(count * part // parts, count * (part + 1) // parts):
        if distance[i] == np.float32(np.inf):
            distance[i] = np.float32(0)
            continue
        far = np.float64(distance[i])
        distance[i] = max(np.float32((b - a * far) / (w0 + w1 * far)), LEAST_DEPTH)
