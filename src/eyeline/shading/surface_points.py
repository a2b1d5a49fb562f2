"""The places to shade: each face in each pixel once, however many samples see it.

Opaque faces and transparent fragments are both lists of surface points, and go through the same code:
`attributes(frame, points)` and `radiance(frame, points)`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.jit import kernel

GRID = 256  # sample shifts are whole parts of a pixel


@dataclass(frozen=True, eq=False)
class SurfacePoints:
    """K places on faces, seen through pixels."""

    pixel: IntArray  # (K,) int32, row * W + column
    face: IntArray  # (K,) int32 scene face
    x: FloatArray  # (K,) float32, where in the picture, pixels, centre of the first at .5
    y: FloatArray  # (K,) float32

    def __len__(self) -> int:
        return len(self.pixel)


def distinct_points(
    faces: IntArray, shifts: FloatArray, first_pixel: int, width: int
) -> tuple[SurfacePoints, IntArray]:
    """Every (pixel, face) among the samples, once, and of_sample (n, P): its index, or -1 for background.

    faces: (n, P) int32, the face each of n samples sees at P pixels in a row; shifts: (n, 2) pixels.
    A point lies in the middle of the samples that see it.
    """
    samples, count = faces.shape
    of_sample = np.empty((samples, count), np.int32)
    room = count if samples == 1 else count_distinct(faces)
    pixel, face = np.empty(room, np.int32), np.empty(room, np.int32)
    x, y = np.empty(room, np.float32), np.empty(room, np.float32)
    total = list_distinct(faces, shifts, first_pixel, width, of_sample, pixel, face, x, y)
    return SurfacePoints(pixel[:total], face[:total], x[:total], y[:total]), of_sample


@kernel
def count_distinct(faces):
    """How many (pixel, face) there are."""
    samples, count = faces.shape
    total = 0
    for p in range(count):
        for s in range(samples):
            face = faces[s, p]
            fresh = face >= 0
            for earlier in range(s):
                if faces[earlier, p] == face:
                    fresh = False
                    break
            total += fresh
    return total


@kernel
def list_distinct(faces, shifts, first_pixel, width, of_sample, pixel, face, x, y):
    """Fill of_sample, and the points in the order of their pixels; how many there are."""
    samples, count = faces.shape
    total = 0
    for p in range(count):
        first = faces[0, p]
        agreed = True
        for s in range(1, samples):
            agreed = agreed and faces[s, p] == first
        if agreed and first < 0:
            for s in range(samples):
                of_sample[s, p] = -1
            continue
        for s in range(samples):
            seen = faces[s, p]
            of_sample[s, p] = -1
            # A sample that sees what an earlier one saw belongs to that point
            for earlier in range(s):
                if faces[earlier, p] == seen:
                    of_sample[s, p] = of_sample[earlier, p]
                    break
            if seen < 0 or of_sample[s, p] >= 0:
                continue
            dx, dy, alike = 0.0, 0.0, 0
            for later in range(s, samples):
                if faces[later, p] == seen:
                    dx += shifts[later, 0]
                    dy += shifts[later, 1]
                    alike += 1
            of_sample[s, p] = total
            pixel[total] = first_pixel + p
            face[total] = seen
            x[total] = (first_pixel + p) % width + 0.5 + dx / alike
            y[total] = (first_pixel + p) // width + 0.5 + dy / alike
            total += 1
    return total
