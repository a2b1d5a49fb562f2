"""Exact transparency, whatever the order of the faces: sorted fragments over the opaque answer.

Every antialiasing sample has its own list of fragments, so edges of glass are as smooth as others, and what
pierces is right at every sample; a face is shaded once in a pixel, however many samples see it.
A blended surface casts no shadow: light that passes it is not followed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from eyeline.errors import OptionError
from eyeline.geometry.arrays import BoolArray, ByteArray, FloatArray, IntArray
from eyeline.jit import kernel
from eyeline.shading.alpha import faces_of, has
from eyeline.shading.frame import Frame, Strip
from eyeline.shading.resolve import Layers
from eyeline.shading.surface_points import SurfacePoints
from eyeline.visibility.fragments import LIMIT, Fragments, fragments

Shader = Callable[[SurfacePoints], FloatArray]  # -> (K, 4) linear 0..1, alpha last, not multiplied by it
Behind = Callable[[Strip], ByteArray]


def stacked(frame: Frame, wanted: BoolArray, through: bool = False) -> tuple[Fragments, ...]:
    """For each sample of a frame, the fragments of the wanted faces (F,) in front of its answer.

    through: as if nothing stood behind them. Call it before the frame's strips are drawn: it uses the threads
    they are drawn on. Refused: more than LIMIT fragments.
    """
    projected = frame.projected.only(wanted)
    stack: list[Fragments] = []
    for visible, dx, dy in frame.visibles:
        behind = np.zeros_like(visible.depth) if through else visible.depth
        stack.append(fragments(projected.shifted(dx, dy), behind))
        if sum(map(len, stack)) > LIMIT:
            raise OptionError(
                f"more than {LIMIT} transparent samples lie over each other in one picture:"
                " take fewer samples or a smaller picture"
            )
    return tuple(stack)


def drawn_through(frame: Frame, shader: Shader, behind: Behind | None = None) -> ByteArray:
    """The picture (H, W, 4) of a frame whose solid and blended faces are shaded alike.

    behind(strip) -> (rows, W, 4) sRGB stands where nothing does; without it the frame's backdrop.
    """
    surfaces = frame.projected.surfaces
    stack = stacked(frame, faces_of(surfaces, "blend")) if has(surfaces, "blend") else ()
    if not any(map(len, stack)):
        return frame.drawn(lambda strip: shader(strip.points), behind)
    return frame.drawn(lambda strip: (shader(strip.points), layers(strip, stack, shader)), behind)


def layers(strip: Strip, stack: Sequence[Fragments], shader: Shader) -> Layers:
    """The shaded fragments of a strip, for `resolve`: each sample's own, far to near."""
    first, faces = _rows_of(strip, stack)
    points, of_fragment = layered_points(first, faces, strip)
    return Layers(first, shader(points)[of_fragment])


def _rows_of(strip: Strip, stack: Sequence[Fragments]) -> tuple[IntArray, IntArray]:
    """first (n, P + 1) and faces (L,): the lists of a strip's pixels, one sample's after another's."""
    width = strip.frame.projected.width
    begin, end = strip.top * width, strip.bottom * width
    first = np.empty((len(stack), end - begin + 1), np.int64)
    faces = []
    start = 0
    for row, one in zip(first, stack, strict=True):
        low, high = one.first[begin], one.first[end]
        np.add(one.first[begin : end + 1], start - low, out=row)
        faces.append(one.face[low:high])
        start += high - low
    return first, np.concatenate(faces)


def layered_points(first: IntArray, faces: IntArray, strip: Strip) -> tuple[SurfacePoints, IntArray]:
    """Every (pixel, face) among the fragments, once, and of_fragment (L,): its index.

    A point lies in the middle of the samples that see it.
    """
    room = len(faces)
    of_fragment = np.empty(room, np.int32)
    pixel, face, seen = np.empty(room, np.int32), np.empty(room, np.int32), np.empty(room, np.int32)
    x, y = np.empty(room, np.float32), np.empty(room, np.float32)
    width = strip.frame.projected.width
    total = list_layers(
        first, faces, strip.frame.shifts, strip.first_pixel, width, of_fragment, pixel, face, seen, x, y
    )
    return SurfacePoints(pixel[:total], face[:total], x[:total], y[:total]), of_fragment


@kernel
def list_layers(first, faces, shifts, first_pixel, width, of_fragment, pixel, face, seen, x, y):
    """Fill of_fragment, and the points in the order of their pixels; how many there are."""
    samples = first.shape[0]
    total = 0
    for p in range(first.shape[1] - 1):
        begin = total
        for s in range(samples):
            # Lists of neighbouring samples are much alike: look on where the last one was found
            known = total
            at = begin
            for k in range(first[s, p], first[s, p + 1]):
                left = known - begin
                while left > 0 and face[at] != faces[k]:
                    left -= 1
                    at = at + 1 if at + 1 < known else begin
                point = at if left > 0 else total
                if left == 0:
                    pixel[point], face[point], seen[point] = first_pixel + p, faces[k], 0
                    x[point], y[point] = 0.0, 0.0
                    total += 1
                x[point] += shifts[s, 0]
                y[point] += shifts[s, 1]
                seen[point] += 1
                of_fragment[k] = point
        column = (first_pixel + p) % width
        row = (first_pixel + p) // width
        for at in range(begin, total):
            x[at] = column + 0.5 + x[at] / seen[at]
            y[at] = row + 0.5 + y[at] / seen[at]
    return total
