"""What a surface is like at each point: place, normals, colours, found from the face's own three corners."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from eyeline.geometry.arrays import FloatArray
from eyeline.jit import helper, kernel
from eyeline.shading.barycentric import corners_of, edges_of, material_of, mixed, shares_at, surface_of
from eyeline.shading.encoding import DECODED
from eyeline.shading.geometry_table import (
    COLORS,
    FACES,
    MIRRORED,
    NORMAL,
    NORMALS,
    POINTS,
    WORLD,
)
from eyeline.shading.lanes import (
    ALPHA,
    BLUE,
    COLUMN,
    COVER,
    EMISSIVE_BLUE,
    EMISSIVE_GREEN,
    EMISSIVE_RED,
    GREEN,
    GX,
    GY,
    GZ,
    METALLIC,
    NX,
    NY,
    NZ,
    OCCLUSION,
    RED,
    ROUGHNESS,
    ROWS,
    UNLIT,
    X,
    Y,
    Z,
)
from eyeline.shading.material_table import BASE, BLENDED, EMISSION, METAL, NO_LIGHT, ROUGH
from eyeline.shading.reflectance import prepare
from eyeline.shading.surface_points import SurfacePoints
from eyeline.shading.texturing import has_textures, lay_textures

if TYPE_CHECKING:
    from eyeline.shading.frame import Frame


def attributes_of(frame: Frame, points: SurfacePoints) -> FloatArray:
    """(ROWS, K) float32: what the surface is like at each point, by the rows of `lanes`; normals unit."""
    count = len(points)
    lanes, painted = np.empty((ROWS, max(count, 1)), np.float32), np.full(max(count, 1), -1)
    where = points.face, points.x, points.y
    gather(frame.geometry, frame.materials, where, 0, count, False, lanes, painted)
    if frame.textured:
        lay_textures(frame.geometry, frame.materials, DECODED, where, 0, count, lanes)
    prepare(lanes, count, frame.sight)
    return lanes


@kernel
def gather(geometry, materials, points, begin, end, faceted, lanes, painted):
    """Fill the lanes of points begin .. end, but for textures; points: their (face, x, y) arrays.

    faceted: the face's own normal in place of the interpolated one. painted: of each lane, the material whose
    plain numbers it still holds from the tile before, or -1.
    """
    faces, xs, ys = points
    surface, current = 0, -1
    for point in range(begin, end):
        lane = point - begin
        if faces[point] != current:
            current = faces[point]
            surface = surface_of(geometry.first_faces, current, surface)
            face = current - geometry.first_faces[surface]
            corners = corners_of(geometry.faces, geometry.places[surface, FACES] + face)
            first = geometry.places[surface, POINTS]
            edges, clockwise = edges_of(geometry.matrices, surface, geometry.points, first, corners)
            # A mirrored surface shows its front clockwise
            side = -1.0 if clockwise != (geometry.places[surface, MIRRORED] != 0) else 1.0
            facing = face_normal(geometry.matrices, surface, geometry.points, first, corners, side)
            material = material_of(geometry, surface, face)
            textured = has_textures(materials.slots, material)
            first_normal = geometry.places[surface, NORMALS]
            flat = faceted or first_normal < 0
            first_color = geometry.places[surface, COLORS]
            coloured = first_color >= 0
        lanes[COLUMN, lane] = xs[point]
        shares, _ = shares_at(edges, float(xs[point]), float(ys[point]))
        write_place(geometry.matrices, surface, geometry.points, first, corners, shares, lanes, lane)
        lanes[GX, lane], lanes[GY, lane], lanes[GZ, lane] = facing
        if flat:
            lanes[NX, lane], lanes[NY, lane], lanes[NZ, lane] = facing
        else:
            facing_shares = shares[0] * side, shares[1] * side, shares[2] * side
            write_normal(
                geometry.matrices,
                surface,
                geometry.normals,
                first_normal,
                corners,
                facing_shares,
                lanes,
                lane,
            )
        if painted[lane] != material:
            write_material(materials.factors, material, lanes, lane)
        painted[lane] = -1 if coloured or textured else material
        if coloured:
            tint(geometry.colors, first_color, corners, shares, lanes, lane)
            if materials.factors[material, BLENDED] > 0:
                lanes[ALPHA, lane] = lanes[COVER, lane]


@helper
def face_normal(matrices, surface, points, first, corners, side):
    """The normal of a face towards the eye, of any length, world axes."""
    a, b, c = 3 * (first + corners[0]), 3 * (first + corners[1]), 3 * (first + corners[2])
    x, y, z = float(points[a]), float(points[a + 1]), float(points[a + 2])
    ux, uy, uz = points[b] - x, points[b + 1] - y, points[b + 2] - z
    vx, vy, vz = points[c] - x, points[c + 1] - y, points[c + 2] - z
    nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    longest = max(abs(nx), abs(ny), abs(nz))
    scale = side / longest if longest > 0 else 1.0
    return turned(matrices, surface, nx * scale, ny * scale, nz * scale)


@helper
def turned(matrices, surface, x, y, z):
    """A normal from the mesh's axes to the world's; float32."""
    m, a, b, c = matrices, NORMAL, NORMAL + 3, NORMAL + 6
    return (
        np.float32(m[surface, a] * x + m[surface, a + 1] * y + m[surface, a + 2] * z),
        np.float32(m[surface, b] * x + m[surface, b + 1] * y + m[surface, b + 2] * z),
        np.float32(m[surface, c] * x + m[surface, c + 1] * y + m[surface, c + 2] * z),
    )


@helper
def write_place(matrices, surface, points, first, corners, shares, lanes, lane):
    """Where the point is, from the eye."""
    x = mixed(points, 3, 0, first, corners, shares)
    y = mixed(points, 3, 1, first, corners, shares)
    z = mixed(points, 3, 2, first, corners, shares)
    m, a, b, c = matrices, WORLD, WORLD + 4, WORLD + 8
    lanes[X, lane] = m[surface, a] * x + m[surface, a + 1] * y + m[surface, a + 2] * z + m[surface, a + 3]
    lanes[Y, lane] = m[surface, b] * x + m[surface, b + 1] * y + m[surface, b + 2] * z + m[surface, b + 3]
    lanes[Z, lane] = m[surface, c] * x + m[surface, c + 1] * y + m[surface, c + 2] * z + m[surface, c + 3]


@helper
def write_normal(matrices, surface, normals, first, corners, shares, lanes, lane):
    """The interpolated normal; shares: negative for a face seen from behind."""
    x = mixed(normals, 3, 0, first, corners, shares)
    y = mixed(normals, 3, 1, first, corners, shares)
    z = mixed(normals, 3, 2, first, corners, shares)
    lanes[NX, lane], lanes[NY, lane], lanes[NZ, lane] = turned(matrices, surface, x, y, z)


@helper
def write_material(factors, material, lanes, lane):
    """What the material says without textures."""
    lanes[RED, lane] = factors[material, BASE]
    lanes[GREEN, lane] = factors[material, BASE + 1]
    lanes[BLUE, lane] = factors[material, BASE + 2]
    lanes[COVER, lane] = factors[material, BASE + 3]
    lanes[METALLIC, lane] = factors[material, METAL]
    lanes[ROUGHNESS, lane] = factors[material, ROUGH]
    lanes[EMISSIVE_RED, lane] = factors[material, EMISSION]
    lanes[EMISSIVE_GREEN, lane] = factors[material, EMISSION + 1]
    lanes[EMISSIVE_BLUE, lane] = factors[material, EMISSION + 2]
    lanes[UNLIT, lane] = factors[material, NO_LIGHT]
    lanes[OCCLUSION, lane] = np.float32(1)
    lanes[ALPHA, lane] = factors[material, BASE + 3] if factors[material, BLENDED] > 0 else np.float32(1)


@helper
def tint(colors, first, corners, shares, lanes, lane):
    """Multiply the base colour by the vertex colour."""
    lanes[RED, lane] *= mixed(colors, 4, 0, first, corners, shares)
    lanes[GREEN, lane] *= mixed(colors, 4, 1, first, corners, shares)
    lanes[BLUE, lane] *= mixed(colors, 4, 2, first, corners, shares)
    lanes[COVER, lane] *= mixed(colors, 4, 3, first, corners, shares)
