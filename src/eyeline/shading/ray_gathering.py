"""What rays bring back to the lanes they came from: an open sky, a part of a lamp, what a mirror shows."""

from __future__ import annotations

import numpy as np

from eyeline.jit import kernel
from eyeline.shading.environment import (
    BOX,
    BOX_AXIS,
    CEILING,
    DIELECTRIC,
    FLOOR,
    mirrored,
    open_to_mirror,
    split_sum,
)
from eyeline.shading.lanes import (
    GX,
    LIT,
    METALLIC,
    NX,
    NY,
    NZ,
    OCCLUSION,
    OPEN,
    OUT_RED,
    RED,
    ROUGHNESS,
    VX,
    VY,
    VZ,
    X,
    Y,
    Z,
)

ZERO, HALF, ONE, TWO = np.float32(0), np.float32(0.5), np.float32(1), np.float32(2)
# Roughness up to which a mirror shows things, and from which on only the surroundings, blurred
CLEAR, BLURRED = np.float32(0.3), np.float32(0.6)
FAINT = np.float32(0.01)  # part of the light: a fainter mirror is not worth a ray


@kernel
def take_sky(lanes, chosen, origins, directions, length, floor, reach, amount):
    """Fill OPEN: what is nearer than `reach` closes the sky, the nearer the more; the floor too."""
    count = directions.shape[0] // max(chosen.shape[0], 1)
    for m in range(chosen.shape[0]):
        closed = ZERO
        for ray in range(m * count, (m + 1) * count):
            far = length[ray]
            if directions[ray, 1] < ZERO:
                far = min(far, max(np.float32(floor) - origins[ray, 1], -reach) / directions[ray, 1])
            near = ONE - min(max(far, ZERO) / reach, ONE)
            closed += near * near
        lanes[OPEN, chosen[m]] = ONE - amount * closed / np.float32(count)


@kernel
def take_light(lanes, chosen, hit, reach, begun, total):
    """Add to LIT the part, of `total` rays, that reaches the light; begun: 0 for the first rays."""
    count = hit.shape[0] // max(chosen.shape[0], 1)
    for m in range(chosen.shape[0]):
        arrived = 0
        for ray in range(m * count, (m + 1) * count):
            arrived += (hit[ray] < 0) & (reach[ray] >= ZERO)
        before = lanes[LIT, chosen[m]] * np.float32(begun)
        lanes[LIT, chosen[m]] = (before + np.float32(arrived)) / np.float32(total)


@kernel
def mirrors(lanes, count, parts, weight, seen):
    """Fill weight and seen (3, K): how much a clear mirror throws to the eye, and what of the surroundings.

    The weight is 0 where no ray is worth it.
    """
    for i in range(count):
        nx, ny, nz = lanes[NX, i], lanes[NY, i], lanes[NZ, i]
        vx, vy, vz = lanes[VX, i], lanes[VY, i], lanes[VZ, i]
        facing = nx * vx + ny * vy + nz * vz
        rx, ry, rz = TWO * facing * nx - vx, TWO * facing * ny - vy, TWO * facing * nz - vz
        to_eye, roughness = min(max(facing, ZERO), ONE), lanes[ROUGHNESS, i]
        scale, offset = split_sum(to_eye, roughness)
        bounced = ONE / (scale + offset) - ONE
        to_box = rx * parts[BOX_AXIS] + ry * parts[BOX_AXIS + 1] + rz * parts[BOX_AXIS + 2]
        up, box = mirrored(ry, to_box, roughness)
        clear = min(max((BLURRED - roughness) / (BLURRED - CLEAR), ZERO), ONE)
        most = ZERO
        for k in range(3):
            zero = DIELECTRIC + (lanes[RED + k, i] - DIELECTRIC) * lanes[METALLIC, i]
            weight[k, i] = (zero * scale + offset) * (ONE + zero * bounced) * clear
            most = max(most, weight[k, i])
            seen[k, i] = (
                parts[FLOOR + k] + (parts[CEILING + k] - parts[FLOOR + k]) * up + parts[BOX + k] * box
            )
        for k in range(3):
            weight[k, i] = weight[k, i] if most > FAINT else ZERO


@kernel
def take_mirror(lanes, chosen, weight, seen, row, light):
    """Put what mirrors show in place of their share of the surroundings.

    row: of each ray, its row of light (L, 3), or -1 where it met nothing.
    """
    count = row.shape[0] // max(chosen.shape[0], 1)
    for m in range(chosen.shape[0]):
        i = chosen[m]
        facing = lanes[NX, i] * lanes[VX, i] + lanes[NY, i] * lanes[VY, i] + lanes[NZ, i] * lanes[VZ, i]
        share = open_to_mirror(min(max(facing, ZERO), ONE), lanes[OCCLUSION, i] * lanes[OPEN, i])
        for k in range(3):
            total = ZERO
            for ray in range(m * count, (m + 1) * count):
                total += light[row[ray], k] if row[ray] >= 0 else seen[k, i]
            lanes[OUT_RED + k, i] += weight[k, i] * (total / np.float32(count) - share * seen[k, i])


@kernel
def face_ray(lanes, count, places, directions):
    """Turn points that rays have met towards where the rays come from."""
    for i in range(count):
        # A face that the eye sees from its edge cannot tell where on it a point is; the ray can
        lanes[X, i], lanes[Y, i], lanes[Z, i] = places[i, 0], places[i, 1], places[i, 2]
        lanes[VX, i], lanes[VY, i], lanes[VZ, i] = -directions[i, 0], -directions[i, 1], -directions[i, 2]
        if not lanes[NX, i] + lanes[NY, i] + lanes[NZ, i] < TWO:
            lanes[NX, i], lanes[NY, i], lanes[NZ, i] = lanes[GX, i], lanes[GX + 1, i], lanes[GX + 2, i]
        for first in (NX, GX):
            out = (
                lanes[first, i] * lanes[VX, i]
                + lanes[first + 1, i] * lanes[VY, i]
                + lanes[first + 2, i] * lanes[VZ, i]
            )
            if out < ZERO:
                for k in range(first, first + 3):
                    lanes[k, i] = -lanes[k, i]
