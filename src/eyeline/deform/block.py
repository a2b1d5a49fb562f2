"""Vertices on their way through deformers, in blocks: where each is, and how space around it was changed.

A block holds WIDTH vertices, twelve rows of WIDTH float64: x, y, z, then the Jacobian of the way so far, row
by row, xx xy xz yx ... zz, where xy is how x now grows with the y that was given. Rows of a fixed width lie
at fixed distances, so that a loop along a row works on as many vertices at once as the processor can.
A batch is as many blocks as stay in a core's cache while one deformer after another goes over them.
"""

from __future__ import annotations

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.jit import kernel, on_stack

WIDTH = 256  # vertices of a block
ROWS = 12  # numbers of a vertex
SIZE = ROWS * WIDTH  # numbers of a block
BLOCKS = 8  # of a batch
BATCH = BLOCKS * WIDTH  # vertices of a batch
VECTORS = 3 * WIDTH  # numbers of a vector for each vertex of a block


class Work:
    """What one thread works on: the batch it carries, and copies that deformers have it keep meanwhile."""

    def __init__(self) -> None:
        self.begin = self.end = 0  # the batch's vertices
        self.state = np.empty(0)  # its blocks, one after another
        self.influence = np.empty(0)  # of each vertex a weight and its slopes along x, y, z; in blocks too
        self.kept: list[FloatArray] = []  # states to come back to, the latest last
        self._states, self._influences = np.empty(BLOCKS * SIZE), np.empty(BLOCKS * 4 * WIDTH)

    def take(self, points: FloatArray, begin: int, end: int) -> None:
        """Begin with the vertices begin to end, at most BATCH, of points (V, 3)."""
        self.begin, self.end = begin, end
        blocks = -(-(end - begin) // WIDTH)
        self.state = self._states[: blocks * SIZE]
        self.influence = self._influences[: blocks * 4 * WIDTH]
        load(points, begin, end, self.state)

    def keep(self) -> None:
        """Remember the state as it is."""
        self.kept.append(self.state.copy())

    def weigh(self, weights: float | FloatArray) -> None:
        """Set the influence of the batch's vertices: one weight, or one for each; without slopes."""
        rows = self.influence.reshape(-1, 4, WIDTH)
        rows[:] = 0
        each = np.zeros(rows[:, 0].size)
        each[: self.end - self.begin] = weights
        rows[:, 0] = each.reshape(-1, WIDTH)


@kernel
def load(points, begin, end, state):
    """Vertices begin to end of points (V, 3) into the blocks of a batch, each with the identity around it."""
    for block in range((end - begin + WIDTH - 1) // WIDTH):
        m = state[block * SIZE : (block + 1) * SIZE]
        first = begin + block * WIDTH
        count = min(WIDTH, end - first)
        for i in range(count):
            m[i] = points[first + i, 0]
            m[i + WIDTH] = points[first + i, 1]
            m[i + 2 * WIDTH] = points[first + i, 2]
        # A block that is not full is filled up with its first vertex
        for i in range(count, WIDTH):
            m[i], m[i + WIDTH], m[i + 2 * WIDTH] = m[0], m[WIDTH], m[2 * WIDTH]
        for k in range(3, ROWS):
            unit = 1.0 if k % 4 == 3 else 0.0
            for i in range(WIDTH):
                m[i + k * WIDTH] = unit


@kernel
def turn(state, matrix):
    """Everything by an affine matrix (12,): the rows of a 3x4."""
    for block in range(len(state) // SIZE):
        m = state[block * SIZE : (block + 1) * SIZE]
        for i in range(WIDTH):
            x, y, z = m[i], m[i + WIDTH], m[i + 2 * WIDTH]
            m[i] = matrix[0] * x + matrix[1] * y + matrix[2] * z + matrix[3]
            m[i + WIDTH] = matrix[4] * x + matrix[5] * y + matrix[6] * z + matrix[7]
            m[i + 2 * WIDTH] = matrix[8] * x + matrix[9] * y + matrix[10] * z + matrix[11]
        for k in range(3, 6):
            c = m[k * WIDTH :]
            for i in range(WIDTH):
                x, y, z = c[i], c[i + 3 * WIDTH], c[i + 6 * WIDTH]
                c[i] = matrix[0] * x + matrix[1] * y + matrix[2] * z
                c[i + 3 * WIDTH] = matrix[4] * x + matrix[5] * y + matrix[6] * z
                c[i + 6 * WIDTH] = matrix[8] * x + matrix[9] * y + matrix[10] * z


@kernel
def fade(state, reach, influence):
    """Every influence times what is left of 1 on the way from the origin to `reach`: 1 - 3 t^2 + 2 t^3."""
    for block in range(len(state) // SIZE):
        m = state[block * SIZE : (block + 1) * SIZE]
        w = influence[4 * block * WIDTH : 4 * (block + 1) * WIDTH]
        for i in range(WIDTH):
            x, y, z = m[i], m[i + WIDTH], m[i + 2 * WIDTH]
            t = min(np.sqrt(x * x + y * y + z * z) / reach, 1.0)
            slope = 6.0 * (t - 1.0) / (reach * reach) * w[i]
            w[i] *= (1.0 - t) * (1.0 - t) * (1.0 + 2.0 * t)
            w[i + WIDTH], w[i + 2 * WIDTH], w[i + 3 * WIDTH] = slope * x, slope * y, slope * z


@kernel
def mix(state, kept, influence):
    """From what was kept towards what is, by the influence w of each vertex: kept + w (state - kept).

    Where w itself changes along the way it was given, by its slopes, the Jacobian takes that in.
    """
    for block in range(len(state) // SIZE):
        m = state[block * SIZE : (block + 1) * SIZE]
        old = kept[block * SIZE : (block + 1) * SIZE]
        w = influence[4 * block * WIDTH : 4 * (block + 1) * WIDTH]
        for r in range(3):
            for k in range(3):
                for i in range(WIDTH):
                    j = (3 + 3 * r + k) * WIDTH + i
                    moved = m[r * WIDTH + i] - old[r * WIDTH + i]
                    # The slopes are against the kept place; the Jacobian is against the place first given
                    slope = (
                        w[i + WIDTH] * old[(3 + k) * WIDTH + i]
                        + w[i + 2 * WIDTH] * old[(6 + k) * WIDTH + i]
                        + w[i + 3 * WIDTH] * old[(9 + k) * WIDTH + i]
                    )
                    m[j] = old[j] + w[i] * (m[j] - old[j]) + moved * slope
        for r in range(3):
            for i in range(WIDTH):
                j = r * WIDTH + i
                m[j] = old[j] + w[i] * (m[j] - old[j])


@kernel
def finish(state, begin, end, side, normals, tangents, out_points, out_normals, out_tangents):
    """Vertices begin to end of a batch into points, normals and tangents.

    A normal goes by the cofactors of the Jacobian, so that it stays upright on the moved surface, and is
    turned where side is -1; a tangent goes along with the surface. Where space was flattened so that no
    direction is left, they stay as they were.
    """
    given = on_stack(np.float64, VECTORS)
    for block in range(len(state) // SIZE):
        m = state[block * SIZE : (block + 1) * SIZE]
        first = begin + block * WIDTH
        count = min(WIDTH, end - first)
        for i in range(count):
            for k in range(3):
                out_points[first + i, k] = m[i + k * WIDTH]
        if len(tangents) > 0:
            for i in range(count):
                for k in range(3):
                    given[i + k * WIDTH] = tangents[first + i, k]
            for i in range(WIDTH):
                tx, ty, tz = given[i], given[i + WIDTH], given[i + 2 * WIDTH]
                x = m[i + 3 * WIDTH] * tx + m[i + 4 * WIDTH] * ty + m[i + 5 * WIDTH] * tz
                y = m[i + 6 * WIDTH] * tx + m[i + 7 * WIDTH] * ty + m[i + 8 * WIDTH] * tz
                z = m[i + 9 * WIDTH] * tx + m[i + 10 * WIDTH] * ty + m[i + 11 * WIDTH] * tz
                length = np.sqrt(x * x + y * y + z * z)
                known = length > 0.0
                f = 1.0 / length if known else 0.0
                given[i] = x * f if known else tx
                given[i + WIDTH] = y * f if known else ty
                given[i + 2 * WIDTH] = z * f if known else tz
            for i in range(count):
                for k in range(3):
                    out_tangents[first + i, k] = given[i + k * WIDTH]
                out_tangents[first + i, 3] = side * tangents[first + i, 3]
        if len(normals) > 0:
            for i in range(count):
                for k in range(3):
                    given[i + k * WIDTH] = normals[first + i, k]
            for i in range(WIDTH):
                nx, ny, nz = given[i], given[i + WIDTH], given[i + 2 * WIDTH]
                ax, bx, cx = m[i + 3 * WIDTH], m[i + 4 * WIDTH], m[i + 5 * WIDTH]
                ay, by, cy = m[i + 6 * WIDTH], m[i + 7 * WIDTH], m[i + 8 * WIDTH]
                az, bz, cz = m[i + 9 * WIDTH], m[i + 10 * WIDTH], m[i + 11 * WIDTH]
                x = nx * (by * cz - bz * cy) + ny * (cy * az - cz * ay) + nz * (ay * bz - az * by)
                y = nx * (bz * cx - bx * cz) + ny * (cz * ax - cx * az) + nz * (az * bx - ax * bz)
                z = nx * (bx * cy - by * cx) + ny * (cx * ay - cy * ax) + nz * (ax * by - ay * bx)
                length = np.sqrt(x * x + y * y + z * z)
                known = length > 0.0
                f = side / length if known else 0.0
                given[i] = x * f if known else nx
                given[i + WIDTH] = y * f if known else ny
                given[i + 2 * WIDTH] = z * f if known else nz
            for i in range(count):
                for k in range(3):
                    out_normals[first + i, k] = given[i + k * WIDTH]
