"""The depth buffer: every pixel keeps the nearest of all that fall on it. [Catmull74, Strasser74]"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray, read_only
from eyeline.geometry.memory import recycled
from eyeline.jit import share, threads
from eyeline.projection.projected import Projected
from eyeline.visibility import scratch as shelf
from eyeline.visibility.bands import draw_bands
from eyeline.visibility.binning import bin_faces
from eyeline.visibility.method import Step, Visible


@dataclass(frozen=True)
class ZBuffer:
    """Depth buffer: answers every scene, in time that grows with faces and covered pixels, in any order."""

    name: str = "zbuffer"
    space: str = "image"
    answers: bool = True

    def __call__(self, projected: Projected) -> Visible:
        """The nearest face at every pixel."""
        height, width, parts = projected.height, projected.width, threads()
        face = recycled((height, width), np.int32)
        depth = recycled((height, width), np.float32)
        scratch = shelf.take(parts, (height - 1 >> shelf.BAND_BITS) + 1, len(projected.faces))
        scratch, counts = binned(projected, scratch, parts)
        flat = depth.view(np.int32).reshape(-1), face.reshape(-1)
        tests = share(lambda part: draw_bands(part, parts, (width, height), scratch, *flat), parts)
        shelf.give_back(scratch)
        return Visible(face, depth, projected, self, work_of(projected, counts, sum(tests)))


def binned(projected: Projected, scratch: shelf.Scratch, parts: int) -> tuple[shelf.Scratch, IntArray]:
    """All faces in the bins of `scratch`, or of a larger one; with the counters of every part."""
    faces, sides = read_only(projected.faces).reshape(-1), read_only(projected.sides)
    corners, depth = read_only(projected.xy.view(np.int64)).reshape(-1), read_only(projected.depth)
    uncut, pieces = projected.face_count, read_only(projected.piece_source)
    size = projected.width, projected.height
    counts = np.zeros((parts, 64), dtype=np.int64)
    while True:
        room = scratch
        share(
            lambda p: bin_faces(p, parts, faces, corners, depth, sides, uncut, pieces, size, room, counts[p]),
            parts,
        )
        larger = shelf.grown(scratch, int(counts[:, 0].max()), int(counts[:, 1].max()))
        if larger is None:
            return scratch, counts.sum(axis=0)
        scratch = larger


def work_of(projected: Projected, counts: IntArray, tests: int) -> Mapping[str, int]:
    """The counters, named."""
    return {
        "faces": len(projected.faces),
        "faces turned away": int(counts[2]),
        "faces between pixel centres": int(counts[3]),
        "records": int(counts[1]),
        "bin entries": tests,
    }
