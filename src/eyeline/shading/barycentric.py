"""Where in its triangle a point of the picture lies, right in perspective. [Olano97]"""

from __future__ import annotations

from eyeline.jit import helper
from eyeline.shading.geometry_table import FACE_MATERIAL, MATERIAL


@helper
def corners_of(faces, row):
    """The three vertices of a row of flat faces."""
    return faces[3 * row], faces[3 * row + 1], faces[3 * row + 2]


@helper
def corner_in_picture(matrices, surface, points, vertex):
    """(x w, y w, w) of a vertex, in pixels; Geometry.matrices begin with picture_from_mesh."""
    x, y, z = float(points[3 * vertex]), float(points[3 * vertex + 1]), float(points[3 * vertex + 2])
    xw = matrices[surface, 0] * x + matrices[surface, 1] * y + matrices[surface, 2] * z + matrices[surface, 3]
    yw = matrices[surface, 4] * x + matrices[surface, 5] * y + matrices[surface, 6] * z + matrices[surface, 7]
    w = (
        matrices[surface, 8] * x
        + matrices[surface, 9] * y
        + matrices[surface, 10] * z
        + matrices[surface, 11]
    )
    return xw, yw, w


@helper
def edges_of(matrices, surface, points, first, corners):
    """Three edge functions (a, b, c), and whether the face turns clockwise on the screen, y down.

    a x + b y + c is 0 along the edge and grows with the opposite corner's share; divided by the sum of
    the three it is that share. A corner behind the eye needs no care.
    """
    x0, y0, w0 = corner_in_picture(matrices, surface, points, first + corners[0])
    x1, y1, w1 = corner_in_picture(matrices, surface, points, first + corners[1])
    x2, y2, w2 = corner_in_picture(matrices, surface, points, first + corners[2])
    edge0 = y1 * w2 - w1 * y2, w1 * x2 - x1 * w2, x1 * y2 - y1 * x2
    edge1 = y2 * w0 - w2 * y0, w2 * x0 - x2 * w0, x2 * y0 - y2 * x0
    edge2 = y0 * w1 - w0 * y1, w0 * x1 - x0 * w1, x0 * y1 - y0 * x1
    return (edge0, edge1, edge2), x0 * edge0[0] + y0 * edge0[1] + w0 * edge0[2] > 0


@helper
def shares_at(edges, x, y):
    """The shares of the three corners at (x, y), and one over the sum of the edge functions there."""
    s0 = edges[0][0] * x + edges[0][1] * y + edges[0][2]
    s1 = edges[1][0] * x + edges[1][1] * y + edges[1][2]
    s2 = edges[2][0] * x + edges[2][1] * y + edges[2][2]
    scale = 1.0 / (s0 + s1 + s2)
    return (s0 * scale, s1 * scale, s2 * scale), scale


@helper
def mixed(values, width, column, first, corners, shares):
    """The corners' values in one column of flat rows, mixed by their shares."""
    a = values[width * (first + corners[0]) + column] * shares[0]
    b = values[width * (first + corners[1]) + column] * shares[1]
    return a + b + values[width * (first + corners[2]) + column] * shares[2]


@helper
def surface_of(first_faces, face, likely):
    """The surface a scene face belongs to, looked for first where the last one was."""
    if first_faces[likely] <= face < first_faces[likely + 1]:
        return likely
    low, high = 0, first_faces.shape[0] - 1
    while high - low > 1:
        middle = (low + high) // 2
        if first_faces[middle] <= face:
            low = middle
        else:
            high = middle
    return low


@helper
def material_of(geometry, surface, face):
    """The row of the material of a surface's own face."""
    material = geometry.places[surface, MATERIAL]
    if geometry.places[surface, FACE_MATERIAL] >= 0:
        material += geometry.face_material[geometry.places[surface, FACE_MATERIAL] + face]
    return material
