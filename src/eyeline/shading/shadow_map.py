"""What a light sees: the same visible-surface question, asked from where it stands. [Williams78]"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from eyeline.geometry import transform
from eyeline.geometry.arrays import ByteArray, FloatArray, IntArray
from eyeline.geometry.bounds import Bounds
from eyeline.jit import helper, kernel, share, threads
from eyeline.projection.project import project
from eyeline.projection.projected import Projected
from eyeline.scene.camera import Camera
from eyeline.scene.scene import Scene
from eyeline.shading.cutout import see
from eyeline.shading.light_table import PlacedLight
from eyeline.visibility.zbuffer.zbuffer import ZBuffer

BLOCK = 8  # texels; as far as the widest filter reaches. A map has nothing of its own so near its border
LEVELS = 2  # of the map: every texel, and every second for filters that reach twice as far
POOL = 4  # texels a side; a map ends with the nearest depth in each pool, so that nothing thin is missed
TEXELS_OF_LEVELS = POOL * POOL + POOL * POOL // 4 + 1  # of a map, for each pool
OUTLINE = 3.0  # texels of depth; what stands out less has no outline that a filter could soften
EMPTY, CALM, EDGY = 0, 1, 2  # what a block and its neighbours hold: nothing, one smooth surface, an outline
# Columns of `rows`: map_from_place (4, 4), by rows, to u w, v w, depth w, w in texels from places seen
# from the eye; the first three rows of its inverse transpose (3, 4), which moves planes; and numbers
MATRIX, PLANES = 0, 16
UNIT, UNIT_BY_DEPTH = 28, 29  # how much depth one texel spans, straight on: constant, and per depth
WIDENING = 30  # texels of penumbra for each unit of depth between a blocker and what it shades
COLUMNS = 31
CUBE = tuple(transform.look_at((0, 0, 0), axis, up) for axis, up in (
    ((1, 0, 0), (0, 1, 0)), ((-1, 0, 0), (0, 1, 0)), ((0, 1, 0), (0, 0, 1)),
    ((0, -1, 0), (0, 0, 1)), ((0, 0, 1), (0, 1, 0)), ((0, 0, -1), (0, 1, 0)),
))  # fmt: skip


class ShadowMaps(NamedTuple):
    """The maps of all lights that cast shadows: M squares of `size` texels."""

    size: int
    rows: FloatArray  # (M, 31) float64
    depth: FloatArray  # flat float32, map after map: its levels, then its pools; reversed, 0 is nothing
    blocks: ByteArray  # flat uint8, map after map, (size / BLOCK)^2 each: EMPTY, CALM or EDGY
    of_light: IntArray  # (L, 2) int64: each light's first map, and how many: 0, 1, or 6 for a cube


def shadow_maps(
    scene: Scene, casting: Sequence[PlacedLight], count: int, eye: FloatArray, size: int, most: int
) -> ShadowMaps:
    """The maps of the first of `count` lights, those that are casting, until `most` are drawn.

    size: texels along a side, a multiple of BLOCK. Blended surfaces cast no shadow, and holes let light pass.
    """
    of_light = np.zeros((count, 2), np.int64)
    rows: list[FloatArray] = []
    depths: list[FloatArray] = []
    blocks: list[ByteArray] = []
    bounds = scene.bounds
    for index, placed in enumerate(() if bounds.is_empty else casting):
        cameras = light_cameras(placed, bounds, size / (size - 2 * BLOCK - 4))
        if len(rows) + len(cameras) > most:
            continue
        of_light[index] = len(rows), len(cameras)
        for camera in cameras:
            row, depth = _draw(scene, camera, placed, eye, size)
            rows.append(row)
            depths.extend(depth[:: 1 << level, :: 1 << level].reshape(-1) for level in range(LEVELS))
            pools = np.empty((size // POOL) ** 2, np.float32)
            blocks.append(_blocks(depth.reshape(-1), row, size, pools))
            depths.append(pools)
    nothing = np.zeros(0, np.float32)
    return ShadowMaps(
        size,
        np.array(rows).reshape(-1, COLUMNS),
        np.concatenate([*depths, nothing]),
        np.concatenate([*blocks, nothing.astype(np.uint8)]),
        of_light,
    )


def light_cameras(placed: PlacedLight, bounds: Bounds, margin: float) -> list[Camera]:
    """The eyes of a light: one, or six for one that shines all around; each `margin` times as wide."""
    light, matrix = placed.light, placed.world_from_light
    if light.kind == "directional":
        turned = bounds.moved(np.linalg.inv(matrix))
        width = turned.high - turned.low
        centred = matrix.copy()
        centred[:3, 3] = (matrix @ [*turned.centre, 1.0])[:3]
        return [Camera(height=float(max(width[0], width[1])) * margin or 1.0, world_from_eye=centred)]
    if light.kind == "spot" and light.outer_cone < math.radians(60):
        half = math.tan(max(light.outer_cone, math.radians(1)))
        return [Camera(fov=2 * math.atan(half * margin), world_from_eye=matrix)]
    at = np.eye(4)
    at[:3, 3] = matrix[:3, 3]
    return [Camera(fov=2 * math.atan(margin), world_from_eye=at @ side) for side in CUBE]


def _draw(
    scene: Scene, camera: Camera, placed: PlacedLight, eye: FloatArray, size: int
) -> tuple[FloatArray, FloatArray]:
    """The row (31,) of a map, and its depth (size, size)."""
    projected = project(scene, camera, (size, size), "none")
    ((seen, _, _),) = see(scene, projected, ZBuffer(), see_through=True)
    depth = seen.depth
    half = np.array([[size / 2, 0, 0, size / 2], [0, -size / 2, 0, size / 2], [0, 0, 1, 0], [0, 0, 0, 1]])
    world_from_place = np.eye(4)
    world_from_place[:3, 3] = eye
    matrix = half @ projected.clip_from_world @ world_from_place
    planes = np.linalg.inv(matrix).T[:3]
    numbers = _depth_numbers(projected, placed, scene.bounds.diagonal, size)
    return np.concatenate([matrix.reshape(-1), planes.reshape(-1), numbers]), depth


def _depth_numbers(projected: Projected, placed: PlacedLight, diagonal: float, size: int) -> list[float]:
    """UNIT, UNIT_BY_DEPTH and WIDENING."""
    camera = projected.camera
    assert camera.near is not None
    if camera.height is not None and camera.far is not None:
        span = camera.far - camera.near
        return [camera.height / (size * span), 0.0, placed.size * span * size / camera.height]
    assert camera.fov is not None
    width = 2 * math.tan(camera.fov / 2)
    return [0.0, width / size, placed.size * diagonal * size / (width * camera.near)]


def _blocks(depth: FloatArray, row: FloatArray, size: int, pools: FloatArray) -> ByteArray:
    """What each block and its eight neighbours hold, flat; fills the pools, too."""
    count = size // BLOCK
    own = np.empty((count, count), np.uint8)
    parts = min(threads(), count)
    units = row[UNIT], row[UNIT_BY_DEPTH]
    share(lambda part: mark_blocks(depth, size, units, own, pools, part, parts), parts)
    wide = np.pad(own, 1)
    around = np.stack([wide[y : y + count, x : x + count] for y in range(3) for x in range(3)])
    states: ByteArray = around.max(axis=0).reshape(-1)
    return states


@kernel
def mark_blocks(depth, size, units, own, pools, part, parts):
    """Fill own with EMPTY, CALM or EDGY: an outline is where depth bends by more than OUTLINE; and pools."""
    unit, unit_by_depth = units
    count = own.shape[0]
    for block_row in range(part, count, parts):
        for row in range(block_row * BLOCK // POOL, (block_row + 1) * BLOCK // POOL):
            fill_pools(depth[row * POOL * size :], size, pools[row * (size // POOL) :])
        for block in range(count):
            own[block_row, block] = EMPTY
        for y in range(block_row * BLOCK, block_row * BLOCK + BLOCK):
            above, below = max(y - 1, 0), min(y + 1, size - 1)
            for block in range(count):
                bent, most = np.float32(-1), np.float32(0)
                for x in range(block * BLOCK, block * BLOCK + BLOCK):
                    here = depth[y * size + x]
                    across = depth[y * size + max(x - 1, 0)] + depth[y * size + min(x + 1, size - 1)]
                    down = depth[above * size + x] + depth[below * size + x]
                    bend = max(abs(across - here - here), abs(down - here - here))
                    bent = max(bent, bend - np.float32(OUTLINE * (unit + unit_by_depth * here)))
                    most = max(most, max(here, max(across, down)))
                if bent > 0:
                    own[block_row, block] = EDGY
                elif most > 0 and own[block_row, block] == EMPTY:
                    own[block_row, block] = CALM


@helper
def fill_pools(rows, size, pools):
    """The nearest of each POOL x POOL texels along the first rows."""
    for pool in range(size // POOL):
        nearest = np.float32(0)
        for y in range(POOL):
            for x in range(POOL):
                nearest = max(nearest, rows[y * size + pool * POOL + x])
        pools[pool] = nearest
