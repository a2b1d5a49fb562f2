"""Vertices that follow joints: linear blending and dual quaternions.

Linear blending mixes the joints' matrices: what every viewer of glTF does; joints that twist lose volume.
Dual quaternions mix their screws and keep it. [Kavan08] Stretch, shear and mirroring are mixed linearly
before them, so that one joint alone moves its vertices the same in both.

Normals go by the inverse transpose of what moves the vertex, so that they stay upright on stretched
surfaces; tangents go along with the surface, and their side turns where a mirror turns it.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from eyeline.errors import GeometryError
from eyeline.geometry import quaternion, transform
from eyeline.geometry.arrays import FloatArray, IntArray
from eyeline.jit import kernel, share, threads

Skinned = tuple[FloatArray, FloatArray | None, FloatArray | None]  # points, normals, tangents

Skinning = Callable[
    [FloatArray, FloatArray | None, FloatArray | None, IntArray, FloatArray, FloatArray], Skinned
]

LINEAR, SCREW, STRETCHED_SCREW = range(3)  # how a vertex's matrix is made from its joints
SHARED = 16_384  # vertices below which a second thread costs more than it brings


def linear_blend(
    points: FloatArray,
    normals: FloatArray | None,
    tangents: FloatArray | None,
    joints: IntArray,
    influences: FloatArray,
    matrices: FloatArray,
) -> Skinned:
    """Each vertex moved by the mean of its joints' matrices.

    points: (V, 3), normals: (V, 3), tangents: (V, 4) float32. joints: (V, K) int32 below J.
    influences: (V, K) float32 >= 0; rows need not add up to 1, one of nothing follows its first joint.
    matrices: (J, 4, 4) float64 affine, from where the mesh was bound to where the joint has taken it.
    """
    table = np.ascontiguousarray(matrices[:, :3, :], dtype=np.float64).reshape(-1, 12)
    return _moved((points, normals, tangents), joints, influences, table, LINEAR)


def dual_quaternion(
    points: FloatArray,
    normals: FloatArray | None,
    tangents: FloatArray | None,
    joints: IntArray,
    influences: FloatArray,
    matrices: FloatArray,
) -> Skinned:
    """Each vertex moved by the mean of its joints' screws; arrays as for `linear_blend`. [Kavan08, alg. 1]

    Quaternions are taken on the side of the vertex's heaviest joint: the short way round.
    """
    translation, rotation, _ = transform.decompose(matrices)
    turn = quaternion.to_matrix(rotation)
    # What is left of the matrix when its turn is undone
    stretch = transform.product(np.swapaxes(turn, -1, -2), matrices[:, :3, :3])
    dual = quaternion.multiply(
        np.concatenate([translation / 2, np.zeros((len(matrices), 1))], axis=1), rotation
    )
    table = np.concatenate([rotation, dual, np.reshape(stretch, (-1, 9))], axis=1)
    bare = np.abs(stretch - np.eye(3)).max(initial=0) <= RIGID
    return _moved((points, normals, tangents), joints, influences, table, SCREW if bare else STRETCHED_SCREW)


RIGID = 1e-9  # a stretch nearer to none than this moves no float32 vertex


def _moved(given: Skinned, joints: IntArray, influences: FloatArray, table: FloatArray, way: int) -> Skinned:
    joints, influences = np.ascontiguousarray(joints, np.int32), np.ascontiguousarray(influences, np.float32)
    _refuse(given, joints, influences, len(table))
    points, normals, tangents = (
        np.empty((0, width), np.float32) if one is None else np.ascontiguousarray(one, np.float32)
        for one, width in zip(given, (3, 3, 4), strict=True)
    )
    outs = [np.empty_like(one) for one in (points, normals, tangents)]
    parts = threads() if len(points) >= SHARED else 1
    ends = [len(points) * part // parts for part in range(parts + 1)]

    def task(part: int) -> None:
        skin(
            points, normals, tangents, joints, influences, table, way, ends[part], ends[part + 1], *outs
        )  # fmt: skip

    share(task, parts)
    return (
        outs[0],
        None if given[1] is None else outs[1],
        None if given[2] is None else outs[2],
    )


def _refuse(given: Skinned, joints: IntArray, influences: FloatArray, count: int) -> None:
    vertices = len(given[0])
    if joints.shape != influences.shape or joints.ndim != 2 or len(joints) != vertices or not joints.shape[1]:
        raise GeometryError(
            f"joints {joints.shape} and influences {influences.shape} must both be ({vertices}, K), K > 0"
        )
    if any(one is not None and len(one) != vertices for one in given):
        raise GeometryError(f"points, normals and tangents must be {vertices} rows each")
    # Read as unsigned, a negative number is too large as well
    if joints.size and joints.view(np.uint32).max() >= count:
        raise GeometryError(f"vertices follow joints {joints.min()} to {joints.max()}; there are {count}")


@kernel
def skin(
    points,
    normals,
    tangents,
    joints,
    influences,
    table,
    way,
    begin,
    end,
    out_points,
    out_normals,
    out_tangents,
):
    """Vertices begin to end: a matrix from the joints, then everything by that matrix."""
    count = joints.shape[1]
    for v in range(begin, end):
        total = 0.0
        heaviest = 0
        for k in range(count):
            total += influences[v, k]
            if influences[v, k] > influences[v, heaviest]:
                heaviest = k
        alone = total == 0.0
        if alone:
            total = 1.0
        share_of_one = 1.0 / total
        used = 1 if alone else count

        # Columns a, b, c of the turn and stretch, and the shift d
        ax = ay = az = bx = by = bz = cx = cy = cz = dx = dy = dz = 0.0
        if way == LINEAR:
            for k in range(used):
                w = 1.0 if alone else influences[v, k] * share_of_one
                j = joints[v, k]
                ax += w * table[j, 0]
                bx += w * table[j, 1]
                cx += w * table[j, 2]
                dx += w * table[j, 3]
                ay += w * table[j, 4]
                by += w * table[j, 5]
                cy += w * table[j, 6]
                dy += w * table[j, 7]
                az += w * table[j, 8]
                bz += w * table[j, 9]
                cz += w * table[j, 10]
                dz += w * table[j, 11]
        else:
            x = y = z = s = ex = ey = ez = es = 0.0
            pivot = joints[v, heaviest]
            for k in range(used):
                w = 1.0 if alone else influences[v, k] * share_of_one
                j = joints[v, k]
                side = (
                    table[pivot, 0] * table[j, 0]
                    + table[pivot, 1] * table[j, 1]
                    + table[pivot, 2] * table[j, 2]
                    + table[pivot, 3] * table[j, 3]
                )
                if side < 0.0:
                    w = -w
                x += w * table[j, 0]
                y += w * table[j, 1]
                z += w * table[j, 2]
                s += w * table[j, 3]
                ex += w * table[j, 4]
                ey += w * table[j, 5]
                ez += w * table[j, 6]
                es += w * table[j, 7]
            # 2 / |q|^2 makes a matrix of a quaternion of any length
            f = 2.0 / (x * x + y * y + z * z + s * s)
            ax = 1.0 - f * (y * y + z * z)
            ay = f * (x * y + z * s)
            az = f * (x * z - y * s)
            bx = f * (x * y - z * s)
            by = 1.0 - f * (x * x + z * z)
            bz = f * (y * z + x * s)
            cx = f * (x * z + y * s)
            cy = f * (y * z - x * s)
            cz = 1.0 - f * (x * x + y * y)
            dx = f * (s * ex - es * x + y * ez - z * ey)
            dy = f * (s * ey - es * y + z * ex - x * ez)
            dz = f * (s * ez - es * z + x * ey - y * ex)
            if way == STRETCHED_SCREW:
                s0 = s1 = s2 = s3 = s4 = s5 = s6 = s7 = s8 = 0.0
                for k in range(used):
                    w = 1.0 if alone else influences[v, k] * share_of_one
                    j = joints[v, k]
                    s0 += w * table[j, 8]
                    s1 += w * table[j, 9]
                    s2 += w * table[j, 10]
                    s3 += w * table[j, 11]
                    s4 += w * table[j, 12]
                    s5 += w * table[j, 13]
                    s6 += w * table[j, 14]
                    s7 += w * table[j, 15]
                    s8 += w * table[j, 16]
                ax, bx, cx = (
                    ax * s0 + bx * s3 + cx * s6,
                    ax * s1 + bx * s4 + cx * s7,
                    ax * s2 + bx * s5 + cx * s8,
                )
                ay, by, cy = (
                    ay * s0 + by * s3 + cy * s6,
                    ay * s1 + by * s4 + cy * s7,
                    ay * s2 + by * s5 + cy * s8,
                )
                az, bz, cz = (
                    az * s0 + bz * s3 + cz * s6,
                    az * s1 + bz * s4 + cz * s7,
                    az * s2 + bz * s5 + cz * s8,
                )

        px, py, pz = points[v, 0], points[v, 1], points[v, 2]
        out_points[v, 0] = ax * px + bx * py + cx * pz + dx
        out_points[v, 1] = ay * px + by * py + cy * pz + dy
        out_points[v, 2] = az * px + bz * py + cz * pz + dz

        if len(normals) + len(tangents) > 0:
            # The inverse transpose times the determinant: columns crossed
            ux, uy, uz = by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx
            side = 1.0 if ax * ux + ay * uy + az * uz >= 0.0 else -1.0
            if len(normals) > 0:
                nx, ny, nz = normals[v, 0], normals[v, 1], normals[v, 2]
                x = nx * ux + ny * (cy * az - cz * ay) + nz * (ay * bz - az * by)
                y = nx * uy + ny * (cz * ax - cx * az) + nz * (az * bx - ax * bz)
                z = nx * uz + ny * (cx * ay - cy * ax) + nz * (ax * by - ay * bx)
                length = x * x + y * y + z * z
                f = side / np.sqrt(length) if length > 0.0 else 0.0
                # A joint of no size has no upright; the normal stays as it was
                out_normals[v, 0] = f * x if f != 0.0 else nx
                out_normals[v, 1] = f * y if f != 0.0 else ny
                out_normals[v, 2] = f * z if f != 0.0 else nz
            if len(tangents) > 0:
                tx, ty, tz = tangents[v, 0], tangents[v, 1], tangents[v, 2]
                x = ax * tx + bx * ty + cx * tz
                y = ay * tx + by * ty + cy * tz
                z = az * tx + bz * ty + cz * tz
                length = x * x + y * y + z * z
                f = 1.0 / np.sqrt(length) if length > 0.0 else 0.0
                out_tangents[v, 0] = f * x if f != 0.0 else tx
                out_tangents[v, 1] = f * y if f != 0.0 else ty
                out_tangents[v, 2] = f * z if f != 0.0 else tz
                out_tangents[v, 3] = side * tangents[v, 3]
