"""OFF: points, and polygons over them; with colours of points as COFF. [Geomview, OFF]

Read here and not by a library, so that polygons of different sizes keep their order.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from eyeline.errors import FileError
from eyeline.files.meshes.assembly import (
    Corners,
    finite_points,
    indices_below,
    linear_from_bytes,
    refuse_empty,
    scene_of,
)
from eyeline.files.meshes.polygons import triangulated
from eyeline.files.meshes.text import numbers, shortened, text_of
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.scene.scene import Scene

WIDTHS = {"OFF": 3, "COFF": 7}  # numbers of a point: its place, and red green blue alpha


def read(path: Path) -> Scene:
    """The scene of an OFF file. Lengths are taken for metres; colours of faces are left aside."""
    lines = [line for line in (one.partition("#")[0].strip() for one in text_of(path).splitlines()) if line]
    word, _, rest = (lines or [""])[0].partition(" ")
    if word not in WIDTHS:
        raise FileError(f"does not begin with 'OFF' or 'COFF' but {shortened(word)!r}; it is no OFF file")
    lines = [rest.strip(), *lines[1:]] if rest.strip() else lines[1:]
    points_count, faces_count = counts_of(lines)
    refuse_empty(range(faces_count))
    points, colors = points_of(lines[1 : 1 + points_count], WIDTHS[word])
    faces = faces_of(lines[1 + points_count : 1 + points_count + faces_count], points)
    return scene_of(path.stem, [Corners(points, faces, colors).mesh(path.stem)])


def counts_of(lines: list[str]) -> tuple[int, int]:
    """How many points and faces the first line claims; refused where not so many lines follow."""
    words = (lines or [""])[0].split()
    if len(words) < 2 or not all(word.isdecimal() and len(word) < 19 for word in words[:2]):
        raise FileError(
            f"counts its points and faces as {shortened(' '.join(words))!r}; two numbers are needed"
        )
    points, faces = int(words[0]), int(words[1])
    if points + faces > len(lines) - 1:
        raise FileError(
            f"claims {points:,} points and {faces:,} faces in {len(lines) - 1:,} lines; it is cut short"
        )
    return points, faces


def points_of(lines: list[str], width: int) -> tuple[FloatArray, FloatArray | None]:
    """(V, 3) points, and their linear colours (V, 4) where they have some."""
    values = numbers(lines, "point")
    short = next((row for row, line in enumerate(lines) if len(line.split()) != width), None)
    if short is not None:
        raise FileError(f"point {short} has {len(lines[short].split())} numbers; {width} are needed")
    table = values.reshape(-1, width)
    points = finite_points(table[:, :3])
    if width == 3:
        return points, None
    colors = finite_points(table[:, 3:], "color of point")
    colors = colors / (255 if colors.max(initial=0) > 1 else 1)
    return points, np.column_stack([linear_from_bytes(colors[:, :3]), np.clip(colors[:, 3], 0, 1)])


def faces_of(lines: list[str], points: FloatArray) -> IntArray:
    """(F, 3) the polygons cut into triangles."""
    polygons = []
    for face, line in enumerate(lines):
        words = line.split()
        count = int(words[0]) if words[0].isdecimal() and len(words[0]) < 10 else -1
        corners = words[1 : 1 + max(count, 0)]
        if len(corners) != count or not all(word.isdecimal() and len(word) < 19 for word in corners):
            raise FileError(
                f"face {face} is {shortened(line)!r}; a count and so many point numbers are needed"
            )
        polygons.append(corners)
    counts = np.array([len(corners) for corners in polygons], dtype=np.int64)
    flat = np.array([int(word) for corners in polygons for word in corners], dtype=np.int64)
    corners_checked = indices_below(flat, len(points), np.repeat(np.arange(len(counts)), counts))
    triangles, _ = triangulated(points, corners_checked, counts)
    return corners_checked[triangles]
