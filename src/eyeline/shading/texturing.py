"""Every texture of a material, laid over the lanes of its points."""

from __future__ import annotations

import math

import numpy as np

from eyeline.jit import helper, kernel
from eyeline.shading.barycentric import corners_of, edges_of, material_of, mixed, shares_at, surface_of
from eyeline.shading.geometry_table import FACES, MIRRORED, POINTS, TANGENTS, UV0, UV1, WORLD
from eyeline.shading.lanes import (
    ALPHA,
    BLUE,
    COVER,
    EMISSIVE_BLUE,
    EMISSIVE_GREEN,
    EMISSIVE_RED,
    GREEN,
    METALLIC,
    NX,
    NY,
    NZ,
    OCCLUSION,
    RED,
    ROUGHNESS,
)
from eyeline.shading.material_table import (
    BASE_SLOT,
    BLENDED,
    EMISSION_SLOT,
    METAL_SLOT,
    NORMAL_SCALE,
    NORMAL_SLOT,
    OCCLUSION_SLOT,
    OCCLUSION_STRENGTH,
)
from eyeline.shading.sampling import footprint_level, sampled
from eyeline.shading.texture_table import HEIGHT, LEVELS, WIDTH


@kernel
def lay_textures(geometry, materials, decoded, points, begin, end, lanes):
    """Change the lanes of points begin .. end, which `gather` filled, by the textures of their materials."""
    faces, xs, ys = points
    surface, current = 0, -1
    for point in range(begin, end):
        lane = point - begin
        if faces[point] != current:
            current = faces[point]
            surface = surface_of(geometry.first_faces, current, surface)
            face = current - geometry.first_faces[surface]
            material = material_of(geometry, surface, face)
            textured = has_textures(materials.slots, material)
            corners = corners_of(geometry.faces, geometry.places[surface, FACES] + face)
            first = geometry.places[surface, POINTS]
            edges, clockwise = edges_of(geometry.matrices, surface, geometry.points, first, corners)
            side = -1.0 if clockwise != (geometry.places[surface, MIRRORED] != 0) else 1.0
        if not textured:
            continue
        shares, scale = shares_at(edges, float(xs[point]), float(ys[point]))
        texture_point(
            geometry, materials, decoded, surface, material, corners, edges, shares, scale, side, lanes, lane
        )
        if materials.factors[material, BLENDED] > 0:
            lanes[ALPHA, lane] = lanes[COVER, lane]


@helper
def has_textures(slots, material):
    """Whether any slot of a material is filled."""
    filled = False
    for slot in range(slots.shape[1]):
        filled = filled or slots[material, slot, 0] >= 0
    return filled


@helper
def texture_point(
    geometry, materials, decoded, surface, material, corners, edges, shares, scale, side, lanes, lane
):
    """Look up each filled slot, and let it change what the lanes hold."""
    for slot in range(materials.slots.shape[1]):
        image = materials.slots[material, slot, 0]
        uv_set = materials.slots[material, slot, 1]
        first = geometry.places[surface, UV0 if uv_set == 0 else UV1]
        if image < 0 or first < 0:
            continue
        uv = geometry.uv0 if uv_set == 0 else geometry.uv1
        u, v = moved_uv(uv, first, corners, materials.moves, material, slot)
        images = materials.textures.images
        level = level_at(u, v, edges, shares, scale, images, image)
        u_here = u[0] * shares[0] + u[1] * shares[1] + u[2] * shares[2]
        v_here = v[0] * shares[0] + v[1] * shares[1] + v[2] * shares[2]
        red, green, blue, alpha = sampled(
            images, materials.textures.texels, decoded, image, u_here, v_here, level
        )
        if slot == BASE_SLOT:
            lanes[RED, lane] *= red
            lanes[GREEN, lane] *= green
            lanes[BLUE, lane] *= blue
            lanes[COVER, lane] *= alpha
        elif slot == METAL_SLOT:
            lanes[ROUGHNESS, lane] *= green
            lanes[METALLIC, lane] *= blue
        elif slot == NORMAL_SLOT:
            tilt(
                geometry,
                materials.factors,
                surface,
                material,
                corners,
                shares,
                side,
                u,
                v,
                (red, green, blue),
                lanes,
                lane,
            )
        elif slot == OCCLUSION_SLOT:
            strength = materials.factors[material, OCCLUSION_STRENGTH]
            lanes[OCCLUSION, lane] = np.float32(1) + strength * (red - np.float32(1))
        elif slot == EMISSION_SLOT:
            lanes[EMISSIVE_RED, lane] *= red
            lanes[EMISSIVE_GREEN, lane] *= green
            lanes[EMISSIVE_BLUE, lane] *= blue


