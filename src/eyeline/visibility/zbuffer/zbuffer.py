"""The depth buffer: every pixel keeps the nearest of all that fall on it. [Catmull74, Strasser74]"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from eyeline.geometry.arrays import IntArray, read_only
from eyeline.geometry.coverage import box_of, clockwise, covered
from eyeline.geometry.fixedpoint import depth_at, depth_plane
from eyeline.geometry.memory import recycled
from eyeline.jit import share, threads
from eyeline.projection.projected import Projected
from eyeline.visibility.method import Step, Visible, counted
from eyeline.visibility.zbuffer import scratch as shelf
from eyeline.visibility.zbuffer.bands import draw_bands
from eyeline.visibility.zbuffer.binning import bin_faces

WORK = ("faces", "faces turned away", "faces beside pixels", "depth tests")  # what is counted
FEW = 1 << 13  # faces: sooner binned than handed to a second thread


@dataclass(frozen=True)
class ZBuffer:
    """Depth buffer: answers every scene, in time that grows with faces and covered pixels, in any order."""

    name: str = "zbuffer"
    space: str = "image"
    answers: bool = True
    exact: bool = True

    def __call__(self, projected: Projected) -> Visible:
        """The nearest face at every pixel."""
        height, width, parts = projected.height, projected.width, threads()
        face = recycled((height, width), np.int32)
        depth = recycled((height, width), np.float32)
        scratch = shelf.take(parts, (width, height), len(projected.faces))
        scratch, counts = binned(projected, scratch, parts if len(projected.faces) > FEW else 1)
        flat = depth.view(np.int32).reshape(-1), face.reshape(-1)
        tests = share(lambda part: draw_bands(part, parts, (width, height), scratch, *flat), parts)
        shelf.give_back(scratch)
        return Visible(face, depth, projected, self, work_of(projected, counts, sum(tests)))

    def steps(self, projected: Projected) -> Iterator[Step]:
        """Face by face: dropped, or compared at every pixel it covers; the last step holds the picture."""
        face = np.full((projected.height, projected.width), -1, dtype=np.int32)
        depth = np.zeros(face.shape, dtype=np.float32)
        work = dict.fromkeys(WORK, 0)
        picture = (0, 0, projected.width - 1, projected.height - 1)
        sides = np.broadcast_to(projected.sides, len(projected.faces)).tolist()
        for number, source in enumerate(projected.source.tolist()):
            work["faces"] += 1
            own = projected.faces[number]
            vertices = zip(projected.xy[own].tolist(), projected.depth[own], strict=True)
            corners = clockwise([(x, y, z) for (x, y), z in vertices], sides[number])
            if corners is None:
                work["faces turned away"] += 1
                yield Step("dropped", f"face {source} turns away", {"face": source}, dict(work))
                continue
            if not all(box_of(corners, picture)):
                work["faces beside pixels"] += 1
                yield Step("dropped", f"face {source} lies beside every pixel", {"face": source}, dict(work))
                continue
            a, b, c = depth_plane(*corners[0], *corners[1], *corners[2])
            taken, tried = [], list(covered(corners, picture))
            for x, y in tried:
                own = depth_at(a, b, c, x, y)
                # Nearer is greater; a tie goes to the lower face; 0 is as far as the back, which is nothing
                if own > depth[y, x] or (own == depth[y, x] > 0 and source < face[y, x]):
                    face[y, x], depth[y, x] = source, own
                    taken.append((x, y))
            work["depth tests"] += len(tried)
            pixels = counted(len(tried), "pixel")
            sentence = f"face {source} covers {pixels} and is the nearest so far at {len(taken)}"
            data = {
                "face": source,
                "pixels": taken,
                "tested": tried,
                "verdict": "kept" if taken else "dropped",
            }
            yield Step("drawn", sentence, data, dict(work))
        yield Step("done", "every face was drawn", {"face": face, "depth": depth}, dict(work))


def binned(projected: Projected, scratch: shelf.Scratch, parts: int) -> tuple[shelf.Scratch, IntArray]:
    """All faces in the bins of so many parts of `scratch`, or of a larger one; with their counters."""
    faces, sides = read_only(projected.faces).reshape(-1), read_only(projected.sides)
    corners, depth = read_only(projected.xy.view(np.int64)).reshape(-1), read_only(projected.depth)
    uncut, pieces = projected.face_count, read_only(projected.piece_source)
    size = projected.width, projected.height
    counts = np.zeros((parts, 64), dtype=np.int64)
    scratch.ends[parts:] = 0

    def bin_part(room: shelf.Scratch, part: int) -> None:
        bin_faces(part, parts, faces, corners, depth, sides, uncut, pieces, size, room, counts[part])

    while True:
        share(partial(bin_part, scratch), parts)
        larger = shelf.grown(scratch, int(counts[:, 0].max()), int(counts[:, 1].max()))
        if larger is None:
            return scratch, counts.sum(axis=0)
        scratch = larger


def work_of(projected: Projected, counts: IntArray, tests: int) -> Mapping[str, int]:
    """The counters, named."""
    numbers = (len(projected.faces), int(counts[2]), int(counts[3]), tests)
    return dict(zip(WORK, numbers, strict=True))
