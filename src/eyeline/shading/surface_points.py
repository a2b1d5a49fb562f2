"""The places to shade: each face in each pixel once, however many samples see it.

Opaque faces and transparent fragments are both lists of surface points, and go through the same code:
`attributes(frame, points)` and `radiance(frame, points)`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.jit import helper, kernel

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
    room = samples * count  # memory that nothing is written to costs nothing
    pixel, face = np.empty(room, np.int32), np.empty(room, np.int32)
    x, y = np.empty(room, np.float32), np.empty(room, np.float32)
    total = list_distinct(faces, shifts, first_pixel, width, of_sample, pixel, face, x, y)
    return SurfacePoints(pixel[:total], face[:total], x[:total], y[:total]), of_sample


@kernel
def list_distinct(faces, shifts, first_pixel, width, of_sample, pixel, face, x, y):
    """Fill of_sample, and the points in the order of their pixels; how many there are."""
    samples, count = faces.shape
    middle_x, middle_y = np.float32(0), np.float32(0)
    for s in range(samples):
        middle_x += shifts[s, 0] / samples
        middle_y += shifts[s, 1] / samples
    column, row, total = first_pixel % width, first_pixel // width, 0
    for p in range(count):
        first = faces[0, p]
        agreed = True
        for s in range(1, samples):
            agreed = agreed and faces[s, p] == first
        if agreed:
            for s in range(samples):
                of_sample[s, p] = total if first >= 0 else -1
            if first >= 0:
                pixel[total], face[total] = first_pixel + p, first
                x[total], y[total] = column + 0.5 + middle_x, row + 0.5 + middle_y
                total += 1
        else:
            end = list_pixel(faces, shifts, p, (column, row), of_sample, total, face, x, y)
            for point in range(total, end):
                pixel[point] = first_pixel + p
            total = end
        column += 1
        if column == width:
            column, row = 0, row + 1
    return total


@helper
def list_pixel(faces, shifts, p, place, of_sample, total, face, x, y):
    """The same for a pixel whose samples see different things."""
    samples = faces.shape[0]
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
        face[total] = seen
        x[total] = place[0] + 0.5 + dx / alike
        y[total] = place[1] + 0.5 + dy / alike
        total += 1
    return total
