"""Which edges of a model are drawn, seen from where the eye is."""

from __future__ import annotations

import math

import numpy as np

from eyeline.drawing.grid import turn
from eyeline.drawing.kinds import BOUNDARY, CREASE, KINDS, MESH, OUTLINE
from eyeline.drawing.model import Model
from eyeline.geometry.arrays import ByteArray, IntArray, read_only
from eyeline.jit import helper, kernel, share, threads
from eyeline.scene.topology import BRANCHING, TWISTED

SMALL = 1 << 14  # faces: fewer are not worth a second thread


def facings(model: Model, perspective: bool) -> IntArray:
    """(F,) int8: 1 for a face that turns clockwise on the screen, -1 for another, 0 if that side is not seen.

    An edge-on face counts as the other side, as if tilted a little.
    """
    facing = np.empty(len(model.faces), np.int8)
    parts = threads() if len(facing) > SMALL else 1
    arrays = (
        read_only(model.faces), read_only(model.screen), read_only(model.points),
        read_only(model.outside), read_only(model.sides),
    )  # fmt: skip
    share(lambda part: _facings(part, parts, *arrays, perspective, facing), parts)
    return facing


def chosen_edges(
    model: Model, facing: IntArray, kinds: tuple[str, ...], crease: float
) -> tuple[IntArray, ByteArray]:
    """The numbers (S,) and kinds (S,) of the edges to draw.

    crease: radians; an edge is one where its faces' directions differ by more. Each edge has one kind, the
    first of KINDS that it is and that is asked for.
    """
    kind = np.empty(len(model.edges), np.uint8)
    wanted = np.array([False, *(name in kinds for name in KINDS)])
    parts = threads() if len(kind) > SMALL else 1
    arrays = (
        read_only(model.points), read_only(model.faces), read_only(model.edges), read_only(model.odd),
        read_only(facing), read_only(wanted),
    )  # fmt: skip
    share(lambda part: _edge_kinds(part, parts, *arrays, math.cos(crease), kind), parts)
    chosen = np.flatnonzero(kind)
    return chosen, kind[chosen]


@kernel
def _facings(part, parts, faces, screen, points, outside, sides, perspective, facing):
    count = faces.shape[0]
    for face in range(count * part // parts, count * (part + 1) // parts):
        a, b, c = faces[face, 0], faces[face, 1], faces[face, 2]
        if outside[a] | outside[b] | outside[c]:
            # Not on the grid: by the side of its plane that the eye is on
            nx, ny, nz = normal(
                points[a, 0], points[a, 1], points[a, 2], points[b, 0], points[b, 1], points[b, 2],
                points[c, 0], points[c, 1], points[c, 2],
            )  # fmt: skip
            area = nx * points[a, 0] + ny * points[a, 1] + nz * points[a, 2] if perspective else -nz
        else:
            area = turn(screen[a, 0], screen[a, 1], screen[b, 0], screen[b, 1], screen[c, 0], screen[c, 1])
        clockwise = area > 0.0
        seen = (sides[face] & (2 if clockwise else 1)) != 0
        facing[face] = (1 if clockwise else -1) if seen else 0


@kernel
def _edge_kinds(part, parts, points, faces, edges, odd, facing, wanted, cosine, kind):
    count = edges.shape[0]
    for edge in range(count * part // parts, count * (part + 1) // parts):
        f, g, twisted = edges[edge, 2], edges[edge, 3], odd[edge] == TWISTED
        one, other = facing[f], (facing[g] if g >= 0 else 0)
        branching = odd[edge] == BRANCHING
        kind[edge] = 0
        if (one == 0) & (other == 0) & (not branching):
            continue
        if g < 0 or branching:
            kind[edge] = BOUNDARY if wanted[BOUNDARY] else 0
        elif (one == 0) | (other == 0) | ((one != other) != twisted):
            kind[edge] = OUTLINE if wanted[OUTLINE] else 0
        if (kind[edge] == 0) & wanted[CREASE] & (g >= 0):
            a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
            mx, my, mz = normal(
                points[a, 0], points[a, 1], points[a, 2], points[b, 0], points[b, 1], points[b, 2],
                points[c, 0], points[c, 1], points[c, 2],
            )  # fmt: skip
            a, b, c = faces[g, 0], faces[g, 1], faces[g, 2]
            nx, ny, nz = normal(
                points[a, 0], points[a, 1], points[a, 2], points[b, 0], points[b, 1], points[b, 2],
                points[c, 0], points[c, 1], points[c, 2],
            )  # fmt: skip
            lengths = np.sqrt((mx * mx + my * my + mz * mz) * (nx * nx + ny * ny + nz * nz))
            bend = mx * nx + my * ny + mz * nz
            kind[edge] = CREASE if (-bend if twisted else bend) < cosine * lengths else 0
        if (kind[edge] == 0) & wanted[MESH]:
            kind[edge] = MESH


@helper
def normal(ax, ay, az, bx, by, bz, cx, cy, cz):
    """The normal of a face as long as twice its area, towards where it turns counter-clockwise."""
    ux, uy, uz, vx, vy, vz = bx - ax, by - ay, bz - az, cx - ax, cy - ay, cz - az
    return uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