@helper
def moved_uv(uv, first, corners, moves, material, slot):
    """(u, v) of the three corners, as the slot moves them."""
    a, b, c = 2 * (first + corners[0]), 2 * (first + corners[1]), 2 * (first + corners[2])
    m0, m1, m2 = moves[material, slot, 0], moves[material, slot, 1], moves[material, slot, 2]
    m3, m4, m5 = moves[material, slot, 3], moves[material, slot, 4], moves[material, slot, 5]
    u = (
        m0 * uv[a] + m1 * uv[a + 1] + m2,
        m0 * uv[b] + m1 * uv[b + 1] + m2,
        m0 * uv[c] + m1 * uv[c + 1] + m2,
    )
    v = (
        m3 * uv[a] + m4 * uv[a + 1] + m5,
        m3 * uv[b] + m4 * uv[b + 1] + m5,
        m3 * uv[c] + m4 * uv[c + 1] + m5,
    )
    return u, v


@helper
def level_at(u, v, edges, shares, scale, images, image):
    """The level whose texels are as large as a pixel: derivatives of a quotient of edge functions."""
    width, height = float(images[image, WIDTH]), float(images[image, HEIGHT])
    du_dx, du_dy, dv_dx, dv_dy = 0.0, 0.0, 0.0, 0.0
    u_here = u[0] * shares[0] + u[1] * shares[1] + u[2] * shares[2]
    v_here = v[0] * shares[0] + v[1] * shares[1] + v[2] * shares[2]
    for k in range(3):
        du_dx += (u[k] - u_here) * edges[k][0]
        du_dy += (u[k] - u_here) * edges[k][1]
        dv_dx += (v[k] - v_here) * edges[k][0]
        dv_dy += (v[k] - v_here) * edges[k][1]
    across, down = scale * width, scale * height
    return footprint_level(du_dx * across, dv_dx * down, du_dy * across, dv_dy * down, images[image, LEVELS])


@helper
def tilt(geometry, factors, surface, material, corners, shares, side, u, v, texel, lanes, lane):
    """Lean the normal as a texel of a normal map says, in the frame of tangent, bitangent and normal."""
    tx, ty, tz, hand = tangent(geometry, surface, corners, shares, u, v)
    nx, ny, nz = float(lanes[NX, lane]), float(lanes[NY, lane]), float(lanes[NZ, lane])
    length = math.sqrt(nx * nx + ny * ny + nz * nz)
    if length == 0:
        return
    nx, ny, nz = nx / length, ny / length, nz / length
    along = tx * nx + ty * ny + tz * nz
    tx, ty, tz = tx - along * nx, ty - along * ny, tz - along * nz
    length = math.sqrt(tx * tx + ty * ty + tz * tz)
    if length == 0:
        return
    tx, ty, tz = tx / length, ty / length, tz / length
    bx, by, bz = (ny * tz - nz * ty) * hand, (nz * tx - nx * tz) * hand, (nx * ty - ny * tx) * hand
    strength = factors[material, NORMAL_SCALE]
    # Seen from behind the whole normal is turned round; of the three axes only `n` and so `b` are yet
    right, up = (2 * texel[0] - 1) * strength * side, (2 * texel[1] - 1) * strength
    out = 2 * texel[2] - 1
    lanes[NX, lane] = tx * right + bx * up + nx * out
    lanes[NY, lane] = ty * right + by * up + ny * out
    lanes[NZ, lane] = tz * right + bz * up + nz * out


@helper
def tangent(geometry, surface, corners, shares, u, v):
    """The direction in which u grows, world axes, and the bitangent's side, 1 or -1."""
    mirror = -1.0 if geometry.places[surface, MIRRORED] != 0 else 1.0
    first = geometry.places[surface, TANGENTS]
    if first >= 0:
        x = mixed(geometry.tangents, 4, 0, first, corners, shares)
        y = mixed(geometry.tangents, 4, 1, first, corners, shares)
        z = mixed(geometry.tangents, 4, 2, first, corners, shares)
        hand = mirror * geometry.tangents[4 * (first + corners[0]) + 3]
    else:
        # The mesh has none: the face's own, from how u and v grow over it
        first = geometry.places[surface, POINTS]
        du1, du2, dv1, dv2 = u[1] - u[0], u[2] - u[0], v[1] - v[0], v[2] - v[0]
        turn = du1 * dv2 - du2 * dv1
        way = 1.0 if turn > 0 else -1.0
        hand = -mirror * way
        weights = (dv1 - dv2) * way, dv2 * way, -dv1 * way
        x = mixed(geometry.points, 3, 0, first, corners, weights)
        y = mixed(geometry.points, 3, 1, first, corners, weights)
        z = mixed(geometry.points, 3, 2, first, corners, weights)
    m = geometry.matrices
    return (
        m[surface, WORLD] * x + m[surface, WORLD + 1] * y + m[surface, WORLD + 2] * z,
        m[surface, WORLD + 4] * x + m[surface, WORLD + 5] * y + m[surface, WORLD + 6] * z,
        m[surface, WORLD + 8] * x + m[surface, WORLD + 9] * y + m[surface, WORLD + 10] * z,
        hand,
    )
