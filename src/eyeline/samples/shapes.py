"""Solids the samples are built from: each a Shape with its outside counter-clockwise."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from eyeline.geometry import transform
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.geometry.normals import creased
from eyeline.geometry.weld import welded
from eyeline.scene.material import DEFAULT, Material
from eyeline.scene.mesh import Mesh

CREASE = math.radians(35)  # an edge sharper than this stays an edge


@dataclass(frozen=True, eq=False)
class Shape:
    """Triangles with a place in a texture at every corner."""

    points: FloatArray  # (V, 3) metres; faces that touch share them
    faces: IntArray  # (F, 3)
    corner_uv: FloatArray  # (F, 3, 2)

    def moved(self, translation: npt.ArrayLike = (0, 0, 0), scale: npt.ArrayLike = (1, 1, 1)) -> Shape:
        """This shape scaled (all factors above zero), then shifted."""
        return Shape(self.points * np.asarray(scale) + np.asarray(translation), self.faces, self.corner_uv)

    def turned(self, rotation: npt.ArrayLike) -> Shape:
        """This shape turned by a unit quaternion x y z w."""
        matrix = transform.compose((0, 0, 0), rotation, (1, 1, 1))
        return Shape(transform.apply(matrix, self.points), self.faces, self.corner_uv)

    def mesh(self, material: Material = DEFAULT, name: str = "", crease: float = CREASE) -> Mesh:
        """A mesh with normals, smooth but for creases, and one UV set."""
        return mesh_of({material: self}, name, crease)


def joined(*shapes: Shape) -> Shape:
    """Shapes side by side, faces in the order given."""
    starts = np.cumsum([0, *(len(shape.points) for shape in shapes)])
    return Shape(
        np.concatenate([shape.points for shape in shapes]),
        np.concatenate([shape.faces + start for shape, start in zip(shapes, starts, strict=False)]),
        np.concatenate([shape.corner_uv for shape in shapes]),
    )


def sewn(*shapes: Shape) -> Shape:
    """Shapes as one, smooth where they meet: points at one place are shared."""
    whole = joined(*shapes)
    first, index = welded(np.round(whole.points, 9))
    return Shape(whole.points[first], index[whole.faces], whole.corner_uv)


def mesh_of(parts: dict[Material, Shape], name: str = "", crease: float = CREASE) -> Mesh:
    """One mesh of shapes, each of its own material."""
    shape = joined(*parts.values())
    points = shape.points.astype(np.float32)
    split = creased(points, shape.faces, crease)
    # A vertex of the mesh is a split vertex at one place of the texture
    corners = np.column_stack([split.faces.reshape(-1), shape.corner_uv.reshape(-1, 2)])
    first, index = welded(corners)
    kept = split.faces.reshape(-1)[first]
    counts = [len(part.faces) for part in parts.values()]
    return Mesh(
        points[split.source[kept]],
        index.reshape(-1, 3),
        split.normals[kept],
        uv=[corners[first, 1:]],
        materials=tuple(parts),
        face_material=np.repeat(np.arange(len(counts)), counts) if len(counts) > 1 else None,
        name=name,
    )


def sheet(corners: npt.ArrayLike) -> Shape:
    """Four corners (4, 3) in one plane as two triangles: the front is where they turn counter-clockwise."""
    uv = np.array([(0, 1), (1, 1), (1, 0), (0, 0)], dtype=np.float64)
    faces = np.array([(0, 1, 2), (0, 2, 3)])
    return Shape(np.asarray(corners, dtype=np.float64), faces, uv[faces])


# --- from a grid ------------------------------------------------------------------------------------------


def grid(points: FloatArray, uv: FloatArray) -> Shape:
    """A sheet of quads, each cut in two: points (M, N, 3), uv (M, N, 2); front where rows x columns points.

    Points at one place become one, and triangles that lose their area by it are left out.
    """
    m, n = points.shape[:2]
    number = np.arange(m * n).reshape(m, n)
    a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
    corners = np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], axis=2).reshape(-1, 3)
    first, index = welded(np.round(points.reshape(-1, 3), 9))
    faces = index[corners]
    whole = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    return Shape(points.reshape(-1, 3)[first], faces[whole], uv.reshape(-1, 2)[corners[whole]])


def lathe(profile: npt.ArrayLike, sides: int = 64) -> Shape:
    """The solid that a profile (K, 2) of radius and height makes when it turns about y.

    Seen with y up and the axis at the left, the outside is at the right of the way from first to last
    point: go up along the outer wall. Closed if it begins and ends on the axis, or where it began.
    """
    profile = np.asarray(profile, dtype=np.float64)
    along = np.concatenate([[0], np.cumsum(np.sqrt((np.diff(profile, axis=0) ** 2).sum(axis=1)))])
    turn = np.linspace(0, 1, sides + 1)
    angle = 2 * math.pi * (turn % 1)
    radius, height = profile[:, :1], np.repeat(profile[:, 1:], sides + 1, axis=1)
    points = np.stack([radius * np.cos(angle), height, -radius * np.sin(angle)], axis=-1)
    u, v = np.meshgrid(turn, 1 - along / along[-1])
    # Rows follow the turn, so that rows x columns point outwards
    return grid(np.swapaxes(points, 0, 1), np.swapaxes(np.stack([u, v], axis=-1), 0, 1))


def rounded(profile: npt.ArrayLike, radius: float, steps: int = 4) -> FloatArray:
    """The polyline (K, 2) with an arc of this radius in place of each inner corner."""
    profile = np.asarray(profile, dtype=np.float64)
    kept = [profile[:1]]
    for before, here, after in zip(profile, profile[1:], profile[2:], strict=False):
        back, on = before - here, after - here
        back_length, on_length = math.hypot(*back), math.hypot(*on)
        half = math.acos(max(-1.0, min(1.0, float(back @ on) / (back_length * on_length)))) / 2
        reach = min(radius / math.tan(half), back_length / 2, on_length / 2)
        start, end = here + back * (reach / back_length), here + on * (reach / on_length)
        t = np.linspace(0, 1, steps + 1)[:, None]
        # A quadratic with the corner's own weight is exactly an arc
        weight = math.sin(half)
        blend = (1 - t) ** 2 * start + 2 * weight * t * (1 - t) * here + t**2 * end
        kept.append(blend / ((1 - t) ** 2 + 2 * weight * t * (1 - t) + t**2))
    return np.concatenate([*kept, profile[-1:]])


def tube(path: npt.ArrayLike, radius: float, sides: int = 16) -> Shape:
    """A round wire along a path (K, 3), with flat ends."""
    path = np.asarray(path, dtype=np.float64)
    ways = np.gradient(path, axis=0)
    ways /= np.sqrt((ways**2).sum(axis=1, keepdims=True))
    # Carry one perpendicular along without twisting it
    side = np.cross(ways[0], np.eye(3)[np.abs(ways[0]).argmin()])
    sides_along = []
    for way in ways:
        side = side - way * (side @ way)
        side = side / math.sqrt(side @ side)
        sides_along.append(side)
    across = np.array(sides_along)
    other = np.cross(ways, across)
    angle = 2 * math.pi * (np.linspace(0, 1, sides + 1) % 1)
    offsets = across[:, None] * np.cos(angle)[:, None] + other[:, None] * np.sin(angle)[:, None]
    wall = path[:, None] + radius * offsets
    rows = np.concatenate(
        [np.repeat(path[:1, None], sides + 1, axis=1), wall, np.repeat(path[-1:, None], sides + 1, axis=1)]
    )
    u, v = np.meshgrid(np.linspace(0, 1, sides + 1), np.linspace(0, 1, len(rows)))
    return grid(np.swapaxes(rows, 0, 1), np.swapaxes(np.stack([u, v], axis=-1), 0, 1))


def box(size: npt.ArrayLike, bevel: float = 0.0, steps: int = 3) -> Shape:
    """A box about the origin, edge lengths (3,), its edges rounded; each side has the whole texture."""
    half = np.asarray(size, dtype=np.float64) / 2
    arc = np.tan(np.linspace(0, 1, steps + 1) * math.pi / 4)[1:] if bevel else np.array([])
    knots = np.concatenate([-1 - arc[::-1], [-1], [1], 1 + arc])
    sides = []
    for axis in range(3):
        u_axis, v_axis = (axis + 1) % 3, (axis + 2) % 3
        for sign in (1, -1):
            first, second = (u_axis, v_axis) if sign > 0 else (v_axis, u_axis)
            sides.append(box_side(half, bevel, knots, (axis, first, second), sign))
    return sewn(*sides)


def box_side(
    half: FloatArray, bevel: float, knots: FloatArray, axes: tuple[int, int, int], sign: int
) -> Shape:
    """One side of a box: a flat middle, and its half of the rounding. axes: its normal, its edges."""
    axis, first, second = axes
    inner = half - bevel
    flat = np.clip(knots, -1, 1)
    over = np.where(np.abs(knots) > 1, knots - flat, 0)
    a, b = np.meshgrid(flat, flat, indexing="ij")
    out_a, out_b = np.meshgrid(over, over, indexing="ij")
    away = np.zeros((*a.shape, 3))
    away[..., axis], away[..., first], away[..., second] = sign, out_a, out_b
    away /= np.sqrt((away**2).sum(axis=-1, keepdims=True))
    centre = np.zeros((*a.shape, 3))
    centre[..., axis], centre[..., first], centre[..., second] = (
        sign * inner[axis],
        a * inner[first],
        b * inner[second],
    )
    points = centre + bevel * away
    uv = np.stack([points[..., first] / half[first], -points[..., second] / half[second]], axis=-1) / 2 + 0.5
    return grid(points, uv)
