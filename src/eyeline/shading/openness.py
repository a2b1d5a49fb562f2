"""How open the surroundings of each pixel are, from the depth buffer alone: creases and contacts darken.

Neighbours on a fixed spiral count as far as they rise over the pixel's plane and are near. [McGuire12]
It is found at half the picture's resolution, smoothed where depth is smooth, and looked up the same way.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.jit import kernel, share, threads
from eyeline.projection.projected import Projected
from eyeline.shading.floor import Floor
from eyeline.shading.lanes import OPEN, X, Y, Z
from eyeline.shading.region import Region
from eyeline.visibility.method import Visible

REACH_PART = 0.07  # of the scene's diagonal: how far a neighbour can be and still darken
TAPS = 14
TURNS = 5  # of the spiral; shares no divisor with TAPS, so that taps spread evenly
LEAST_PIXELS, MOST_PIXELS = 6, 40  # of the half-size picture: how far the spiral goes
MARGIN = MOST_PIXELS + 2  # pixels of nothing around the half-size picture, so that taps need no test
FAR = np.float32(1e18)  # metres to nothing
LEAST_RISE = 0.01  # squared sine over a pixel's plane below which a neighbour is the surface itself
STRENGTH = 3.4  # so that a right-angled crease is about as dark as a hemisphere half closed
SMOOTHING = 3  # pixels to each side
LEAST_ALIKE = np.float32(1e-3)
ZERO, ONE, TINY = np.float32(0), np.float32(1), np.float32(1e-30)


class Openness(NamedTuple):
    """A half-size picture of how much of the hemisphere is open, with a margin all around."""

    width: int  # with the margins
    open: FloatArray  # flat float32, 0..1
    distance: FloatArray  # flat float32, metres along the view axis
    per_alike: float  # one over the metres of distance within which neighbours belong together
    matrix: (
        FloatArray  # (4, 4) float32: places from the eye to column w, row w, w with margins, and the distance
    )


def openness_of(
    visible: Visible, floor: Floor | None, region: Region, diagonal: float, amount: float
) -> Openness:
    """The openness of a visible answer; the floor counts as a surface, and all outside the region is open.

    diagonal: of the scene, metres; amount: 0 nothing darkens .. 1.
    """
    projected = visible.projected
    rows, columns = (projected.height + 1) // 2, (projected.width + 1) // 2
    height, width = rows + 2 * MARGIN, columns + 2 * MARGIN
    reach = REACH_PART * diagonal
    distance, rough, across, smooth = (np.ones(height * width, np.float32) for _ in range(4))
    if amount > 0 and region.width > 0:
        distance[:] = FAR
        lens = lens_of(projected)
        spiral = _spiral(_reach_in_pixels(projected, reach), width)
        numbers = np.array([1 / reach**2, LEAST_RISE, amount * STRENGTH / TAPS, 4 / reach], np.float32)
        floor_rows = floor.distances if floor is not None else np.zeros(3)
        left, right = region.left // 2, (region.right + 1) // 2
        top, bottom = region.top // 2, (region.bottom + 1) // 2
        parts = min(threads(), rows)

        def over(task: Callable[..., None], low: int, high: int, *arguments: object) -> None:
            cuts = [low + (high - low) * part // parts for part in range(parts + 1)]
            share(lambda part: task(*arguments, width, cuts[part], cuts[part + 1]), parts)

        over(halve, 0, rows, visible.depth, lens, floor_rows, distance)
        over(obscure, top, bottom, distance, lens, spiral, numbers, rough, left, right)
        over(smooth_along, top, bottom, rough, distance, across, numbers, left, right, 1)
        over(smooth_along, top, bottom, across, distance, smooth, numbers, left, right, width)
    return Openness(width, smooth, distance, 4 / reach, _half_from_place(projected))


def _half_from_place(projected: Projected) -> FloatArray:
    """(4, 4) float32, see Openness.matrix."""
    camera = projected.camera
    eye = np.eye(4)
    eye[:3, 3] = camera.world_from_eye[:3, 3]
    width, height = projected.width, projected.height
    # Half-size pixel c stands for the picture's pixel 2c, centred at 2c + 1/2
    shift_x, shift_y = width / 4 - 0.25 + MARGIN, height / 4 - 0.25 + MARGIN
    half = np.array([[width / 4, 0, 0, shift_x], [0, -height / 4, 0, shift_y], [0, 0, 0, 1]])
    distance = -(camera.eye_from_world @ eye)[2:3]
    return np.vstack([half @ projected.clip_from_world @ eye, distance]).astype(np.float32)


def lens_of(projected: Projected) -> FloatArray:
    """(8,) float32: x = (0 + 1 column) s, y = (2 + 3 row) s of the half-size picture, in the eye's axes.

    s is the distance in perspective, else 1; 4: 1 in perspective; distance = 1 / (5 + 6 depth), or
    5 + 6 depth.
    """
    camera = projected.camera
    clip = camera.clip_from_eye(projected.width / projected.height)
    # Half-size pixel (c, r) stands for the picture's pixel (2c, 2r), centred at 2c + 1/2, 2r + 1/2
    x0, x1 = (1 / projected.width - 1) / clip[0, 0], 4 / projected.width / clip[0, 0]
    y0, y1 = (1 - 1 / projected.height) / clip[1, 1], -4 / projected.height / clip[1, 1]
    a, b = clip[2, 2], clip[2, 3]
    perspective = camera.fov is not None
    # Perspective: depth = (b - a distance) / distance. Orthographic: depth = b - a distance
    depth_0, depth_1 = (a / b, 1 / b) if perspective else (b / a, -1 / a)
    return np.array([x0, x1, y0, y1, float(perspective), depth_0, depth_1, 0.0], np.float32)


def _reach_in_pixels(projected: Projected, reach: float) -> float:
    """How far the spiral goes, half-size pixels, from how large `reach` is in the middle of the scene."""
    camera, bounds = projected.camera, projected.surfaces
    clip = camera.clip_from_eye(projected.width / projected.height)
    size = reach * clip[1, 1] * projected.height / 4
    if camera.fov is not None and bounds:
        middle = np.mean(
            [surface.world_from_mesh @ [*surface.mesh.bounds.centre, 1.0] for surface in bounds], axis=0
        )
        size /= max(-(camera.eye_from_world @ middle)[2], camera.near or 1.0)
    return float(min(max(size, LEAST_PIXELS), MOST_PIXELS))


def _spiral(radius: float, width: int) -> FloatArray:
    """(TAPS, 3) columns, rows, and the step in the flat picture, of taps in order of distance."""
    part = (np.arange(TAPS) + 0.5) / TAPS
    angle = 2 * np.pi * TURNS * part
    columns = np.rint(radius * part * np.cos(angle))
    rows = np.rint(radius * part * np.sin(angle))
    return np.stack([columns, rows, rows * width + columns], axis=1).astype(np.int64)


@kernel
def halve(depth, lens, floor, distance, width, top, bottom):
    """Fill the distance of every second pixel of every second row; the floor's where nothing stands."""
    for row in range(top, bottom):
        start = (row + MARGIN) * width + MARGIN
        down = floor[1] * (2 * row + 0.5) + floor[2]
        for column in range((depth.shape[1] + 1) // 2):
            here = depth[2 * row, 2 * column]
            value = lens[5] + lens[6] * here
            if lens[4] > 0:
                value = ONE / value
            if here == 0:
                value = np.float32(floor[0] * (2 * column + 0.5) + down)
                if value <= 0:
                    value = FAR
                elif lens[4] > 0:
                    value = ONE / value
            distance[start + column] = value


@kernel
def obscure(distance, lens, spiral, numbers, openness, left_end, right_end, width, top, bottom):
    """Fill openness, unsmoothed: row by row, tap by tap, so that the innermost loop is a vector's."""
    per_squared_reach, least, strength = numbers[0], numbers[1], numbers[2]
    perspective = lens[4]
    flat = ONE - perspective
    x1, y0, y1 = lens[1], lens[2], lens[3]
    x0 = lens[0] + x1 * np.float32(left_end)
    columns = right_end - left_end
    lines = np.empty((6, columns), np.float32)
    for row in range(top, bottom):
        start = (row + MARGIN) * width + MARGIN + left_end
        nearest = FAR
        for column in range(columns):
            nearest = min(nearest, distance[start + column])
        if nearest >= FAR:
            continue
        y = y0 + y1 * np.float32(row)
        # Place, and the unit normal from the nearer neighbour on either axis
        for column in range(columns):
            i = start + column
            x = x0 + x1 * np.float32(column)
            here = distance[i]
            left, right, above, below = (
                distance[i - 1],
                distance[i + 1],
                distance[i - width],
                distance[i + width],
            )
            leftward = abs(left - here) < abs(right - here)
            upward = abs(above - here) < abs(below - here)
            across, step = (here - left, x - x1) if leftward else (right - here, x + x1)
            other = left if leftward else right
            way = -ONE if leftward else ONE
            ax = (step * (flat + other * perspective) - x * (flat + here * perspective)) * way
            ay = y * across * perspective
            az = -across
            down, step = (here - above, y - y1) if upward else (below - here, y + y1)
            other = above if upward else below
            way = -ONE if upward else ONE
            bx = x * down * perspective
            by = (step * (flat + other * perspective) - y * (flat + here * perspective)) * way
            bz = -down
            nx, ny, nz = by * az - bz * ay, bz * ax - bx * az, bx * ay - by * ax
            scale = ONE / math.sqrt(nx * nx + ny * ny + nz * nz + TINY)
            scale_here = flat + here * perspective
            lines[0, column], lines[1, column], lines[2, column] = x * scale_here, y * scale_here, here
            lines[3, column], lines[4, column], lines[5, column] = nx * scale, ny * scale, nz * scale
            openness[i] = ZERO
        # Rows of their own, indexed from 0: only so the compiler sees that it may use vectors
        total = openness[start : start + columns]
        at_x, at_y, at_z = lines[0], lines[1], lines[2]
        to_x, to_y, to_z = lines[3], lines[4], lines[5]
        for tap in range(spiral.shape[0]):
            dx, first = np.float32(spiral[tap, 0]), start + spiral[tap, 2]
            tap_y = y + y1 * np.float32(spiral[tap, 1])
            tapped = distance[first : first + columns]
            for column in range(columns):
                there = tapped[column]
                scale = flat + there * perspective
                vx = (x0 + x1 * (np.float32(column) + dx)) * scale - at_x[column]
                vy = tap_y * scale - at_y[column]
                vz = at_z[column] - there
                squared = vx * vx + vy * vy + vz * vz + TINY
                rise = max(vx * to_x[column] + vy * to_y[column] + vz * to_z[column], ZERO)
                near = max(ONE - squared * per_squared_reach, ZERO)
                total[column] += near * max(rise * rise / squared - least, ZERO)
        for column in range(columns):
            total[column] = max(ONE - strength * total[column], ZERO)


@kernel
def smooth_along(rough, distance, smooth, numbers, left_end, right_end, step, width, top, bottom):
    """Fill smooth with the mean of each pixel's neighbours, `step` apart, that are as far from the eye."""
    per_alike = numbers[3]
    for row in range(top, bottom):
        start = (row + MARGIN) * width + MARGIN
        for i in range(start + left_end, start + right_end):
            here = distance[i]
            total, weights = rough[i], ONE
            for k in range(1, SMOOTHING + 1):
                j = i - k * step
                weight = max(ONE - abs(distance[j] - here) * per_alike, ZERO)
                total += rough[j] * weight
                weights += weight
                j = i + k * step
                weight = max(ONE - abs(distance[j] - here) * per_alike, ZERO)
                total += rough[j] * weight
                weights += weight
            smooth[i] = total / weights


@kernel
def look_up(lanes, count, openness):
    """Fill OPEN with how open it is around each point, by those of four pixels that are as far away."""
    m, width, per_alike = openness.matrix, openness.width, np.float32(openness.per_alike)
    values, distances = openness.open, openness.distance
    most_u = np.float32(width - 2)
    most_v = np.float32(values.shape[0] // width - 2)
    places = np.empty((3, count), np.float32)
    us, vs, aways = places[0], places[1], places[2]
    xs, ys, zs = lanes[X], lanes[Y], lanes[Z]
    for i in range(count):
        x, y, z = xs[i], ys[i], zs[i]
        per_w = ONE / (m[2, 0] * x + m[2, 1] * y + m[2, 2] * z + m[2, 3])
        u = (m[0, 0] * x + m[0, 1] * y + m[0, 2] * z + m[0, 3]) * per_w
        v = (m[1, 0] * x + m[1, 1] * y + m[1, 2] * z + m[1, 3]) * per_w
        # Written so that a place at the eye, which is not a number here, falls into the margin
        us[i], vs[i] = min(u if u > ZERO else ZERO, most_u), min(v if v > ZERO else ZERO, most_v)
        aways[i] = m[3, 0] * x + m[3, 1] * y + m[3, 2] * z + m[3, 3]
    for i in range(count):
        u, v, away = us[i], vs[i], aways[i]
        column, row = np.uint32(u), np.uint32(v)
        right, down = u - np.float32(column), v - np.float32(row)
        a = np.uint64(row) * np.uint64(width) + np.uint64(column)
        b, c = a + np.uint64(1), a + np.uint64(width)
        d = c + np.uint64(1)
        lanes[OPEN, i] = ONE
        if values[a] == ONE and values[b] == ONE and values[c] == ONE and values[d] == ONE:
            continue
        # A little of each, should none be alike
        wa = max(ONE - abs(distances[a] - away) * per_alike, LEAST_ALIKE) * (ONE - right) * (ONE - down)
        wb = max(ONE - abs(distances[b] - away) * per_alike, LEAST_ALIKE) * right * (ONE - down)
        wc = max(ONE - abs(distances[c] - away) * per_alike, LEAST_ALIKE) * (ONE - right) * down
        wd = max(ONE - abs(distances[d] - away) * per_alike, LEAST_ALIKE) * right * down
        total = values[a] * wa + values[b] * wb + values[c] * wc + values[d] * wd
        lanes[OPEN, i] = total / (wa + wb + wc + wd)
