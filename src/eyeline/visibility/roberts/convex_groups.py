"""Which faces show a side that counts, and which of them are one convex body as this camera sees them.

Asked of the snapped corners: no line of the outline may turn inwards, and no corner may stand out of the
plane of a near face by more than snapping can have moved it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from eyeline.geometry.arrays import BoolArray, FloatArray, IntArray, read_only
from eyeline.geometry.fixedpoint import signed_area
from eyeline.jit import helper, kernel, share, threads
from eyeline.projection.projected import CLOCKWISE, COUNTER_CLOCKWISE, Projected
from eyeline.visibility.roberts.mesh_edges import MeshEdges

ROUNDING = 2.0**-20  # of a depth: a few steps of float32, in which depths are computed
WIDE = 16  # 1/256 pixel: a narrower face's plane is too uncertain beyond its own sides
SMALL = 1 << 14  # faces: fewer are not worth a second thread
UNPLACED = 2  # how a face turns whose corners are not all before the camera


@dataclass(frozen=True, eq=False)
class Facing:
    """How the faces of a picture turn, and which of them make one body."""

    turn: IntArray  # (F,) int8: 1 clockwise, -1 the other way, 0 edge-on, or UNPLACED
    drawn: BoolArray  # (F,) whether that side counts
    group: IntArray  # (F,) int32: the convex group a face belongs to; -1 is none
    far: BoolArray  # (F,) whether it is on the far side of that group, where its own body hides it


def facing_of(projected: Projected, edges: MeshEdges) -> Facing:
    """How the faces turn, and the groups that are convex."""
    count = len(projected.faces)
    turn, drawn = np.empty(count, np.int8), np.empty(count, np.bool_)
    corners, xy, depth = flat(projected)
    sides, parts = read_only(projected.sides), threads() if count > SMALL else 1
    share(lambda part: _turns(part, parts, corners, xy, depth, sides, turn, drawn), parts)
    group, far = np.full(count, -1, np.int32), np.zeros(count, np.bool_)
    if len(edges.front):
        given = (edges.start, edges.member, edges.front, edges.beyond, corners, xy, depth, turn, drawn)
        arrays = (read_only(np.ascontiguousarray(array)) for array in given)
        _join(rounding(projected), np.full(count, -1, np.int32), group, far, *arrays)
    return Facing(turn, drawn, group, far)


def shown_faces(projected: Projected, facing: Facing) -> BoolArray:
    """(face_count,) whether an uncut face, or a piece of it, shows a side that counts.

    One that is exactly edge-on and has two sides shows its edges all the same.
    """
    both = np.broadcast_to(projected.sides, len(facing.turn)) == CLOCKWISE | COUNTER_CLOCKWISE
    shown = facing.drawn | ((facing.turn == 0) & both)
    whole: BoolArray = shown[: projected.face_count].copy()
    whole[projected.piece_source[shown[projected.face_count :]]] = True
    return whole


def flat(projected: Projected) -> tuple[IntArray, IntArray, FloatArray]:
    """Corners (3 F,) of faces, places (2 V,) of vertices and their depths (V,), as kernels take them."""
    arrays = (projected.faces, projected.xy, projected.depth)
    corners, xy, depth = (read_only(np.ascontiguousarray(array)).reshape(-1) for array in arrays)
    return corners, xy, depth


def rounding(projected: Projected) -> float:
    """What rounding can add to any depth, however small: a part of the number they are counted from."""
    matrix = projected.camera.clip_from_eye(projected.width / projected.height)
    return ROUNDING * abs(float(matrix[2, 2] if projected.camera.fov is not None else matrix[2, 3]))


@helper
def slopes(x0, y0, z0, x1, y1, z1, x2, y2, z2):
    """How depth changes to the right and down on the plane of three corners that have an area."""
    area = float(signed_area(x0, y0, x1, y1, x2, y2))
    ux, uy, uz = float(x1 - x0), float(y1 - y0), z1 - z0
    vx, vy, vz = float(x2 - x0), float(y2 - y0), z2 - z0
    return (uz * vy - vz * uy) / area, (ux * vz - vx * uz) / area


@kernel
def _turns(part, parts, corners, xy, depth, sides, turn, drawn):
    """Fill turn and drawn."""
    count = turn.shape[0]
    for face in range(count * part // parts, count * (part + 1) // parts):
        i, j, k = corners[3 * face], corners[3 * face + 1], corners[3 * face + 2]
        side = sides[face if sides.shape[0] > 1 else 0]
        if not (np.isfinite(depth[i]) & np.isfinite(depth[j]) & np.isfinite(depth[k])):
            turn[face], drawn[face] = UNPLACED, False
            continue
        x, y = np.int64(xy[2 * i]), np.int64(xy[2 * i + 1])
        area = signed_area(x, y, np.int64(xy[2 * j]), np.int64(xy[2 * j + 1]), xy[2 * k], xy[2 * k + 1])
        turn[face] = 1 if area > 0 else -1 if area < 0 else 0
        drawn[face] = ((area > 0) & ((side & 2) != 0)) | ((area < 0) & ((side & 1) != 0))


@kernel
def _join(
    rounding, near, group, far, start, member, front, beyond, corners, xy, depth, turn, drawn
):  # fmt: skip
    """Fill group and far for every group that is convex; near is -1 everywhere."""
    for g in range(front.shape[0]):
        first, end = start[g], start[g + 1]
        want = front[g] if front[g] != 0 else turn[member[first]]
        convex, found = (want == 1) | (want == -1), 0
        for m in range(first, end):
            f = member[m]
            convex &= (group[f] < 0) & (turn[f] != UNPLACED)
            if turn[f] == want:
                convex &= drawn[f]
                near[f] = g
                found += 1
            else:
                convex &= front[g] != 0
        if not convex or found == 0:
            continue
        for m in range(first, end):
            f = member[m]
            if near[f] != g:
                continue
            i, j, k = corners[3 * f], corners[3 * f + 1], corners[3 * f + 2]
            x0, y0, z0 = np.int64(xy[2 * i]), np.int64(xy[2 * i + 1]), np.float64(depth[i])
            x1, y1, z1 = np.int64(xy[2 * j]), np.int64(xy[2 * j + 1]), np.float64(depth[j])
            x2, y2, z2 = np.int64(xy[2 * k]), np.int64(xy[2 * k + 1]), np.float64(depth[k])
            area = abs(signed_area(x0, y0, x1, y1, x2, y2))
            long = max(
                abs(x1 - x0), abs(y1 - y0), abs(x2 - x1), abs(y2 - y1), abs(x0 - x2), abs(y0 - y2)
            )  # fmt: skip
            if area < WIDE * long:
                convex = False
                break
            a, b = slopes(x0, y0, z0, x1, y1, z1, x2, y2, z2)
            # Half a unit for each corner of the plane, and for the one that is held against it
            doubt = 2.0 * (abs(a) + abs(b)) + ROUNDING * max(abs(z0), abs(z1), abs(z2)) + rounding
            for n in range(first, end):
                for c in range(3):
                    v = corners[3 * member[n] + c]
                    x, y = np.int64(xy[2 * v]), np.int64(xy[2 * v + 1])
                    if depth[v] > z0 + a * float(x - x0) + b * float(y - y0) + doubt:
                        convex = False
            for c in range(3):
                other = beyond[f, c]
                if other >= 0 and near[other] == g:
                    continue
                # Beyond this side the body ends on the screen: no corner may lie there
                p, q = corners[3 * f + c], corners[3 * f + (c + 1) % 3]
                px, py = np.int64(xy[2 * p]), np.int64(xy[2 * p + 1])
                qx, qy = np.int64(xy[2 * q]), np.int64(xy[2 * q + 1])
                for n in range(first, end):
                    for d in range(3):
                        v = corners[3 * member[n] + d]
                        x, y = np.int64(xy[2 * v]), np.int64(xy[2 * v + 1])
                        convex &= want * signed_area(px, py, qx, qy, x, y) >= 0
        if convex:
            for m in range(first, end):
                group[member[m]] = g
                far[member[m]] = near[member[m]] != g
